#include "reco/ice_fit/run_data.h"

#include <gtest/gtest.h>

#include <string>

#include "data/base/error.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

// Modules 1,1 to 5,1, of which 4,1 is off.
Detector five_modules() {
  std::vector<Vec3> positions;
  for (int i = 0; i < 5; ++i) positions.emplace_back(20.0 * i, 0, 0);
  std::vector<Module> modules = test::modules_at(positions);
  modules[3].on = false;
  return {"five", std::move(modules)};
}

// A run of module 1,1; charges of a flash on modules 1,1 to 5,1, at 100 ns.
Event run_of(const std::string& id, const std::vector<float>& charges, double repeats = 10) {
  Event event;
  event.id = id;
  event.repeats = repeats;
  event.flasher.emplace();
  event.flasher->module = {1, 1};
  for (std::size_t i = 0; i < charges.size(); ++i) {
    if (charges[i] == 0) continue;
    Hit hit;
    hit.module = {static_cast<int>(i) + 1, 1};
    hit.time = 100;
    hit.charge = charges[i];
    event.hits.push_back(hit);
  }
  return event;
}

bool says(const std::vector<std::string>& sentences, const std::string& what) {
  for (const std::string& sentence : sentences)
    if (sentence.find(what) != std::string::npos) return true;
  return false;
}

std::vector<std::string> names(const FlasherData& data) {
  std::vector<std::string> result;
  for (const RunData& run : data.runs) result.push_back(run.name);
  return result;
}

// What the electronics could not follow, or was off in the record, is left out; gaps of single flashes are
// not.
TEST(FlasherData, LeavesOutWhatTheRecordCannotTell) {
  std::vector<Event> events{run_of("a", {7, 0.5, 2, 3, 1})};
  RecordingModules modules;
  for (int string = 1; string <= 5; ++string) modules.push_back({{string, 1}, string != 2, 0});
  events[0].readout = Readout{-4000, 6000, {}, {}, std::make_shared<const RecordingModules>(modules), {}};
  events[0].readout->unusable = {{{3, 1}, 90, 110, UnusableTimes::Reason::saturated},
                                 {{5, 1}, 500, 900, UnusableTimes::Reason::dead}};
  EXPECT_EQ(flasher_data(five_modules(), events).runs.at(0).used, (std::vector<char>{0, 0, 0, 0, 1}));
}

// Dark noise, afterpulses, when modules were awake; and by how much charges of single photoelectrons scatter:
// <q^2>/<q>, told by modules that seldom see two in a flash (the second one sees more).
TEST(FlasherData, KnowsTheElectronicsRecord) {
  Event event = run_of("a", {0, 0, 3, 0, 0}, 1000);
  for (const float charge : {0.5f, 1.5f, 1.5f, 0.5f}) {
    event.hits.push_back(event.hits.front());
    event.hits.back().module = {5, 1};
    event.hits.back().charge = charge / 1000;
  }
  RecordingModules modules;
  for (int string = 1; string <= 5; ++string)
    modules.push_back({{string, 1}, string != 2, 400.0 + 10 * string});
  event.readout =
      Readout{-4000, 6000, {0.06, 300, 11000}, {}, std::make_shared<const RecordingModules>(modules), {}};
  const RunData run = flasher_data(five_modules(), std::vector<Event>{event}).runs.at(0);
  EXPECT_EQ(run.first, -4000);
  EXPECT_EQ(run.last, 6000);
  EXPECT_NEAR(run.noise_rate, (410 + 430 + 440 + 450) / 4.0, 1e-9);
  EXPECT_EQ(run.afterpulses.share, 0.06);
  EXPECT_NEAR(run.charge_dispersion, (2 * 0.25 + 2 * 2.25) / 4, 1e-6);
}

TEST(FlasherData, KnowsNothingOfElectronicsWithoutTheirRecord) {
  const std::vector<Event> events{run_of("a", {7, 0.5, 2, 3, 1})};
  const RunData run = flasher_data(five_modules(), events).runs.at(0);
  EXPECT_EQ(run.noise_rate, 0);
  EXPECT_EQ(run.afterpulses.share, 0);
  EXPECT_EQ(run.charge_dispersion, 1);
  EXPECT_EQ(run.first, 100);
  EXPECT_EQ(run.last, 100);
}

