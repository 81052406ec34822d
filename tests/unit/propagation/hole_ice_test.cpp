// Paths through hole-ice columns: against walking along them in small steps, and where rounding matters.
#include "propagation/engine/hole_ice.h"

#include <gtest/gtest.h>

#include "data/base/constants.h"
#include "propagation/engine/simulator.h"
#include "tests/physics/engine/test_scenes.h"
#include "tests/unit/geometry/random_places.h"
#include "tests/unit/propagation/ice/ice_directory.h"

namespace floe {
namespace {

using test::make_model;
using test::Random;
using test::random_direction;
using test::uniform;
using test::uniform_tables;

constexpr double radius = 2 * module_radius;

HoleIceColumns columns_around(const std::vector<Vec3>& strings, double module_radii = 2) {
  IceTables tables = uniform_tables({});
  tables.configuration.hole_ice = {module_radii, 0.03, 100, 0.35, 0.9};
  return HoleIceColumns(make_model(tables, strings));
}

double axis_distance(const Vec3& place, const Vec3& axis) {
  return (place - axis).head<2>().norm();
}

// A cluster, two of them overlapping, and one far away. Heights differ: the modules do not.
const std::vector<Vec3> strings = {{0, 0, 0},     {0.5, 0.1, 3},  {3, 1, 6},    {-2, 4, 9},
                                   {5, -5, 12},   {-4, -3, 15},   {40, 60, 18}, {1.5, -2.5, 21},
                                   {400, -30, 0}, {-300, -200, 3}};

bool inside_any(const Vec3& place) {
  return std::any_of(strings.begin(), strings.end(),
                     [&](const Vec3& axis) { return axis_distance(place, axis) < radius; });
}

TEST(HoleIceColumns, FirstIsWhatStepsAlongThePathFind) {
  const HoleIceColumns columns = columns_around(strings);
  Random random(1);
  constexpr double step = 1e-3, tolerance = 2 * step;
  int met = 0, started_inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 origin(uniform(random, -7, 7), uniform(random, -7, 7), uniform(random, -50, 50));
    const Vec3 direction = random_direction(random);
    const double length = uniform(random, 0, 20), sine = direction.head<2>().norm();
    double entry = -1;
    for (double t = 0; t <= length && entry < 0; t += step)
      if (inside_any(origin + t * direction)) entry = t;
    const auto found = columns.first(origin, direction, length);
    if (!found) {  // at most a chord shorter than the tolerance was there, or the path's very end
      if (entry >= 0 && entry < length - tolerance) {
        const Vec3 later = origin + (entry + 0.02 / sine) * direction;
        EXPECT_FALSE(inside_any(later)) << i;
      }
      continue;
    }
    ++met;
    started_inside += found->entry == 0;
    ASSERT_LE(found->entry, length);
    ASSERT_LT(found->entry, found->exit);
    if (entry >= 0) {
      // Steps may miss a short chord and find a later column; they never find one sooner.
      EXPECT_GT(entry, found->entry - 2e-4 / sine - 1e-9) << i;
    }
    const double middle = (found->entry + found->exit) / 2;
    EXPECT_TRUE(inside_any(origin + middle * direction)) << i;
    EXPECT_EQ(found->entry > 0, !inside_any(origin)) << i;
    if (found->exit - found->entry > 3 * step) {
      EXPECT_NEAR(entry, found->entry, tolerance) << i;
    }
  }
  EXPECT_GT(met, 200);
  EXPECT_GT(started_inside, 20);
}

TEST(HoleIceColumns, ChordsAreThoseOfACylinder) {
  const HoleIceColumns columns = columns_around({Vec3(1, 2, 0)});
  Random random(2);
  // Horizontal rays at uniform impact distances: P(chord > c) = sqrt(1 - (c/2R)^2); the largest distance
  // of the empirical distribution from it is below 1.95/sqrt(N) with probability 0.999.
  constexpr int N = 20000;
  std::vector<double> chords;
  double mean_chord = 0;
  for (int i = 0; i < N; ++i) {
    const double azimuth = uniform(random, 0, 2 * pi), impact = uniform(random, -radius, radius);
    const Vec3 direction(std::cos(azimuth), std::sin(azimuth), 0), aside(-direction.y(), direction.x(), 0);
    const Vec3 origin = Vec3(1, 2, 0) + impact * aside - 30 * direction;
    const auto found = columns.first(origin, direction, 100);
    chords.push_back(found ? found->exit - found->entry : 0);
    mean_chord += chords.back() / N;
  }
  std::sort(chords.begin(), chords.end());
  double largest = 0;
  for (int i = 0; i < N; ++i) {
    const double share =
        std::sqrt(std::max(0.0, 1 - std::pow(chords[static_cast<std::size_t>(i)] / 2 / radius, 2)));
    largest = std::max(largest, std::abs(1 - share - (i + 0.5) / N));
  }
  EXPECT_LT(largest, 1.95 / std::sqrt(N));
  EXPECT_NEAR(mean_chord, pi * radius / 2, 4 * 0.45 * radius / std::sqrt(N));
}

// In isotropic light the mean chord is 4 volume/surface = 2 R.
TEST(HoleIceColumns, MeanChordInIsotropicLightIsTheDiameter) {
  const HoleIceColumns columns = columns_around({Vec3(1, 2, 0)});
  Random random(3);
  double flux = 0, path = 0;
  for (int i = 0; i < 100000; ++i) {
    const Vec3 direction = random_direction(random);
    const double sine = direction.head<2>().norm(), impact = uniform(random, -radius, radius);
    if (sine < 1e-3) continue;
    const Vec3 aside = Vec3(-direction.y(), direction.x(), 0) / sine;
    const auto found = columns.first(Vec3(1, 2, 0) + impact * aside - 5 / sine * direction, direction, 1e7);
    flux += sine;
    path += sine * (found ? found->exit - found->entry : 0);
  }
  EXPECT_NEAR(path / flux, 2 * radius, 0.01 * radius);
}

TEST(HoleIceColumns, VerticalPathsStayInOrOut) {
  const HoleIceColumns columns = columns_around({Vec3(0, 0, 0)});
  for (const double slope : {1.0, -1.0}) {
    const auto inside = columns.first({0.1, 0.1, 5}, {0, 0, slope}, 10);
    ASSERT_TRUE(inside);
    EXPECT_EQ(inside->entry, 0);
    EXPECT_EQ(inside->exit, HoleIceColumns::endless);
    EXPECT_FALSE(columns.first({0.3, 0.3, 5}, {0, 0, slope}, 1000));
  }
  // Almost vertical: leaves where the slant has carried it to the surface.
  const double sine = 1e-5;
  const auto slanted = columns.first({0, 0, 0}, Vec3(sine, 0, std::sqrt(1 - sine * sine)), 10);
  ASSERT_TRUE(slanted);
  EXPECT_NEAR(slanted->exit, radius / sine, 1e-6 * radius / sine);
}

// Metres of a path inside any column, from the closed intervals of each.
double path_inside(const std::vector<Vec3>& axes, const Vec3& origin, const Vec3& direction, double length) {
  const double sine = direction.head<2>().norm();
  std::vector<std::pair<double, double>> intervals;
  for (const Vec3& axis : axes) {
    const Vec3 ahead = axis - origin;
    const double along = ahead.head<2>().dot(direction.head<2>()) / sine;
    const double square = radius * radius - ahead.head<2>().squaredNorm() + along * along;
    if (square <= 0) continue;
    const double low = std::max(0.0, (along - std::sqrt(square)) / sine);
    const double high = std::min(length, (along + std::sqrt(square)) / sine);
    if (low < high) intervals.emplace_back(low, high);
  }
  std::sort(intervals.begin(), intervals.end());
  double inside = 0, covered = 0;
  for (const auto& [low, high] : intervals) {
    inside += std::max(0.0, high - std::max(low, covered));
    covered = std::max(covered, high);
  }
  return inside;
}

// Paths that end on a surface, rounded as the vector engine rounds: they go on into the column or out of
// it, and a photon that goes straight on is as long inside as the columns are wide.
TEST(HoleIceColumns, PathsFromSurfaceToSurfaceAdvance) {
  const std::vector<Vec3> far = {{480, 330, 0}, {480.4, 330.2, 3}, {481.5, 329, 6}, {479, 331, 9}};
  const HoleIceColumns columns = columns_around(far);
  Random random(4);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 direction = random_direction(random).cast<float>().cast<double>();
    Vec3 place = Vec3(480.5, 330, 200) + Vec3(uniform(random, -1.5, 1.5), uniform(random, -1.5, 1.5), 0);
    place = (place - uniform(random, 0, 3) * direction).cast<float>().cast<double>();
    const double length = 40, expected = path_inside(far, place, direction, length);
    double inside = 0, left = length;
    for (int pieces = 0; left > 0; ++pieces) {
      ASSERT_LT(pieces, 12) << i;  // four columns, two of them overlapping, and what lies between
      const auto found = columns.first(place, direction, left);
      const double piece = std::min(left, !found ? left : found->entry > 0 ? found->entry : found->exit);
      if (found && found->entry == 0) inside += piece;
      left -= piece;
      place = (place + piece * direction).cast<float>().cast<double>();
    }
    // Rounding moves the path aside by 1e-4 at most, which matters most where it grazes.
    const double sine = direction.head<2>().norm();
    ASSERT_NEAR(inside, expected, 3 * std::sqrt(2e-4 * radius) / sine + 1e-3) << i;
  }
}

