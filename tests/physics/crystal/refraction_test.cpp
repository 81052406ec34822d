// One boundary against closed forms: Fresnel's equations and double refraction. Calcite's indices make every
// effect large.
#include <gtest/gtest.h>

#include <cmath>

#include "propagation/crystal/boundary.h"

namespace floe {
namespace {

const CrystalIndices calcite{1.658, 1.486};
const CrystalIndices sharp{1.3, 1.6};  // positive, as ice is

// Light in the x-z plane meets the boundary z = 0. In front the c-axis is y: light polarised along y is
// extraordinary and sees n_e, the other is ordinary. Behind it is z: light polarised along y is ordinary.
const Vec3 in_front(0, 1, 0), behind(0, 0, 1), normal(0, 0, 1);

CrystalRay coming(double angle, Polarisation polarisation, const CrystalIndices& n) {
  return ray_along({std::sin(angle), 0, std::cos(angle)}, in_front, polarisation, n);
}

Vec3 extraordinary_wave(const Vec3& direction, const Vec3& axis, const CrystalIndices& n) {
  return direction / std::sqrt(direction.dot(extraordinary_product(direction, axis, n)));
}

class Angles : public ::testing::TestWithParam<double> {};

// Across the plane of incidence: r = (n1 cos1 - n2 cos2)/(n1 cos1 + n2 cos2), from n1 = n_e to n2 = n_o. With
// n1 > n2 it holds beyond the critical angle, too, where cos2 is imaginary and all is reflected.
TEST_P(Angles, FresnelAcrossThePlane) {
  for (const CrystalIndices& n : {calcite, sharp}) {
    const double angle = GetParam() * degree;
    const auto waves = outgoing_waves(coming(angle, Polarisation::extraordinary, n), normal, behind, n);
    const double x = n.extraordinary * std::sin(angle), z1 = n.extraordinary * std::cos(angle);
    const std::complex<double> z2 = std::sqrt(std::complex<double>(n.ordinary * n.ordinary - x * x));
    const double reflected = std::norm((z1 - z2) / (z1 + z2));
    EXPECT_NEAR(waves[1].share, reflected, 1e-12);
    EXPECT_NEAR(waves[2].share, 1 - reflected, 1e-12);
    EXPECT_NEAR(waves[0].share + waves[3].share, 0, 1e-12);
  }
}

// In the plane, into a crystal whose axis is the normal: with z2 = (n_o/n_e) sqrt(n_e^2 - x^2),
// r = (z1/n1^2 - z2/n_o^2)/(z1/n1^2 + z2/n_o^2), here n1 = n_o (Yeh, Optical Waves in Layered Media, ch. 9).
TEST_P(Angles, FresnelInThePlane) {
  for (const CrystalIndices& n : {calcite, sharp}) {
    const double angle = GetParam() * degree;
    const auto waves = outgoing_waves(coming(angle, Polarisation::ordinary, n), normal, behind, n);
    const double x = n.ordinary * std::sin(angle), z1 = n.ordinary * std::cos(angle);
    const std::complex<double> z2 =
        n.ordinary / n.extraordinary *
        std::sqrt(std::complex<double>(n.extraordinary * n.extraordinary - x * x));
    const double reflected = std::norm((z1 - z2) / (z1 + z2));
    EXPECT_NEAR(waves[0].share, reflected, 1e-12);
    EXPECT_NEAR(waves[3].share, 1 - reflected, 1e-12);
    EXPECT_NEAR(waves[1].share + waves[2].share, 0, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Incidence, Angles, ::testing::Values(0.5, 20, 45, 56.3, 65, 80, 89));

// Walk-off: tan(rho) = (n_e^2 - n_o^2) tan(theta)/(n_e^2 + n_o^2 tan^2(theta)), from the wave's direction
// towards the axis where n_e > n_o.
TEST(DoubleRefraction, WalkOff) {
  for (const CrystalIndices& n : {calcite, sharp, CrystalIndices{1.3185, 1.3200}})
    for (const double theta : {10.0, 45.0, 80.0}) {
      const double t = std::tan(theta * degree), o = n.ordinary * n.ordinary,
                   e = n.extraordinary * n.extraordinary;
      const double rho = std::atan((e - o) * t / (e + o * t * t));
      const Vec3 wave = unit_vector(theta * degree, 0);
      const Vec3 k = extraordinary_wave(wave, {0, 0, 1}, n);
      const Vec3 ray = energy_direction(k, {0, 0, 1}, Polarisation::extraordinary, n);
      EXPECT_NEAR(std::atan2(ray.x(), ray.z()), theta * degree - rho, 1e-13);
    }
}

// Calcite at 45 deg: 6.2 deg, the textbook's example (Hecht, Optics, sec. 8.4).
TEST(DoubleRefraction, CalciteAt45Degrees) {
  const Vec3 k = extraordinary_wave(unit_vector(45 * degree, 0), {0, 0, 1}, calcite);
  const Vec3 ray = energy_direction(k, {0, 0, 1}, Polarisation::extraordinary, calcite);
  EXPECT_NEAR(std::atan2(ray.x(), ray.z()) / degree - 45, 6.2, 0.05);
}

// Both waves behind the boundary obey Snell's law with the index of their own direction.
TEST(DoubleRefraction, SnellForBothWaves) {
  const Vec3 axis_behind = Vec3(0.4, 0.5, 0.7).normalized();
  const CrystalRay ray = coming(35 * degree, Polarisation::ordinary, calcite);
  const auto waves = outgoing_waves(ray, normal, axis_behind, calcite);
  const Vec3 ordinary = waves[2].k.real(), extraordinary = waves[3].k.real();
  EXPECT_NEAR(ordinary.norm(), calcite.ordinary, 1e-14);
  const double cosine = extraordinary.normalized().dot(axis_behind);
  const double index = 1 / std::sqrt(std::pow(cosine / calcite.ordinary, 2) +
                                     (1 - cosine * cosine) / std::pow(calcite.extraordinary, 2));
  EXPECT_NEAR(extraordinary.norm(), index, 1e-14);
  EXPECT_GT((ordinary.normalized() - extraordinary.normalized()).norm(), 0.01);
}

TEST(DoubleRefraction, NoneWithoutBirefringence) {
  const CrystalIndices glass{1.5, 1.5};
  const CrystalRay ray = coming(35 * degree, Polarisation::ordinary, glass);
  const auto waves = outgoing_waves(ray, normal, Vec3(0.4, 0.5, 0.7).normalized(), glass);
  EXPECT_LT(waves[0].share + waves[1].share, 1e-28);
  EXPECT_LT((waves[2].k.real() - ray.k).norm() + (waves[3].k.real() - ray.k).norm(), 1e-14);
}

}  // namespace
}  // namespace floe