TEST(FlasherData, IsTheChargeOfAllFlashesOnModulesThatCount) {
  const std::vector<Event> events{run_of("a", {7, 0.5, 2, 3, 1})};
  const FlasherData data = flasher_data(five_modules(), events);
  ASSERT_EQ(data.runs.size(), 1U);
  const RunData& run = data.runs[0];
  EXPECT_EQ(run.used, (std::vector<char>{0, 1, 1, 0, 1}));  // not its own light, and none of what is off
  ASSERT_EQ(run.pulses.size(), 3U);
  EXPECT_EQ(run.pulses[0].module, 1U);
  EXPECT_EQ(run.pulses[0].time, 100);
  EXPECT_DOUBLE_EQ(run.pulses[0].charge, 5);
  EXPECT_DOUBLE_EQ(run.charge, 35);
  EXPECT_EQ(run.repeats, 10);
}

TEST(FlasherData, CountsByBin) {
  std::vector<SimulatedHit> simulated;
  for (const std::uint32_t module : {1U, 4U})
    for (std::uint64_t i = 0; i < 60; ++i)
      simulated.push_back(
          {module, 95 + static_cast<float>(i), 400, Vec3f::UnitX(), Vec3f::UnitX(), 60 * module + i});
  const RunBins bins(simulated, 1, {0, 1, 1, 0, 1}, {});
  ASSERT_EQ(bins.size(), 4);
  const std::vector<Event> events{run_of("a", {7, 0.5, 2, 3, 1})};
  const Eigen::VectorXd counts = flasher_data(five_modules(), events).runs[0].counts(bins);
  EXPECT_TRUE(counts.isApprox(Eigen::Vector4d(5, 0, 10, 0))) << counts.transpose();
}