TEST(HoleIceColumns, FreeIsALowerBoundAndSharpNearby) {
  const HoleIceColumns columns = columns_around(strings);
  Random random(5);
  for (int i = 0; i < 100000; ++i) {
    const double spread = i % 2 ? 8 : 700;
    const Vec3 place(uniform(random, -spread, spread), uniform(random, -spread, spread), 0);
    double exact = 1e9;
    for (const Vec3& axis : strings) exact = std::min(exact, axis_distance(place, axis) - radius);
    const float free = columns.free(static_cast<float>(place.x()), static_cast<float>(place.y()));
    ASSERT_LE(free, std::max(0.0, exact)) << place.transpose();
    ASSERT_GE(free, 0);
  }
  const HoleIceColumns alone = columns_around({Vec3(20, -30, 0)});
  EXPECT_NEAR(alone.free(21, -30), 1 - radius, 0.01);
  EXPECT_NEAR(alone.free(30, -30), 10 - radius, 0.01);
  EXPECT_NEAR(alone.free(520, -30), 500 - radius, 0.1);
}

TEST(HoleIceColumns, RadiusZeroIsNone) {
  EXPECT_FALSE(columns_around(strings, 0).exist());
  EXPECT_TRUE(columns_around(strings, 0.5).exist());
}

TEST(HoleIceWarning, IsGivenForWidenedModules) {
  IceTables tables = uniform_tables({});
  tables.configuration.hole_ice.radius = 2;
  const Model with = make_model(tables, strings);
  const auto warnings = simulation_warnings(with, 5);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("hole-ice column"), std::string::npos);
  EXPECT_NE(warnings[0].find("--oversize 1"), std::string::npos);
  EXPECT_TRUE(simulation_warnings(with, 1).empty());
  tables.configuration.hole_ice.radius = 0;
  EXPECT_TRUE(simulation_warnings(make_model(tables, strings), 5).empty());
}

