// Boundaries of ellipsoids against their geometry.
#include "propagation/crystal/grain_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace floe {
namespace {

// The mean normal of the boundaries that a ray crosses is the mean over the ellipsoid's surface of
// N |N . ray|, over that of |N . ray|, on the side where N . ray > 0: by points on the unit sphere u, whose
// surface element becomes abc |A^-1 u| du and whose normal A^-1 u.
Vec3 mean_normal(const std::array<double, 3>& axes, const Vec3& ray) {
  constexpr int rings = 400, places = 800;
  Vec3 sum = Vec3::Zero();
  double weights = 0;
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < places; ++k) {
      const Vec3 u = unit_vector(std::acos(-1 + 2 * (i + 0.5) / rings), 2 * pi * (k + 0.5) / places);
      const Vec3 mapped(u.x() / axes[0], u.y() / axes[1], u.z() / axes[2]);
      const double rate = std::max(0.0, mapped.dot(ray));
      sum += rate * mapped.normalized();
      weights += rate;
    }
  return sum / weights;
}

TEST(GrainShape, NormalsHaveTheCrossingRatesOfTheSurface) {
  const std::array<double, 3> axes{2.1, 0.8, 1};
  const Vec3 ray = Vec3(0.5, -0.3, 0.7).normalized();
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform;
  Vec3 sum = Vec3::Zero();
  constexpr int draws = 400000;
  for (int i = 0; i < draws; ++i) {
    const double square = uniform(generator), turn = uniform(generator);
    Vec3 n;
    boundary_normal(axes, ray.x(), ray.y(), ray.z(), square, turn_functions(turn), n.x(), n.y(), n.z());
    ASSERT_NEAR(n.norm(), 1, 1e-14);
    ASSERT_GT(n.dot(ray), 0);
    sum += n;
  }
  // A component of a unit vector spreads by less than 1: five standard errors are below 0.008.
  const Vec3 expected = mean_normal(axes, ray), found = sum / draws;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 5 / std::sqrt(draws));
}

// Of a sphere, cos^2 of the angle to the ray is uniform.
TEST(GrainShape, OfASphereTheSquaredCosineIsUniform) {
  const Vec3 ray = Vec3(0.2, 0.9, -0.4).normalized();
  for (const double square : {0.01, 0.3, 0.99}) {
    Vec3 n;
    boundary_normal({1, 1, 1}, ray.x(), ray.y(), ray.z(), square, turn_functions(0.3), n.x(), n.y(), n.z());
    EXPECT_NEAR(std::pow(n.dot(ray), 2), 1 - square, 1e-14);
  }
}

// Closed form of the surface of a prolate spheroid (p, 1, 1): 4 V/S and the chord along its axis, 4/3 p.
TEST(GrainShape, ChordsOfASpheroid) {
  const double p = 1.7, e = std::sqrt(1 - 1 / (p * p));
  const double surface = 2 * pi * (1 + p / e * std::asin(e)), volume = 4 * pi / 3 * p;
  const double mean = 4 * volume / surface;
  EXPECT_NEAR(relative_chord(spheroid(p), {1, 0, 0}), 4.0 / 3 * p / mean, 1e-5);
  EXPECT_NEAR(relative_chord(spheroid(p), {0, 0.6, 0.8}), 4.0 / 3 / mean, 1e-5);
  EXPECT_NEAR(relative_chord(spheroid(1), {0, 1, 0}), 1, 1e-12);
}

}  // namespace
}  // namespace floe
