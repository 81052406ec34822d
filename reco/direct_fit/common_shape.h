// How light depends on the angle to the cascade and on distance, learnt from many modules together.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "data/base/vec3.h"

namespace floe {

inline constexpr int shape_terms = 5;
using ShapeTerms = Eigen::Matrix<double, shape_terms, 1>;

// A module seen from a light centre: soft distance [m] and cosine of the angle between the cascade's
// direction and the way to the module, with their derivatives with respect to the light centre and the
// direction.
struct Sight {
  double distance, cosine;
  Vec3 distance_by_place;    // d distance / d centre
  Vec3 cosine_by_place;      // d cosine / d centre [1/m]
  Vec3 cosine_by_direction;  // d cosine / d direction
};
Sight sight(const Vec3& centre, const Vec3& direction, const Vec3& module);

// Legendre polynomials P1..P4 of the cosine and the distance in units of 50 m.
ShapeTerms terms_of(const Sight& sight);
// Derivative of terms_of in the cosine; in the distance it is 1/50 m for the last term alone.
ShapeTerms terms_by_cosine(const Sight& sight);
inline constexpr double shape_length = 50;  // [m]

// Counts of one bin in all simulations, of mean exp(a + offset_k + shape . terms_k) with a free of prior.
struct ShapeUnit {
  std::span<const ShapeTerms> terms;
  std::span<const double> offsets, counts;
};

// The shape that units have in common: maximum of the multinomial likelihood (which does not ask how bright
// each unit is, only how that changes from simulation to simulation) with a Gaussian prior about `expected`.
// Higher polynomials are given less freedom: light that has scattered is smooth.
ShapeTerms fit_shape(std::span<const ShapeUnit> units, const ShapeTerms& expected);

}  // namespace floe
