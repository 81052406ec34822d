// Plane waves in a uniaxial crystal. Wave vectors k are in units of the vacuum's wave number, so that |k| is
// a refractive index; H is in units in which H = k x E.
//
// Source: Maxwell's equations, k x (k x E) + epsilon E = 0 with epsilon = n_o^2 1 + (n_e^2 - n_o^2) c c^T;
// Born and Wolf, Principles of Optics, ch. 15. All holds for complex k (evanescent waves), too.
#pragma once

#include <Eigen/Core>

#include "data/base/vec3.h"
#include "propagation/crystal/ice_crystal.h"

namespace floe {

enum class Polarisation { ordinary, extraordinary };

using ComplexVec3 = Eigen::Vector3cd;

struct Fields {
  ComplexVec3 E, H;  // |E| = 1
};
// The fields of a wave with the wave vector k in the crystal with the c-axis `axis`, a unit vector.
//   ordinary:       E ~ k x c,             k^2 = n_o^2
//   extraordinary:  E ~ k (k.c) - n_o^2 c, k.M k = 1 with M = 1/n_e^2 + (1/n_o^2 - 1/n_e^2) c c^T
// Along the c-axis both waves are the same, and any two axes across do.
Fields fields_of(const ComplexVec3& k, const Vec3& axis, Polarisation polarisation,
                 const CrystalIndices& indices);

// M v, with the matrix M of the extraordinary wave. (Not epsilon^-1: along the c-axis |k| is n_o.)
Vec3 extraordinary_product(const Vec3& v, const Vec3& axis, const CrystalIndices& indices);

// Where the energy flows: the unit vector along k of an ordinary wave, M k of an extraordinary one.
Vec3 energy_direction(const Vec3& k, const Vec3& axis, Polarisation polarisation,
                      const CrystalIndices& indices);

// The wave vector of the wave whose energy flows along the unit vector `direction`.
Vec3 wave_vector_of(const Vec3& direction, const Vec3& axis, Polarisation polarisation,
                    const CrystalIndices& indices);

// The component of k along `normal` when the one across is `across`: of the wave whose energy flows along the
// normal (`side` 1) or against it (-1), or, where the wave is evanescent, that decays on that side.
std::complex<double> normal_component(const Vec3& across, const Vec3& normal, double side, const Vec3& axis,
                                      Polarisation polarisation, const CrystalIndices& indices);

}  // namespace floe
