#include "reco/event_data.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
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

// The record of so many modules; by default all were on and without noise.
Readout record_of(
    int count, double afterpulse_share, std::vector<UnusableTimes> unusable = {},
    const std::function<void(RecordingModule&)>& change = [](RecordingModule&) {}) {
  RecordingModules modules;
  for (int dom = 1; dom <= count; ++dom) {
    modules.push_back({{1, dom}, true, 0});
    change(modules.back());
  }
  return {-4000,
          6000,
          {afterpulse_share, 300, 11000},
          std::move(unusable),
          std::make_shared<const RecordingModules>(std::move(modules)),
          {}};
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

// Modules that were off, dark noise, times that cannot be used and afterpulses are those of the record.
TEST(EventData, LearnsFromTheReadout) {
  const Detector detector = small_detector();
  Event event{"e", {hit(1, 0), hit(2, 0, 100), hit(2, 5000), hit(3, 50), hit(3, 950, 40)}, {}, 1};
  event.readout =
      record_of(6, 0.06, {{{1, 3}, 900, 1000, UnusableTimes::Reason::dead}}, [](RecordingModule& module) {
        module.on = module.id.dom != 1;
        module.noise_rate = module.id.dom * 1e3;
      });
  const EventData data(detector, event);
  ASSERT_EQ(data.lit().size(), 2u);
  EXPECT_EQ(data.dark(), (std::vector<std::uint32_t>{3, 4}));  // the first was off
  const double window = (data.end() - data.begin()) * 1e-9;
  EXPECT_NEAR(data.dark_noise(3), 4e3 * window, 1e-12);
  EXPECT_EQ(data.lit()[1].charge, 1);  // what came while the module was dead is left out
  double noise = 0;
  for (const double n : data.lit()[0].noise) noise += n;
  // From 300 ns after 100 photoelectrons until 5200 ns; those of the last come later.
  const double afterpulses = 0.06 * 100 * std::log(5200.0 / 300) / std::log(11000.0 / 300);
  EXPECT_NEAR(noise, 2e3 * window + afterpulses, 1e-6);
  noise = 0;
  for (const double n : data.lit()[1].noise) noise += n;
  // What could not be used has afterpulses, too.
  const double of_dead = 0.06 * 40 * std::log((5200.0 - 950) / 300) / std::log(11000.0 / 300);
  const double of_used = 0.06 * std::log((5200.0 - 50) / 300) / std::log(11000.0 / 300);
  EXPECT_NEAR(noise, 3e3 * window + of_dead + of_used, 1e-6);

  DataSelection asked;
  asked.noise_rate = 500;  // what the user names counts
  EXPECT_NEAR(EventData(detector, event, asked).dark_noise(3), 500 * window, 1e-12);
}

// Afterpulses of light that nobody measured cannot be expected: the module is not asked from 300 ns after on.
TEST(EventData, LeavesOutWhatFollowsSaturation) {
  const Detector detector = small_detector();
  Event event{"e", {hit(2, 0), hit(2, 95, 500), hit(2, 250), hit(2, 900), hit(3, 900)}, {}, 1};
  event.readout = record_of(6, 0.06, {{{1, 2}, 90, 100, UnusableTimes::Reason::saturated}});
  const EventData data(detector, event);
  ASSERT_EQ(data.lit().size(), 2u);
  EXPECT_EQ(data.lit()[0].times, (std::vector<double>{0, 250}));
  EXPECT_EQ(data.lit()[1].charge, 1);
  event.readout->afterpulses.share = 0;
  EXPECT_EQ(EventData(detector, event).lit()[0].times, (std::vector<double>{0, 250, 900}));
}

// A pulse that stands for light over 20 ns, from 40 to 60 ns, in bins that end at 45, 55 and 70 ns.
TEST(EventData, SpreadsPulsesOverTheirWidths) {
  const Detector detector = small_detector();
  Event event{"e", {hit(2, 50, 4), hit(2, 80)}, {}, 1};
  event.hits[0].width = 20;
  event.readout = record_of(6, 0);
  const auto counts_with = [&] {
    return EventData(detector, event)
        .with_edges(std::vector<std::vector<double>>{{45, 55, 70}})
        .lit()[0]
        .counts;
  };
  EXPECT_EQ(counts_with(), (std::vector<double>{1, 2, 1, 1}));
  // What lies in times that are left out is not known.
  event.readout = record_of(6, 0, {{{1, 2}, 55, 70, UnusableTimes::Reason::dead}});
  EXPECT_EQ(counts_with(), (std::vector<double>{1, 2, 0, 1}));
}

// Charges of single photoelectrons, half of them 0.5 and half 1.5: <q^2>/<q> = 1.25.
TEST(EventData, ModulesWithOnePulseTellHowChargesScatter) {
  const Detector detector = test::one_string(40, 40);
  Event event;
  event.id = "pulses";
  for (int dom = 1; dom <= 30; ++dom) event.hits.push_back(hit(dom, 100.0 + dom, dom % 2 ? 0.5f : 1.5f));
  for (const double time : {200.0, 210.0}) event.hits.push_back(hit(36, time, 7));
  EXPECT_EQ(EventData(detector, event).charge_dispersion(), 1);  // photons
  event.readout = record_of(40, 0);
  EXPECT_NEAR(EventData(detector, event).charge_dispersion(), 1.25, 1e-6);
  event.hits.resize(10);
  EXPECT_EQ(EventData(detector, event).charge_dispersion(), 1);  // too few to tell
}

}  // namespace
}  // namespace floe