TEST(FlasherData, LeavesOutWhatIsNoRunOrHasNoLight) {
  Event cascade = run_of("cascade", {0, 5});
  cascade.flasher.reset();
  const std::vector<Event> events{run_of("a", {0, 1}), run_of("dark", {}), cascade,
                                  run_of("own-light", {9, 0, 0, 4}), run_of("b", {0, 0, 2})};
  const FlasherData data = flasher_data(five_modules(), events);
  EXPECT_EQ(names(data), (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(data.left_out.size(), 3U);
  EXPECT_TRUE(says(data.left_out, "event cascade: not a flasher run"));
  EXPECT_TRUE(says(data.left_out, "run dark: no light"));
  EXPECT_TRUE(says(data.left_out, "run own-light: no light"));
}

TEST(FlasherData, LeavesOutRunsOfAnotherColour) {
  Event blue = run_of("blue", {0, 1});
  blue.flasher->wavelength = 450;
  const std::vector<Event> events{run_of("a", {0, 1}), blue, run_of("b", {0, 1})};
  const FlasherData data = flasher_data(five_modules(), events);
  EXPECT_EQ(names(data), (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(data.left_out.size(), 1U);
  EXPECT_TRUE(says(data.left_out, "run blue: flashes at 450 nm, most others at 405 nm"));
}

// Runs that are left out anyway have no say in which colour is the usual one.
TEST(FlasherData, DarkRunsDoNotChooseTheColour) {
  std::vector<Event> events{run_of("a", {0, 1}), run_of("b", {0, 1})};
  for (const char* name : {"c", "d", "e"}) {
    events.push_back(run_of(name, {}));
    events.back().flasher->wavelength = 450;
  }
  FlasherData data;
  ASSERT_NO_THROW(data = flasher_data(five_modules(), events));
  EXPECT_EQ(names(data), (std::vector<std::string>{"a", "b"}));
}

TEST(FlasherData, RefusesNothingToFitAndUnknownModules) {
  const std::vector<Event> dark{run_of("dark", {5})};
  EXPECT_THROW(flasher_data(five_modules(), dark), NoResult);
  EXPECT_THROW(flasher_data(five_modules(), {}), NoResult);
  const std::vector<Event> stranger{run_of("a", {0, 1, 0, 0, 0, 1})};
  EXPECT_THROW(flasher_data(five_modules(), stranger), InputError);
  std::vector<Event> flasher{run_of("a", {0, 1})};
  flasher[0].flasher->module = {77, 3};
  EXPECT_THROW(flasher_data(five_modules(), flasher), InputError);
}

// Expected counts, of all flashes, alike in every run.
std::vector<std::vector<double>> expected(std::size_t runs, const std::vector<double>& counts) {
  return std::vector<std::vector<double>>(runs, counts);
}

TEST(BadReceivers, DarkWhereLightIsPlentyIsDead) {
  const Detector detector = five_modules();
  const std::vector<Event> events{run_of("a", {0, 1, 0, 0, 3}), run_of("b", {0, 1, 0.01f, 0, 3})};
  FlasherData data = flasher_data(detector, events);
  leave_out_bad_receivers(detector, expected(2, {0, 10, 40, 40, 30}), 500, data);
  for (const RunData& run : data.runs) {
    EXPECT_EQ(run.used, (std::vector<char>{0, 1, 0, 0, 1}));
    EXPECT_EQ(run.pulses.size(), 2U);
    EXPECT_NEAR(run.charge, 40, 1e-5);  // without the 0.1 that module 3,1 saw
  }
  ASSERT_EQ(data.left_out.size(), 1U);  // modules that are off are known to be
  EXPECT_TRUE(says(data.left_out, "module 3,1"));
  EXPECT_TRUE(says(data.left_out, "dead"));
}

TEST(BadReceivers, DarkWhereLittleIsExpectedStay) {
  const Detector detector = five_modules();
  const std::vector<Event> events{run_of("a", {0, 1}), run_of("b", {0, 1})};
  FlasherData data = flasher_data(detector, events);
  leave_out_bad_receivers(detector, expected(2, {0, 10, 14, 0, 0}), 500, data);
  EXPECT_TRUE(data.left_out.empty());
  EXPECT_EQ(data.runs[0].used[2], 1);
}

// Ice may take much of the light; it leaves more than one in fifty.
TEST(BadReceivers, DimOnesStay) {
  const Detector detector = five_modules();
  const std::vector<Event> events{run_of("a", {0, 1, 0.1f})};
  FlasherData data = flasher_data(detector, events);
  leave_out_bad_receivers(detector, expected(1, {0, 10, 40, 0, 0}), 500, data);
  EXPECT_EQ(data.runs[0].used[2], 1);
}

TEST(BadReceivers, NearSaturationAreLeftOutOfThatRun) {
  const Detector detector = five_modules();
  const std::vector<Event> events{run_of("bright", {0, 501, 2, 0, 3}), run_of("dim", {0, 400, 2, 0, 3})};
  FlasherData data = flasher_data(detector, events);
  // Saturated modules see less than they should: what is expected counts as well.
  leave_out_bright_receivers(detector, 500, data);
  leave_out_bad_receivers(detector, {{0, 4000, 20, 0, 6000}, {0, 4000, 20, 0, 30}}, 500, data);
  EXPECT_EQ(data.runs[0].used, (std::vector<char>{0, 0, 1, 0, 0}));
  EXPECT_DOUBLE_EQ(data.runs[0].charge, 20);
  EXPECT_EQ(data.runs[1].used, (std::vector<char>{0, 1, 1, 0, 1}));
  ASSERT_EQ(data.left_out.size(), 2U);
  EXPECT_TRUE(says(data.left_out, "module 2,1 in run bright: 501 photoelectrons a flash seen"));
  EXPECT_TRUE(says(data.left_out, "module 5,1 in run bright: 600 photoelectrons a flash expected"));
}

// Photons of a simulation have met no electronics.
TEST(BadReceivers, SimulatedRunsDoNotSaturate) {
  const Detector detector = five_modules();
  std::vector<Event> events{run_of("bright", {0, 5000, 2, 0, 3})};
  events[0].flasher->oversize = 5;
  FlasherData data = flasher_data(detector, events);
  leave_out_bad_receivers(detector, expected(1, {0, 50000, 20, 0, 30}), 500, data);
  EXPECT_TRUE(data.left_out.empty());
  EXPECT_EQ(data.runs[0].used[1], 1);
}

}  // namespace
}  // namespace floe
