#include "geometry/module_scene.h"

#include <gtest/gtest.h>

#include <random>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "tests/unit/geometry/random_places.h"
#include "tests/unit/geometry/segment.h"

namespace floe {
namespace {

using test::Random;
using test::random_direction;
using test::Segment;
using test::uniform;

// String 36 and half of DeepCore: few enough for the plain finder, and more crowded than anywhere else.
Detector crowded_part() {
  const Detector whole = ic86_detector();
  std::vector<Module> part;
  for (const Module& module : whole.modules())
    if (module.id.string == 36 || module.id.string >= 83) part.push_back(module);
  return Detector("crowded part", part);
}

// A segment that passes a module, mostly within its widened radius, and starts and ends at any place
// along the line, often near the module's surface.
Segment segment_near(const Detector& detector, double oversize, Random& random) {
  const auto& modules = detector.modules();
  const Vec3 centre =
      modules[std::uniform_int_distribution<std::size_t>(0, modules.size() - 1)(random)].position;
  const double radius = oversize * module_radius;
  const Vec3 direction = random_direction(random);
  const Vec3 target = centre + 1.2 * radius * std::cbrt(uniform(random, 0, 1)) * random_direction(random);
  const bool close = uniform(random, 0, 1) < 0.5;
  const double lead = close ? uniform(random, -2, 4) * radius : uniform(random, 0, 80);
  const double length = close ? uniform(random, 0, 6) * radius : lead + uniform(random, -1, 1);
  return {(target - lead * direction).cast<float>(), direction.cast<float>().normalized(),
          static_cast<float>(std::max(length, 0.0))};
}

Segment segment_anywhere(const Detector& detector, Random& random) {
  const auto [low, high] = detector.extent();
  Vec3 origin;
  for (int k = 0; k < 3; ++k) origin[k] = uniform(random, low[k] - 50, high[k] + 50);
  return {origin.cast<float>(), random_direction(random).cast<float>().normalized(),
          static_cast<float>(std::exp(uniform(random, -3, 7)))};
}

// Nearly along a string, so that it meets many modules.
Segment segment_along_string(const Detector& detector, double oversize, Random& random) {
  const auto& strings = detector.strings();
  const auto string = std::next(
      strings.begin(), std::uniform_int_distribution<int>(0, static_cast<int>(strings.size()) - 1)(random));
  const double radius = 0.5 * oversize * module_radius;
  const Vec3 top(string->second.x() + uniform(random, -radius, radius),
                 string->second.y() + uniform(random, -radius, radius), uniform(random, -600, 600));
  const double tilt = uniform(random, 0, 0.01) + (uniform(random, 0, 1) < 0.5 ? 0 : pi);
  return {top.cast<float>(), unit_vector(tilt, uniform(random, 0, 2 * pi)).cast<float>().normalized(),
          static_cast<float>(uniform(random, 0, 1200))};
}

Segment random_segment(const Detector& detector, double oversize, Random& random) {
  const double kind = uniform(random, 0, 1);
  if (kind < 0.7) return segment_near(detector, oversize, random);
  if (kind < 0.9) return segment_anywhere(detector, random);
  return segment_along_string(detector, oversize, random);
}

// Same modules in the same order at the same places; false (with a message) otherwise.
bool same_answer(const ModuleFinder& one, const ModuleFinder& other, const Segment& segment,
                 std::size_t& crossings, std::size_t& most) {
  static thread_local std::vector<ModuleCrossing> a, b;
  a.clear();
  b.clear();
  one.find(segment.origin, segment.direction, segment.length, a);
  other.find(segment.origin, segment.direction, segment.length, b);
  crossings += b.size();
  most = std::max(most, b.size());
  bool same = a.size() == b.size();
  for (std::size_t k = 0; same && k < a.size(); ++k)
    same = a[k].module == b[k].module && std::abs(a[k].distance - b[k].distance) < 1e-4F &&
           (a[k].inward - b[k].inward).norm() < 1e-4F;
  EXPECT_TRUE(same) << a.size() << " against " << b.size() << " modules from " << segment.origin.transpose()
                    << " along " << segment.direction.transpose() << " over " << segment.length << " m";
  return same;
}

class EmbreeAgainstExhaustive : public testing::TestWithParam<double> {};

TEST_P(EmbreeAgainstExhaustive, OnAMillionSegments) {
  const double oversize = GetParam();
  const Detector detector = crowded_part();
  const auto embree = make_embree_finder(detector, oversize);
  const auto plain = make_exhaustive_finder(detector, oversize);
  Random random(36);
  std::size_t crossings = 0, most = 0;
  for (int k = 0; k < 1'000'000; ++k)
    if (!same_answer(*embree, *plain, random_segment(detector, oversize, random), crossings, most)) return;
  EXPECT_GT(crossings, 500'000U);  // the comparison is not about empty answers
  EXPECT_GT(most, 40U);
}

TEST_P(EmbreeAgainstExhaustive, OnTheWholeDetector) {
  const double oversize = GetParam();
  const Detector detector = ic86_detector();
  const auto embree = make_embree_finder(detector, oversize);
  const auto plain = make_exhaustive_finder(detector, oversize);
  Random random(86);
  std::size_t crossings = 0, most = 0;
  for (int k = 0; k < 10'000; ++k)
    if (!same_answer(*embree, *plain, random_segment(detector, oversize, random), crossings, most)) return;
  EXPECT_GT(crossings, 5'000U);
}

INSTANTIATE_TEST_SUITE_P(ModuleFinder, EmbreeAgainstExhaustive, testing::Values(1.0, 5.0, 16.0),
                         [](const auto& each) {
                           return "Oversize" + std::to_string(static_cast<int>(each.param));
                         });

// The widened module is an ellipsoid, R along the photon and X R across it, that the photon enters at the
// smaller root of (u + t)^2 + |across/X|^2 = R^2.
struct Ellipsoid {
  Ellipsoid(const Vec3f& centre, double oversize, const Segment& segment)
      : along(segment.direction.cast<double>().normalized()) {
    const Vec3 offset = segment.origin.cast<double>() - centre.cast<double>();
    const double u = offset.dot(along);
    const Vec3 across = (offset - u * along) / oversize;
    discriminant = 4 * (u * u - offset.dot(along) * u - across.squaredNorm() + module_radius * module_radius);
    if (discriminant < 0) return;
    t = -u - std::sqrt(discriminant) / 2;
    landing_on_sphere = (u + t) * along + across;
  }
  Vec3 along, landing_on_sphere = Vec3::Zero();  // relative to the centre
  double discriminant, t = -1;
};

// The segments lie in memory before they are used: some versions of g++ 12 otherwise carry the numbers on
// in double precision past their conversion to float, and the two calculations would start from
// different points.
std::vector<Segment> segments_around(const Vec3f& centre, double oversize, int number, Random& random) {
  const double radius = oversize * module_radius;
  std::vector<Segment> segments;
  for (int k = 0; k < number; ++k) {
    const Vec3 origin = centre.cast<double>() + radius * uniform(random, 0, 3) * random_direction(random);
    segments.push_back({origin.cast<float>(), random_direction(random).cast<float>().normalized(),
                        static_cast<float>(uniform(random, 0, 5 * radius))});
  }
  return segments;
}

TEST(CrossModule, AgreesWithTheEllipsoidOfTheWidenedModule) {
  Random random(1);
  const Vec3f centre(100, -200, 300);
  int crossed = 0;
  for (const float oversize : {1.0F, 1.7F, 5.0F, 16.0F, 40.0F})
    for (const Segment& segment : segments_around(centre, oversize, 50'000, random)) {
      const Ellipsoid expected(centre, oversize, segment);
      const double t = expected.t;
      // Within rounding of an edge either answer is right.
      if (std::abs(expected.discriminant) < 1e-9 || std::abs(t) < 1e-6 || std::abs(t - segment.length) < 1e-5)
        continue;
      ModuleCrossing crossing{7, -1, Vec3f::Zero()};
      const bool met =
          cross_module(centre, oversize, segment.origin, segment.direction, segment.length, crossing);
      ASSERT_EQ(met, expected.discriminant > 0 && t > 0 && t <= segment.length);
      if (!met) continue;
      ++crossed;
      EXPECT_EQ(crossing.module, 7U);
      EXPECT_NEAR(crossing.distance, t, 1e-5);
      EXPECT_LT((crossing.inward.cast<double>() + expected.landing_on_sphere / module_radius).norm(), 1e-5);
    }
  EXPECT_GT(crossed, 10'000);
}

TEST(CrossModule, InwardIsAUnitVectorAlongThePhoton) {
  Random random(2);
  for (const float oversize : {1.0F, 5.0F, 16.0F})
    for (int k = 0; k < 100'000; ++k) {
      const Vec3 direction = random_direction(random);
      const Vec3 origin = 3 * oversize * module_radius * random_direction(random);
      ModuleCrossing crossing{0, 0, Vec3f::Zero()};
      if (!cross_module(Vec3f::Zero(), oversize, origin.cast<float>(), direction.cast<float>(), 1e3F,
                        crossing))
        continue;
      ASSERT_NEAR(crossing.inward.norm(), 1, 1e-6);
      ASSERT_GE(crossing.inward.dot(direction.cast<float>()), -1e-6F);
    }
}

TEST(CrossModule, HeadOnThePhotonLandsOnTheNearestPoint) {
  ModuleCrossing crossing{};
  const float radius = static_cast<float>(module_radius);
  ASSERT_TRUE(cross_module(Vec3f(10, 0, 0), 5, Vec3f::Zero(), Vec3f::UnitX(), 20, crossing));
  EXPECT_NEAR(crossing.distance, 10 - radius, 1e-6);
  EXPECT_TRUE(crossing.inward.isApprox(Vec3f::UnitX(), 1e-6F));
  // Half of the widened radius aside: lands where the nominal sphere is met at half its radius.
  ASSERT_TRUE(cross_module(Vec3f(10, 2.5F * radius, 0), 5, Vec3f::Zero(), Vec3f::UnitX(), 20, crossing));
  EXPECT_NEAR(crossing.distance, 10 - radius * std::sqrt(0.75F), 1e-6);
  EXPECT_TRUE(crossing.inward.isApprox(Vec3f(std::sqrt(0.75F), 0.5F, 0), 1e-6F));
}

class BothFinders : public testing::TestWithParam<bool> {
 protected:
  std::unique_ptr<ModuleFinder> make(const Detector& detector, double oversize) const {
    return GetParam() ? make_embree_finder(detector, oversize) : make_exhaustive_finder(detector, oversize);
  }
  static std::vector<ModuleCrossing> found(const ModuleFinder& finder, const Segment& segment) {
    std::vector<ModuleCrossing> crossings;
    finder.find(segment.origin, segment.direction, segment.length, crossings);
    return crossings;
  }
};

TEST_P(BothFinders, SegmentEndsCountExactly) {
  Module module;
  module.position = {10, 0, 0};
  const auto finder = make(Detector("one", {module}), 5);
  const float landing = 10 - static_cast<float>(module_radius);
  const auto met = [&](float start, float length) {
    return found(*finder, {Vec3f(start, 0, 0), Vec3f::UnitX(), length}).size();
  };
  EXPECT_EQ(met(0, landing + 1e-4F), 1U);
  EXPECT_EQ(met(0, landing - 1e-4F), 0U);
  EXPECT_EQ(met(landing - 1e-4F, 1), 1U);  // starts just in front of the surface
  EXPECT_EQ(met(landing + 1e-4F, 1), 0U);  // starts just behind it
  EXPECT_EQ(met(11, 100), 0U);             // looks away
  EXPECT_EQ(met(0, 0), 0U);
}

TEST_P(BothFinders, AppendsWithoutTouchingWhatWasThere) {
  const Detector detector = crowded_part();
  const auto finder = make(detector, 5);
  std::vector<ModuleCrossing> crossings{{123, 1e9F, Vec3f::UnitX()}};
  const Vec3f top = (detector.modules()[0].position + Vec3(0, 0, 5)).cast<float>();
  finder->find(top, -Vec3f::UnitZ(), 2000, crossings);
  ASSERT_EQ(crossings.size(), 61U);  // the whole of string 36
  EXPECT_EQ(crossings[0].module, 123U);
  for (std::uint32_t k = 0; k < 60; ++k) EXPECT_EQ(crossings[k + 1].module, k);
}

TEST_P(BothFinders, ModulesThatAreOffStandInTheWay) {
  Module module;
  module.on = false;
  module.position = {0, 0, 10};
  EXPECT_EQ(found(*make(Detector("off", {module}), 1), {Vec3f::Zero(), Vec3f::UnitZ(), 20}).size(), 1U);
}

TEST_P(BothFinders, OversizeHasARange) {
  const Detector detector("one", {Module{}});
  for (const double bad : {0.99, 101.0, -5.0, std::nan("")})
    EXPECT_THROW(make(detector, bad), UsageError) << bad;
  EXPECT_NO_THROW(make(detector, 1));
  EXPECT_NO_THROW(make(detector, 100));
}

INSTANTIATE_TEST_SUITE_P(ModuleFinder, BothFinders, testing::Bool(),
                         [](const auto& each) { return each.param ? "Embree" : "Exhaustive"; });

}  // namespace
}  // namespace floe
