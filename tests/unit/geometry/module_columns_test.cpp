// Vertical columns of modules: each module in exactly one, none wider than 3 m.
#include "geometry/module_columns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/unit/geometry/column_detectors.h"
#include "tests/unit/geometry/random_places.h"

namespace floe {
namespace {

constexpr float widest = 3;  // [m]

void expect_to_be_columns_of(const Detector& detector, const std::vector<ModuleColumn>& columns) {
  std::vector<int> seen(detector.size());
  for (const ModuleColumn& column : columns) {
    ASSERT_FALSE(column.modules.empty());
    EXPECT_LE(column.radius, widest);
    EXPECT_TRUE(std::is_sorted(column.modules.begin(), column.modules.end()));
    double farthest = 0;
    for (const auto& [height, module] : column.modules) {
      ASSERT_LT(module, detector.size());
      ++seen[module];
      const Vec3f position = detector.modules()[module].position.cast<float>();
      EXPECT_EQ(height, position.z());
      farthest = std::max(farthest, std::hypot(double{position.x()} - double{column.x},
                                               double{position.y()} - double{column.y}));
    }
    // It covers its modules and is no wider than they are, but for the last digit.
    EXPECT_NEAR(column.radius, farthest, 1e-6);
  }
  for (std::size_t module = 0; module < seen.size(); ++module) EXPECT_EQ(seen[module], 1) << module;
}

TEST(ModuleColumns, OfIc86AreItsStrings) {
  const Detector detector = ic86_detector();
  const auto columns = columns_of(detector);
  expect_to_be_columns_of(detector, columns);
  ASSERT_EQ(columns.size(), 86U);
  std::set<int> strings;
  for (const ModuleColumn& column : columns) {
    std::set<int> within;
    for (const auto& [height, module] : column.modules) within.insert(detector.modules()[module].id.string);
    EXPECT_EQ(within.size(), 1U);
    EXPECT_EQ(column.modules.size(), 60U);
    strings.insert(within.begin(), within.end());
  }
  EXPECT_EQ(strings.size(), 86U);
}

TEST(ModuleColumns, ALeaningStringFallsIntoSeveral) {
  for (const double lean : {2.0, 8.0, 20.0}) {
    const Detector detector = test::leaning_detector(lean * degree);
    const auto columns = columns_of(detector);
    expect_to_be_columns_of(detector, columns);
    // Each string spans 59 x 17 m x tan(lean); a column covers at most twice its radius of it.
    const double span = 59 * 17 * std::tan(lean * degree);
    EXPECT_GE(static_cast<double>(columns.size()),
              std::min(static_cast<double>(detector.size()), 3 * span / (2 * widest)))
        << lean;
  }
}

// Strings 2 m apart share a column, where their modules lie at mixed heights; 3.1 m apart they do not.
TEST(ModuleColumns, NeighboursShareOneWithinThreeMetres) {
  for (const double apart : {2.0, 3.1}) {
    std::vector<Module> modules;
    for (int string = 1; string <= 2; ++string)
      for (int dom = 1; dom <= 10; ++dom) {
        Module module;
        module.id = {string, dom};
        module.position = Vec3((string - 1) * apart, -7, 100 - 5 * dom - 2 * string);
        modules.push_back(module);
      }
    const Detector detector("neighbours", modules);
    const auto columns = columns_of(detector);
    expect_to_be_columns_of(detector, columns);
    EXPECT_EQ(columns.size(), apart < widest ? 1U : 2U);
  }
}

// On both sides of the axes and of every square's border by which neighbours are looked up.
TEST(ModuleColumns, HoldScatteredModules) {
  test::Random random(1);
  for (const double size : {4.0, 12.0, 100.0}) {
    const Detector detector = test::scattered_detector(random, 400, size);
    const auto columns = columns_of(detector);
    expect_to_be_columns_of(detector, columns);
    // Founders are farther than 3 m from each other.
    for (std::size_t i = 0; i < columns.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GT(std::hypot(columns[i].x - columns[j].x, columns[i].y - columns[j].y), widest - 1e-4F);
  }
}

TEST(ModuleColumns, OfOneModule) {
  Module module;
  module.id = {1, 1};
  module.position = {-0.5, 1e4, -3};
  const auto columns = columns_of(Detector("one", {module}));
  ASSERT_EQ(columns.size(), 1U);
  EXPECT_EQ(columns[0].radius, 0);
  EXPECT_EQ(columns[0].modules.size(), 1U);
}

}  // namespace
}  // namespace floe
