// What a flasher run may be, and the names of LEDs and runs.
#include <gtest/gtest.h>

#include <functional>

#include "data/event_rules.h"
#include "tests/unit/data/sample_events.h"

namespace floe {

using namespace test;

namespace {

using Kind = LedPattern::Kind;

TEST(LedPattern, IsKnownByItsName) {
  const LedPattern patterns[] = {
      {Kind::ring, 0}, {Kind::horizontal, 0}, {Kind::tilted, 0}, {Kind::single, 1}, {Kind::single, 12}};
  for (const LedPattern& leds : patterns) EXPECT_EQ(led_pattern_of(name_of(leds)), leds) << name_of(leds);
  EXPECT_EQ(name_of({Kind::single, 7}), "7");
  for (const char* name : {"", "0", "13", "-1", "1.5", "07", "7 ", "Ring", "all", "99999999999"})
    EXPECT_FALSE(led_pattern_of(name)) << name;
}

TEST(LedPattern, SixLookUpAndSixSideways) {
  for (int number = 1; number <= 12; ++number) {
    const LedPattern led{Kind::single, number};
    EXPECT_EQ(led.elevation(), (number <= 6 ? 48.1 : -0.2) * degree) << number;
    EXPECT_NEAR(led.azimuth(), (number - 1) % 6 * 60 * degree, 1e-15) << number;
    EXPECT_EQ(led.count(), 1);
  }
  EXPECT_EQ((LedPattern{Kind::tilted, 0}.elevation()), 48.1 * degree);
  EXPECT_EQ((LedPattern{Kind::tilted, 0}.count()), 6);
  for (const Kind kind : {Kind::ring, Kind::horizontal})
    EXPECT_EQ((LedPattern{kind, 0}.elevation()), -0.2 * degree);
}

TEST(FlasherRun, MayHaveWhatIsNotKnown) {
  EXPECT_FALSE(problem_of(sample_flasher()));
  FlasherRun bare;
  bare.module = {1, 1};
  EXPECT_FALSE(problem_of(bare));
}

TEST(FlasherRun, OfImpossibleValuesIsRefused) {
  constexpr double infinite = std::numeric_limits<double>::infinity(), unknown = FlasherRun::unknown;
  struct Case {
    const char* found;
    std::function<void(FlasherRun&)> spoil;
  };
  const Case cases[] = {
      {"string 0", [](FlasherRun& run) { run.module.string = 0; }},
      {"DOM 1001", [](FlasherRun& run) { run.module.dom = 1001; }},
      {"LEDs 13", [](FlasherRun& run) { run.leds.number = 13; }},
      {"orientation 36", [](FlasherRun& run) { run.orientation = 361 * degree; }},
      {"orientation inf", [](FlasherRun& run) { run.orientation = infinite; }},
      {"wavelength 0.405", [](FlasherRun& run) { run.wavelength = 0.405; }},
      {"wavelength nan", [](FlasherRun& run) { run.wavelength = unknown; }},
      {"beam width -", [](FlasherRun& run) { run.beam_width = -1e-3; }},
      {"beam width 9", [](FlasherRun& run) { run.beam_width = 91 * degree; }},
      {"pulse width -1", [](FlasherRun& run) { run.pulse_width = -1; }},
      {"pulse width nan", [](FlasherRun& run) { run.pulse_width = unknown; }},
      {"number of photons 0", [](FlasherRun& run) { run.photons = 0; }},
      {"number of photons inf", [](FlasherRun& run) { run.photons = infinite; }},
      {"oversize 0.5", [](FlasherRun& run) { run.oversize = 0.5; }},
  };
  for (const Case& test_case : cases) {
    FlasherRun run = sample_flasher();
    test_case.spoil(run);
    const auto problem = problem_of(run);
    ASSERT_TRUE(problem) << test_case.found;
    EXPECT_EQ(problem->found.find(test_case.found), 0u) << problem->found;
  }
}

TEST(FlasherRunNames, AreThoseOfTheModulesAndUnique) {
  FlasherRunNames names;
  EXPECT_EQ(names.next({63, 20}), "63,20");
  EXPECT_EQ(names.next({6, 20}), "6,20");
  EXPECT_EQ(names.next({63, 20}), "63,20-2");
  EXPECT_EQ(names.next({63, 20}), "63,20-3");
  EXPECT_EQ(names.next({6, 20}), "6,20-2");
}

}  // namespace
}  // namespace floe
