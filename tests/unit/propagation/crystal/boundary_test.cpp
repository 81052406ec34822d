// What must hold at every boundary and of every wave, to rounding.
#include "propagation/crystal/boundary.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "propagation/crystal/draws.h"

namespace floe {
namespace {

using Complex = std::complex<double>;

Vec3 random_direction(RandomStream& stream) {
  const double z = 2 * fine_uniform(stream) - 1;
  return unit_vector(std::acos(z), 2 * pi * fine_uniform(stream));
}

struct Meeting {
  CrystalRay ray;
  Vec3 normal, axis_behind;
};
// `grazing`: nearly along the boundary, where waves are evanescent.
Meeting random_meeting(RandomStream& stream, const CrystalIndices& indices, bool grazing) {
  const Vec3 direction = random_direction(stream), axis = random_direction(stream);
  const auto polarisation = fine_uniform(stream) < 0.5 ? Polarisation::ordinary : Polarisation::extraordinary;
  Vec3 normal = random_direction(stream);
  if (grazing)
    normal =
        ((normal - normal.dot(direction) * direction).normalized() + 0.03 * fine_uniform(stream) * direction)
            .normalized();
  if (normal.dot(direction) < 0) normal = -normal;
  return {ray_along(direction, axis, polarisation, indices), normal, random_direction(stream)};
}

Eigen::Matrix3cd cross_matrix(const ComplexVec3& v) {
  Eigen::Matrix3cd m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

// Largest component of k x H + epsilon E, which Maxwell's equations make 0.
double maxwell_residual(const ComplexVec3& k, const Vec3& axis, Polarisation polarisation,
                        const CrystalIndices& n) {
  const Fields wave = fields_of(k, axis, polarisation, n);
  const double o = n.ordinary * n.ordinary, e = n.extraordinary * n.extraordinary;
  const Eigen::Matrix3d permittivity = o * Eigen::Matrix3d::Identity() + (e - o) * axis * axis.transpose();
  return (cross_matrix(k) * wave.H + permittivity.cast<Complex>() * wave.E).cwiseAbs().maxCoeff();
}

class Boundary : public ::testing::TestWithParam<CrystalIndices> {};

TEST_P(Boundary, WavesObeyMaxwell) {
  RandomStream stream(1, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const auto [ray, normal, axis_behind] = random_meeting(stream, GetParam(), i % 2);
    EXPECT_LT(maxwell_residual(ray.k.cast<Complex>(), ray.axis, ray.polarisation, GetParam()), 1e-11);
    for (const OutgoingWave& wave : outgoing_waves(ray, normal, axis_behind, GetParam()))
      EXPECT_LT(
          maxwell_residual(wave.k, wave.reflected ? ray.axis : axis_behind, wave.polarisation, GetParam()),
          1e-11);
  }
}

TEST_P(Boundary, KeepsTheTangentialPhase) {
  RandomStream stream(2, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const auto [ray, normal, axis_behind] = random_meeting(stream, GetParam(), i % 2);
    for (const OutgoingWave& wave : outgoing_waves(ray, normal, axis_behind, GetParam())) {
      const ComplexVec3 change = wave.k - ray.k.cast<Complex>();
      EXPECT_LT((cross_matrix(change) * normal.cast<Complex>()).norm(), 1e-14);
    }
  }
}

TEST_P(Boundary, KeepsTheTangentialFields) {
  RandomStream stream(3, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const auto [ray, normal, axis_behind] = random_meeting(stream, GetParam(), i % 2);
    const Fields in = fields_of(ray.k.cast<Complex>(), ray.axis, ray.polarisation, GetParam());
    ComplexVec3 E = in.E, H = in.H;  // sum in front less sum behind
    for (const OutgoingWave& wave : outgoing_waves(ray, normal, axis_behind, GetParam())) {
      const Fields out =
          fields_of(wave.k, wave.reflected ? ray.axis : axis_behind, wave.polarisation, GetParam());
      const Complex amplitude = wave.reflected ? wave.amplitude : -wave.amplitude;
      E += amplitude * out.E;
      H += amplitude * out.H;
    }
    EXPECT_LT((cross_matrix(normal.cast<Complex>()) * E).norm(), 1e-11);
    EXPECT_LT((cross_matrix(normal.cast<Complex>()) * H).norm(), 1e-11);
  }
}

TEST_P(Boundary, KeepsTheEnergy) {
  RandomStream stream(4, 0, 0);
  int evanescent = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto [ray, normal, axis_behind] = random_meeting(stream, GetParam(), i % 2);
    double sum = 0;
    for (const OutgoingWave& wave : outgoing_waves(ray, normal, axis_behind, GetParam())) {
      EXPECT_GE(wave.share, 0);
      if (wave.k.imag().norm() > 0) ++evanescent;
      sum += wave.share;
    }
    // Normal components of nearly grazing waves are roots of small differences of numbers near 1.
    const double cosine = ray.direction.dot(normal);
    EXPECT_NEAR(sum, 1, 1e-14 / (cosine * cosine)) << cosine;
  }
  EXPECT_GT(evanescent, 100);  // the test has met them
}

// The energy of what is drawn goes to the side that its wave belongs to.
TEST_P(Boundary, RaysLeaveOnTheirSide) {
  RandomStream stream(5, 0, 0);
  for (int i = 0; i < 4000; ++i) {
    const auto [ray, normal, axis_behind] = random_meeting(stream, GetParam(), i % 2);
    const CrystalRay out = cross_boundary(ray, normal, axis_behind, fine_uniform(stream), GetParam());
    EXPECT_NEAR(out.direction.norm(), 1, 1e-14);
    if (out.axis == axis_behind)
      EXPECT_GT(out.direction.dot(normal), 0);
    else
      EXPECT_LT(out.direction.dot(normal), 0);
  }
}

TEST_P(Boundary, WaveVectorAndEnergyBelongTogether) {
  RandomStream stream(6, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const CrystalRay ray = random_meeting(stream, GetParam(), false).ray;
    const Fields wave = fields_of(ray.k.cast<Complex>(), ray.axis, ray.polarisation, GetParam());
    const Vec3 E = wave.E.real(), H = wave.H.real();
    EXPECT_LT((E.cross(H).normalized() - ray.direction).norm(), 1e-8);
    EXPECT_LT((energy_direction(ray.k, ray.axis, ray.polarisation, GetParam()) - ray.direction).norm(),
              1e-14);
  }
}

// Light along the c-axis has no polarisation of its own: any is right, and energy is kept.
TEST_P(Boundary, AlongTheAxis) {
  const Vec3 axis(0, 0, 1), normal = Vec3(0.3, 0.1, 1).normalized();
  for (const auto polarisation : {Polarisation::ordinary, Polarisation::extraordinary}) {
    const CrystalRay ray = ray_along(axis, axis, polarisation, GetParam());
    double sum = 0;
    for (const OutgoingWave& wave : outgoing_waves(ray, normal, {0, 1, 0}, GetParam())) sum += wave.share;
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Crystals, Boundary,
                         ::testing::Values(CrystalIndices{1.3185, 1.3200}, CrystalIndices{1.658, 1.486}),
                         [](const auto& crystal) { return crystal.index == 0 ? "Ice" : "Calcite"; });

TEST(IceCrystal, IndicesAgainstWavelength) {
  const CrystalIndices violet = crystal_indices(405), yellow = crystal_indices(589);
  EXPECT_NEAR(violet.ordinary, 1.3185, 1e-9);
  EXPECT_NEAR(violet.extraordinary, 1.3200, 1e-9);
  EXPECT_NEAR(yellow.ordinary, 1.3091, 3e-4);  // Petrenko and Whitworth, Physics of Ice, 1999
  EXPECT_NEAR(yellow.extraordinary, 1.3105, 3e-4);
}

}  // namespace
}  // namespace floe
