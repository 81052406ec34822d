#include <gtest/gtest.h>

#include <random>

#include "data/base/constants.h"
#include "geometry/acceptance.h"

namespace floe {
namespace {

// The cable stands at azimuth 0. Photons along -x come through it, if they land near the middle.
TEST(Cable, HidesWhatLandsBehindIt) {
  EXPECT_TRUE(cable_shadows(0, -Vec3::UnitX(), -Vec3::UnitX()));
  EXPECT_FALSE(cable_shadows(pi, -Vec3::UnitX(), -Vec3::UnitX()));
  EXPECT_FALSE(cable_shadows(pi / 2, -Vec3::UnitX(), -Vec3::UnitX()));
  EXPECT_TRUE(cable_shadows(2 * pi, -Vec3::UnitX(), -Vec3::UnitX()));
}

TEST(Cable, ItsEdgeIsItsRadius) {
  const double edge = cable_radius / module_radius;
  const auto landing_aside = [](double y) {
    return cable_shadows(0, -Vec3::UnitX(), Vec3(-std::sqrt(1 - y * y), -y, 0));
  };
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(landing_aside(side * (edge - 1e-9)));
    EXPECT_FALSE(landing_aside(side * (edge + 1e-9)));
  }
}

TEST(Cable, IsVertical) {
  // A steep photon that travels away from the cable's side meets it far above or below.
  const Vec3 steep = unit_vector(pi - 0.01, pi);
  EXPECT_TRUE(cable_shadows(0, steep, -Vec3::UnitX()));
  EXPECT_FALSE(cable_shadows(0, -Vec3::UnitZ(), -Vec3::UnitZ()));
  EXPECT_FALSE(cable_shadows(0, Vec3::UnitZ(), Vec3::UnitZ()));
}

// Walks back from the landing point in small steps.
TEST(Cable, AgreesWithAWalkAlongTheLine) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  int shadowed = 0;
  for (int k = 0; k < 20'000; ++k) {
    const double azimuth = pi * unit(random);
    const Vec3 inward = unit_vector(std::acos(unit(random)), pi * unit(random));
    const Vec3 direction = unit_vector(std::acos(0.9 * unit(random)), pi * unit(random));
    if (inward.dot(direction) <= 0) continue;
    const Vec3 axis = (module_radius + cable_radius) * Vec3(std::cos(azimuth), std::sin(azimuth), 0);
    double closest = 1e9;
    for (double back = 0; back < 1; back += 1e-4)
      closest = std::min(closest, (-module_radius * inward - back * direction - axis).head<2>().norm());
    if (std::abs(closest - cable_radius) < 1e-5) continue;  // the walk's own error is 1e-7 m
    ASSERT_EQ(cable_shadows(azimuth, direction, inward), closest < cable_radius);
    shadowed += closest < cable_radius;
  }
  EXPECT_GT(shadowed, 300);
}

}  // namespace
}  // namespace floe
