// How much light modules catch, against areas that geometry gives.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "data/base/constants.h"
#include "geometry/acceptance.h"
#include "geometry/module_scene.h"
#include "tests/unit/geometry/random_places.h"

namespace floe {
namespace {

using test::Random;
using test::random_direction;
using test::uniform;

// Two unit vectors that span the plane across a direction.
std::pair<Vec3, Vec3> plane_across(const Vec3& direction) {
  const Vec3 aside = direction.unitOrthogonal();
  return {aside, direction.cross(aside)};
}

struct Binomial {
  double n, share;
  double error() const { return std::sqrt(share * (1 - share) / n); }
};

// A beam of any direction, as wide as a square around a module: the share pi (X R)^2 / area of it is met,
// and on the nominal sphere it is spread as a beam spreads over a sphere: the mean of inward . direction is
// 2/3, its variance 1/18.
TEST(WidenedModule, CatchesItsCrossSectionFromAllDirections) {
  constexpr int n = 400'000;
  const Module module;
  const Detector detector("one", {module});
  for (const double oversize : {1.0, 5.0, 16.0}) {
    const auto finder = make_embree_finder(detector, oversize);
    const double half_width = 1.3 * oversize * module_radius;
    Random random(11);
    std::vector<ModuleCrossing> met;
    double cosines = 0;
    for (int k = 0; k < n; ++k) {
      const Vec3 direction = random_direction(random);
      const auto [first, second] = plane_across(direction);
      const Vec3 origin =
          -30 * direction + half_width * (uniform(random, -1, 1) * first + uniform(random, -1, 1) * second);
      const std::size_t before = met.size();
      finder->find(origin.cast<float>(), direction.cast<float>(), 60, met);
      if (met.size() > before) cosines += met.back().inward.cast<double>().dot(direction);
    }
    const Binomial expected{n, pi / (4 * 1.3 * 1.3)};
    const double hits = static_cast<double>(met.size());
    EXPECT_NEAR(hits / n, expected.share, 5 * expected.error()) << oversize;
    EXPECT_NEAR(cosines / hits, 2.0 / 3, 5 * std::sqrt(1 / (18 * hits))) << oversize;
  }
}

// Share of a disc of radius 1 that lies within `half_width` of the line at `offset` from its centre.
double strip_share(double offset, double half_width) {
  const auto left_of = [](double x) {
    x = std::clamp(x, -1.0, 1.0);
    return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / pi;
  };
  return left_of(offset + half_width) - left_of(offset - half_width);
}

// Share of a beam that lands on a module and came through its cable; the cable's azimuth is 0.
double shadowed_share(const Vec3& direction, int n, Random& random) {
  int shadowed = 0;
  for (int k = 0; k < n; ++k) {
    const double radius = std::sqrt(uniform(random, 0, 1)), angle = uniform(random, 0, 2 * pi);
    const auto [first, second] = plane_across(direction);
    const Vec3 across = radius * (std::cos(angle) * first + std::sin(angle) * second);
    shadowed += cable_shadows(0, direction, across + std::sqrt(1 - radius * radius) * direction);
  }
  return static_cast<double>(shadowed) / n;
}

// The cable's axis passes at (R + r) sin(phi) from the module's centre, seen along a beam whose
// azimuth differs from the cable's by phi, whatever the beam's zenith; it shades when it is in front.
TEST(CableShadow, IsAStripOfTheModule) {
  constexpr int n = 200'000;
  Random random(12);
  const double half_width = cable_radius / module_radius;
  for (const double phi : {0.0, 0.3, 0.8, 1.2, -0.5})
    for (const double zenith : {0.3, 1.0, pi / 2, 2.5}) {
      const double offset = (1 + half_width) * std::sin(phi);
      const Binomial expected{n, strip_share(offset, half_width)};
      const double share = shadowed_share(travel_direction(zenith, phi), n, random);
      EXPECT_NEAR(share, expected.share, 5 * expected.error() + 1e-9) << phi << ' ' << zenith;
      EXPECT_EQ(shadowed_share(travel_direction(zenith, phi + pi), n / 100, random), 0);
    }
}

TEST(CableShadow, OfDiffuseLightIsTheMeanStrip) {
  constexpr int n = 400'000, steps = 20'000;
  Random random(13);
  const double half_width = cable_radius / module_radius;
  double mean = 0;  // over phi; half of all directions see the cable behind the module
  for (int k = 0; k < steps; ++k) {
    const double phi = pi * ((k + 0.5) / steps - 0.5);
    mean += strip_share((1 + half_width) * std::sin(phi), half_width) / (2.0 * steps);
  }
  const Binomial expected{n, mean};
  double shadowed = 0;
  for (int k = 0; k < n; ++k) shadowed += shadowed_share(random_direction(random), 1, random);
  EXPECT_NEAR(shadowed / n, mean, 5 * expected.error());
}

// Isotropic light on a polynomial curve: the mean over cos(eta) is sum c_k / (k + 1) over even k.
TEST(AngularAcceptance, MeanOverIsotropicLight) {
  constexpr int n = 400'000;
  Random random(14);
  const AngularAcceptance acceptance = builtin_acceptance().angular;
  double mean = 0;
  for (std::size_t k = 0; k < acceptance.coefficients().size(); k += 2)
    mean += acceptance.coefficients()[k] / (static_cast<double>(k) + 1) / acceptance.maximum();
  double sum = 0, squares = 0;
  for (int k = 0; k < n; ++k) {
    const double p = acceptance.probability(random_direction(random), Vec3::UnitX(), Vec3::UnitZ());
    sum += p;
    squares += p * p;
  }
  const double found = sum / n;
  EXPECT_NEAR(found, mean, 5 * std::sqrt((squares / n - found * found) / n));
}

}  // namespace
}  // namespace floe
