#include "reco/event_data.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "data/base/error.h"
#include "tests/unit/reco/one_string.h"

namespace floe {
namespace {

using test::hit;

// Six modules, of which the last is off.
Detector small_detector() {
  return test::one_string(6, 5);
}

TEST(EventData, SortsHitsIntoModulesAndBins) {
  const Detector detector = small_detector();
  Event event{"e", {hit(2, 50), hit(2, 10, 2), hit(4, 900), hit(6, 5)}, {}, 1};
  const EventData data(detector, event);
  ASSERT_EQ(data.lit().size(), 2u);
  EXPECT_EQ(data.lit()[0].module, 1u);
  EXPECT_EQ(data.lit()[0].times, (std::vector<double>{10, 50}));
  EXPECT_EQ(data.lit()[0].charges, (std::vector<double>{2, 1}));
  EXPECT_EQ(data.dark(), (std::vector<std::uint32_t>{0, 2, 4}));  // the sixth is off, on both sides
  EXPECT_DOUBLE_EQ(data.charge(), 4);
  for (const ModuleData& lit : data.lit()) {
    EXPECT_EQ(lit.counts.size(), lit.edges.size() + 1);
    EXPECT_DOUBLE_EQ(std::accumulate(lit.counts.begin(), lit.counts.end(), 0.0), lit.charge);
  }
}

TEST(EventData, AveragesCountAsManyEvents) {
  const Detector detector = small_detector();
  const EventData data(detector, {"e", {hit(2, 50, 0.5f)}, {}, 10});
  EXPECT_DOUBLE_EQ(data.charge(), 5);
  EXPECT_DOUBLE_EQ(data.repeats(), 10);
}

TEST(EventData, RefusesWhatItCannotUse) {
  const Detector detector = small_detector();
  Hit unknown = hit(1, 0);
  unknown.module = {99, 1};
  EXPECT_THROW(EventData(detector, {"e", {unknown}, {}, 1}), InputError);
  EXPECT_THROW(EventData(detector, {"e", {hit(1, std::numeric_limits<double>::quiet_NaN())}, {}, 1}),
               InputError);
  EXPECT_THROW(EventData(detector, {"e", {hit(1, 0, -1)}, {}, 1}), InputError);
  EXPECT_THROW(EventData(detector, {"e", {hit(1, 0)}, {}, 0}), InputError);
}

TEST(EventData, SaysWhenLightIsNotEnough) {
  const Detector detector = small_detector();
  EXPECT_THROW(EventData(detector, {"e", {}, {}, 1}).require_enough_light(), NoResult);
  EXPECT_THROW(EventData(detector, {"e", {hit(1, 0, 100), hit(2, 0, 100)}, {}, 1}).require_enough_light(),
               NoResult);
  EXPECT_THROW(
      EventData(detector, {"e", {hit(1, 0), hit(2, 0), hit(3, 0), hit(4, 0)}, {}, 1}).require_enough_light(),
      NoResult);
  EXPECT_NO_THROW(EventData(detector, {"e", {hit(1, 0, 9), hit(2, 0), hit(3, 0), hit(4, 0)}, {}, 1})
                      .require_enough_light());
}

}  // namespace
}  // namespace floe
