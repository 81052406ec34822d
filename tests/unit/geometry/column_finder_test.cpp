// The finder of one column against trying every module, of which those of the column are kept.
#include "geometry/column_finder.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "tests/unit/geometry/column_detectors.h"
#include "tests/unit/geometry/random_places.h"
#include "tests/unit/geometry/segment.h"

namespace floe {
namespace {

using test::Random;
using test::random_direction;
using test::Segment;
using test::uniform;

// Passes a module of the column near its widened radius; the slope, the lead and the length are of all
// kinds: vertical and horizontal ones, ones without length, ones that end about where they meet the module.
Segment segment_near(const Detector& detector, const ModuleColumn& column, double oversize, Random& random) {
  const std::size_t which = std::uniform_int_distribution<std::size_t>(0, column.modules.size() - 1)(random);
  const Vec3 centre = detector.modules()[column.modules[which].second].position;
  const double radius = oversize * module_radius, kind = uniform(random, 0, 1);
  Vec3 direction = random_direction(random);
  if (kind < 0.1) direction = Vec3(0, 0, kind < 0.05 ? 1 : -1);
  if (kind > 0.9) direction = unit_vector(pi / 2, uniform(random, 0, 2 * pi));
  if (kind > 0.95) direction.z() = 0;  // not even the last digit of it
  if (kind > 0.1 && kind < 0.2)
    direction = (direction * 0.01 + Vec3(0, 0, kind < 0.15 ? 1 : -1)).normalized();
  const Vec3 target = centre + 1.2 * radius * std::cbrt(uniform(random, 0, 1)) * random_direction(random);
  const double near = uniform(random, 0, 1);
  const double lead = near < 0.5    ? uniform(random, -2, 4) * radius
                      : near < 0.95 ? uniform(random, 0, 80)
                                    : uniform(random, 0, 3000);
  double length = near < 0.3 ? uniform(random, 0, 6) * radius : lead + uniform(random, -1, 1) * radius;
  if (near > 0.9) length = 2 * lead;
  if (near < 0.02) length = 0;
  return {(target - lead * direction).cast<float>(), direction.cast<float>().normalized(),
          static_cast<float>(std::max(length, 0.0))};
}

// How much of the comparison was about something.
struct Counts {
  std::size_t compared = 0, met = 0, several = 0;
};

// From each segment `starts` random modules of its column are asked.
void compare(const Detector& detector, double oversize, int segments, int starts, Random& random,
             Counts& counts) {
  const auto exhaustive = make_exhaustive_finder(detector, oversize);
  const ColumnFinder finder(detector, oversize);
  const auto columns = columns_of(detector);
  std::vector<std::size_t> column_of(detector.size());
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (const auto& [height, module] : columns[c].modules) column_of[module] = c;
  std::vector<ModuleCrossing> all, expected, found;
  for (int i = 0; i < segments; ++i) {
    const std::size_t c = std::uniform_int_distribution<std::size_t>(0, columns.size() - 1)(random);
    const Segment segment = segment_near(detector, columns[c], oversize, random);
    all.clear();
    expected.clear();
    exhaustive->find(segment.origin, segment.direction, segment.length, all);
    std::copy_if(all.begin(), all.end(), std::back_inserter(expected),
                 [&](const ModuleCrossing& crossing) { return column_of[crossing.module] == c; });
    for (int s = 0; s < starts; ++s) {
      const std::size_t start =
          std::uniform_int_distribution<std::size_t>(0, columns[c].modules.size() - 1)(random);
      // What is there already stays there, in front.
      found.assign(1, ModuleCrossing{12345, -1, Vec3f::Zero()});
      finder.find(columns[c].modules[start].second, segment.origin, segment.direction, segment.length, found);
      ASSERT_EQ(found[0].module, 12345U);
      ASSERT_EQ(found.size() - 1, expected.size())
          << "from " << segment.origin.transpose() << " along " << segment.direction.transpose() << " over "
          << segment.length << " m, oversize " << oversize << ", asked at place " << start << " of "
          << columns[c].modules.size();
      for (std::size_t k = 0; k < expected.size(); ++k) {
        ASSERT_EQ(found[k + 1].module, expected[k].module);
        ASSERT_EQ(found[k + 1].distance, expected[k].distance);
        ASSERT_EQ(found[k + 1].inward, expected[k].inward);
      }
      ++counts.compared;
    }
    counts.met += !expected.empty();
    counts.several += expected.size() > 1;
  }
}

class ColumnFinderAgainstExhaustive : public testing::TestWithParam<double> {};

TEST_P(ColumnFinderAgainstExhaustive, OnOneStringOfIc86) {
  // Its own string and, for what must be left out, those around.
  const Detector whole = ic86_detector();
  std::vector<Module> part;
  for (const Module& module : whole.modules())
    if (module.id.string == 36 || module.id.string >= 83) part.push_back(module);
  Random random(1);
  Counts counts;
  compare(Detector("part", part), GetParam(), 200000, 4, random, counts);
  EXPECT_EQ(counts.compared, 800000U);
  EXPECT_GT(counts.met, 50000U);
  EXPECT_GT(counts.several, GetParam() > 1 ? 5000U : 500U);
}

TEST_P(ColumnFinderAgainstExhaustive, OnLeaningStrings) {
  for (const double lean : {0.5, 3.0, 10.0}) {
    Random random(2);
    Counts counts;
    compare(test::leaning_detector(lean * degree), GetParam(), 100000, 3, random, counts);
    EXPECT_GT(counts.met, 25000U);
  }
}

// Columns as wide as they get, modules of a column at nearly the same height.
TEST_P(ColumnFinderAgainstExhaustive, OnScatteredModules) {
  Random random(3);
  Counts counts;
  const Detector detector = test::scattered_detector(random, 200, 10);
  compare(detector, GetParam(), 100000, 3, random, counts);
  EXPECT_GT(counts.met, 25000U);
  EXPECT_GT(counts.several, GetParam() > 1 ? 1000U : 20U);
}

// A vertical line through a whole string, both ways, from every module of it.
TEST_P(ColumnFinderAgainstExhaustive, AlongAWholeString) {
  const Detector detector = ic86_detector();
  const ColumnFinder finder(detector, GetParam());
  for (const ModuleColumn& column : columns_of(detector))
    for (const float way : {1.0F, -1.0F}) {
      const Vec3f origin(column.x + 0.1F, column.y, -way * 1000), direction(0, 0, way);
      for (const auto& [height, module] : column.modules) {
        std::vector<ModuleCrossing> found;
        finder.find(module, origin, direction, 2000, found);
        ASSERT_EQ(found.size(), column.modules.size());
        for (std::size_t k = 0; k < found.size(); ++k)
          ASSERT_EQ(found[k].module, column.modules[way > 0 ? k : found.size() - 1 - k].second);
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Oversizes, ColumnFinderAgainstExhaustive, testing::Values(1.0, 5.0, 16.0));

TEST(ColumnFinder, RefusesAnOversizeOutOfRange) {
  const Detector detector = test::leaning_detector(0);
  EXPECT_THROW(ColumnFinder(detector, 0.99), UsageError);
  EXPECT_THROW(ColumnFinder(detector, 101), UsageError);
}

}  // namespace
}  // namespace floe
