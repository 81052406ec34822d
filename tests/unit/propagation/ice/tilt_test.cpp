// LayerTilt on small grids with values worked out by hand, and its continuity everywhere.
#include "propagation/ice/tilt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "data/base/constants.h"
#include "data/base/vec3.h"
#include "tests/unit/propagation/ice/ice_directory.h"

namespace floe {
namespace {

using test::small_detector;

// Places on the line through string 86 along 225 deg.
Eigen::Vector2f along(double distance) {
  return Eigen::Vector2f(10 - distance * std::sqrt(0.5), -20 - distance * std::sqrt(0.5));
}
float height(double depth) {
  return static_cast<float>(origin_depth - depth);
}

class TiltLinesTest : public testing::Test {
 protected:
  // Columns at -500, 0 and 400 m.
  TiltLinesTest() {
    tables_.tilt_lines = TiltLines{
        {50, 86, 14}, {-500, 0, 400}, {1200, 1210, 1220}, {{-10, 0, 8}, {-15, 1, 12}, {-15, 0, 20}}};
    tilt_ = LayerTilt(tables_, small_detector());
  }
  float shift(double distance, double depth) const {
    const auto place = along(distance);
    return tilt_.shift(place.x(), place.y(), height(depth));
  }
  IceTables tables_;
  LayerTilt tilt_;
};

TEST_F(TiltLinesTest, TakesTabulatedValues) {
  EXPECT_FALSE(tilt_.is_flat());
  EXPECT_NEAR(shift(-500, 1200), -10, 1e-3);
  EXPECT_NEAR(shift(0, 1210), 1, 1e-3);
  EXPECT_NEAR(shift(400, 1220), 20, 1e-3);
}

TEST_F(TiltLinesTest, IsBilinearBetween) {
  EXPECT_NEAR(shift(-250, 1205), (-10 + 0 - 15 + 1) / 4.0, 1e-3);
  EXPECT_NEAR(shift(100, 1217.5), 0.75 * (0.25 * 1 + 0.75 * 0) + 0.25 * (0.25 * 12 + 0.75 * 20), 1e-3);
}

TEST_F(TiltLinesTest, ExtrapolatesLinearlyInBothDirections) {
  EXPECT_NEAR(shift(800, 1200), 16, 1e-3);
  EXPECT_NEAR(shift(-1000, 1210), 1 - 16 * 2, 1e-3);
  EXPECT_NEAR(shift(0, 1230), -1, 1e-3);
  EXPECT_NEAR(shift(400, 1190), 4, 1e-3);
}

TEST_F(TiltLinesTest, IsConstantAcross) {
  const auto place = along(200);
  const float across = 300;
  EXPECT_NEAR(tilt_.shift(place.x() + across, place.y() - across, height(1207)),
              tilt_.shift(place.x(), place.y(), height(1207)), 1e-3);
}

// Axes along x and y with steps of 100 and 50 m: index coordinates are easy to see. Of 4 x 3 points, the
// corners (2..3, 0), (3, 1) and (0, 2) are cut.
TiltMap square_map() {
  //                  (0,0) (1,0) (0,1) (1,1) (2,1) (1,2) (2,2) (3,2)
  return {{0, -100, 100, 4, 2},
          {90, 0, 50, 3, 2},
          {1200, 1210},
          {{0, 1, 2, 3, 4, 5, 6, 7}, {10, 1, 2, 3, 4, 5, 6, 7}}};
}

class TiltMapTest : public testing::Test {
 protected:
  TiltMapTest() {
    tables_.tilt_map = square_map();
    tilt_ = LayerTilt(tables_, small_detector());
  }
  float at(double i, double j, double depth = 1200) const {
    return tilt_.shift(static_cast<float>(-100 + 100 * i), static_cast<float>(50 * j), height(depth));
  }
  IceTables tables_;
  LayerTilt tilt_;
};

TEST_F(TiltMapTest, TakesTabulatedValues) {
  EXPECT_NEAR(at(0, 0), 0, 1e-4);
  EXPECT_NEAR(at(1, 0), 1, 1e-4);
  EXPECT_NEAR(at(0, 1), 2, 1e-4);
  EXPECT_NEAR(at(2, 1), 4, 1e-4);
  EXPECT_NEAR(at(1, 2), 5, 1e-4);
  EXPECT_NEAR(at(3, 2), 7, 1e-4);
  EXPECT_NEAR(at(0, 0, 1210), 10, 1e-4);
}

TEST_F(TiltMapTest, IsLinearInEachTriangle) {
  EXPECT_NEAR(at(0.5, 0.25), 0.5 * 0 + 0.25 * 1 + 0.25 * 3, 1e-4);  // below the diagonal
  EXPECT_NEAR(at(0.25, 0.5), 0.5 * 0 + 0.25 * 2 + 0.25 * 3, 1e-4);  // above it
  EXPECT_NEAR(at(0.5, 0.5), 1.5, 1e-4);                             // on it
}

TEST_F(TiltMapTest, ExtrapolatesDepthLinearly) {
  EXPECT_NEAR(at(0, 0, 1205), 5, 1e-3);
  EXPECT_NEAR(at(0, 0, 1230), 30, 1e-2);
  EXPECT_NEAR(at(0, 0, 1190), -10, 1e-2);
}

TEST_F(TiltMapTest, OutsideItHasTheNearestValueOfTheBorder) {
  EXPECT_NEAR(at(-3, 0.5), 1, 1e-4);     // left side, between 0 and 2
  EXPECT_NEAR(at(0.5, -10), 0.5, 1e-4);  // lower side
  EXPECT_NEAR(at(-2, -1), 0, 1e-4);      // corner
  EXPECT_NEAR(at(9, 9), 7, 1e-4);
  // Off the cut corner, straight (in space) from the middle of the border between (1,0) and (2,1), which
  // runs along (100, 50) m: step out along (50, -100) m.
  EXPECT_NEAR(at(1.5 + 0.5, 0.5 - 2), 2.5, 1e-4);
}

TEST_F(TiltMapTest, TakesPrecedenceOverLines) {
  auto both = tables_;
  both.tilt_lines = TiltLines{{50, 86}, {-500, 0}, {1200, 1210}, {{100, 100}, {100, 100}}};
  const LayerTilt tilt(both, small_detector());
  EXPECT_NEAR(tilt.shift(0, 0, height(1200)), at(1, 0), 1e-5);
}

TEST(LayerTilt, FlatWithoutTables) {
  EXPECT_TRUE(LayerTilt(IceTables{}, small_detector()).is_flat());
  EXPECT_EQ(LayerTilt().shift(1, 2, 3), 0);
}

// Random walks in small steps over and around the grid must not see a jump: along each step the shift
// changes by no more than the table's largest slope allows.
void expect_continuous(const LayerTilt& tilt, double reach, double largest_slope) {
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> horizontal(-reach, reach), vertical(-500, 500);
  double worst = 0;
  for (int walk = 0; walk < 400; ++walk) {
    double x = horizontal(random), y = horizontal(random), z = vertical(random);
    // Straight lines with a little noise cross many borders between cells.
    const double angle = pi * vertical(random) / 500, ux = 0.02 * std::cos(angle),
                 uy = 0.02 * std::sin(angle);
    double last = tilt.shift(x, y, z);
    for (int i = 0; i < 5000; ++i) {
      const double dx = ux + 0.01 * normal(random), dy = uy + 0.01 * normal(random),
                   dz = 0.01 * normal(random);
      x += dx, y += dy, z += dz;
      const double now = tilt.shift(x, y, z);
      worst = std::max(worst, std::abs(now - last) - largest_slope * std::hypot(dx, dy, dz));
      last = now;
    }
  }
  EXPECT_LT(worst, 1e-3);  // rounding of positions and shifts to floats
}

TEST(LayerTilt, IsContinuousOverTheWholePlane) {
  IceTables tables;
  tables.tilt_map = square_map();
  tables.tilt_map->depths = {1000, 3000};  // no extrapolation on the walks
  expect_continuous(LayerTilt(tables, small_detector()), 400,
                    0.25);  // at most 10 m over 50 m, and over 100 m
}

// Slopes of the public models stay below 0.2 m/m in the instrumented depths.
TEST(LayerTilt, PublicMapIsContinuousOverTheWholePlane) {
  FLOE_NEEDS_PUBLIC_ICE("spice_ftp-v3m");
  const auto tables = read_ice_tables(test::public_ice("spice_ftp-v3m"));
  expect_continuous(LayerTilt(tables, small_detector()), 900, 0.5);
}

TEST(LayerTilt, PublicLinesAreContinuousOverTheWholePlane) {
  FLOE_NEEDS_PUBLIC_ICE("spice_bfr-v2");
  const auto tables = read_ice_tables(test::public_ice("spice_bfr-v2"));
  expect_continuous(LayerTilt(tables, small_detector()), 900, 0.5);
}

}  // namespace
}  // namespace floe
