#include <gtest/gtest.h>

#include <random>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "geometry/clearance_map.h"
#include "geometry/module_scene.h"
#include "tests/unit/geometry/random_places.h"

namespace floe {
namespace {

using test::Random;
using test::random_direction;
using test::uniform;

// Near a module, anywhere in the array, or far outside.
Vec3 random_point(const Detector& detector, Random& random) {
  const auto& modules = detector.modules();
  const double kind = uniform(random, 0, 1);
  if (kind < 0.5)
    return modules[std::uniform_int_distribution<std::size_t>(0, modules.size() - 1)(random)].position +
           std::exp(uniform(random, -2, 4)) * random_direction(random);
  const auto [low, high] = detector.extent();
  const double margin = kind < 0.9 ? 20 : 2000;
  Vec3 point;
  for (int k = 0; k < 3; ++k) point[k] = uniform(random, low[k] - margin, high[k] + margin);
  return point;
}

const Module& nearest_module(const Detector& detector, const Vec3& point) {
  return *std::min_element(detector.modules().begin(), detector.modules().end(),
                           [&](const Module& a, const Module& b) {
                             return (a.position - point).squaredNorm() < (b.position - point).squaredNorm();
                           });
}

// Strings that lean and modules off their string: a map of mean positions would be wrong here.
Detector crooked_detector() {
  Random random(5);
  std::vector<Module> modules;
  for (int string = 1; string <= 7; ++string)
    for (int dom = 1; dom <= 40; ++dom) {
      Module module;
      module.id = {string, dom};
      module.position =
          Vec3(60.0 * string + 1.5 * dom, (string % 3) * 80.0 + uniform(random, -4, 4), -12.0 * dom);
      modules.push_back(module);
    }
  return Detector("crooked", modules);
}

class Clearance : public testing::TestWithParam<double> {
 protected:
  void expect_lower_bound(const Detector& detector, int points) const {
    const double oversize = GetParam();
    const ClearanceMap clearance(detector, oversize);
    const auto finder = make_embree_finder(detector, oversize);
    std::vector<std::size_t> column_of(detector.size());
    const auto columns = columns_of(detector);
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (const auto& [height, module] : columns[c].modules) column_of[module] = c;
    std::vector<ModuleCrossing> met;
    Random random(9);
    for (int k = 0; k < points; ++k) {
      const Vec3 point = random_point(detector, random);
      const float free = clearance(point.cast<float>());
      ASSERT_GE(free, 0);
      const Module& nearest = nearest_module(detector, point);
      // A landing point is within X radii of the centre.
      const double truth = (nearest.position - point).norm() - oversize * module_radius;
      ASSERT_LE(free, std::max(truth, 0.0)) << point.transpose();
      const Vec3f place = point.cast<float>();
      const ModuleClearance at = clearance.at(place.x(), place.y(), place.z());
      ASSERT_GE(at.free_of_others, at.free);
      if (at.free_of_others > at.free) {
        for (std::size_t i = 0; i < detector.size(); ++i) {
          const double distance = (detector.modules()[i].position - point).norm() - oversize * module_radius;
          if (column_of[i] == column_of[at.nearest]) continue;
          ASSERT_LE(at.free_of_others, std::max(distance, 0.0)) << point.transpose();
        }
      }
      const Vec3 towards = k % 2 ? random_direction(random) : (nearest.position - point).normalized();
      finder->find(point.cast<float>(), towards.cast<float>().normalized(), free, met);
      ASSERT_TRUE(met.empty()) << point.transpose();
    }
  }
};

TEST_P(Clearance, IsNeverLargerThanTheTruth) {
  expect_lower_bound(ic86_detector(), 40'000);
}

TEST_P(Clearance, HoldsForCrookedStrings) {
  expect_lower_bound(crooked_detector(), 100'000);
}

TEST_P(Clearance, IsNotMuchSmallerThanTheTruth) {
  const Detector detector = ic86_detector();
  const ClearanceMap clearance(detector, GetParam());
  const double reach = GetParam() * module_radius;
  Random random(10);
  for (int k = 0; k < 20'000; ++k) {
    const Vec3 point(uniform(random, -600, 600), uniform(random, -600, 600), uniform(random, -450, 450));
    double aside = 1e9;
    for (const auto& [string, centre] : detector.strings())
      aside = std::min(aside, (centre - point.head<2>()).norm());
    const double cell_diagonal = 2 * std::sqrt(2.0), step = 0.25;
    ASSERT_GE(clearance(point.cast<float>()), std::min(aside - cell_diagonal, 63.75) - step - reach - 0.01);
  }
  EXPECT_NEAR(clearance(Vec3f(0, 0, 5000)), 5000 - detector.extent().high.z() - reach, 64);
  EXPECT_GT(clearance(Vec3f(50'000, 0, 0)), 49'000);
}

INSTANTIATE_TEST_SUITE_P(ClearanceMap, Clearance, testing::Values(1.0, 5.0, 16.0), [](const auto& each) {
  return "Oversize" + std::to_string(static_cast<int>(each.param));
});

TEST(ClearanceMap, CopesWithOneModuleAndWithWideDetectors) {
  Module one, far;
  far.id = {2, 1};
  far.position = {9000, 9000, 0};
  const ClearanceMap single(Detector("one", {one}), 5);
  EXPECT_EQ(single(Vec3f::Zero()), 0);
  EXPECT_NEAR(single(Vec3f(0, 0, 100)), 100 - 5 * module_radius, 0.1);
  const ClearanceMap wide(Detector("wide", {one, far}), 5);
  EXPECT_EQ(wide(Vec3f(9000, 9000, 0)), 0);
  EXPECT_GT(wide(Vec3f(4500, 4500, 0)), 60);
  EXPECT_THROW(ClearanceMap(Detector("one", {one}), 0.5), UsageError);
}

}  // namespace
}  // namespace floe