// Where str-f2k gives a drill hole's centre, the column stands there, else around its modules' mean.
TEST(HoleIceColumns, StandWhereTheDirectoryPutsThem) {
  const test::IceDirectory directory;
  directory.write("geo-f2k",
                  "aa01 0x1 10 -20 -1848.07 86 1\n"
                  "aa02 0x2 11 -20 -1868.07 86 2\n");
  directory.write("as.dat", "0.68\n0.34\n0.21\n");
  directory.write("wv.dat", "0 300\n0.5 400\n1 600\n");
  std::string configuration = test::configuration_text;
  configuration.replace(configuration.find("0 # none"), 8, "1 # radius");
  directory.write("cfg.txt", configuration);
  ModelRequest request;
  request.ice = directory.path().string();
  const auto entry = [&](double y) {
    const auto found = HoleIceColumns(load_model(request)).first({0, y, 80}, Vec3::UnitX(), 100);
    return found ? found->entry : -1;
  };
  EXPECT_NEAR(entry(-20), 10.5 - module_radius, 1e-9);
  directory.write("str-f2k", "86 12 -22\n");
  EXPECT_EQ(entry(-20), -1);
  EXPECT_NEAR(entry(-22), 12 - module_radius, 1e-9);
}

}  // namespace
}  // namespace floe
