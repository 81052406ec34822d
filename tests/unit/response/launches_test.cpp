#include "response/launches.h"

#include <gtest/gtest.h>

#include "response/discriminator.h"

namespace floe {

namespace {

using Launches = std::vector<std::vector<Launch>>;

Launches launches(const std::vector<ModuleCrossings>& modules, CoincidenceMode mode = CoincidenceMode::soft) {
  LaunchSettings settings;
  settings.mode = mode;
  return launches_of(settings, modules);
}

std::vector<double> times_of(const std::vector<Launch>& launches) {
  std::vector<double> times;
  for (const Launch& launch : launches) times.push_back(launch.time);
  return times;
}

}  // namespace

TEST(Launches, OfNeighboursWithinAMicrosecondAreHard) {
  const Launches found = launches({{{1, 10}, {100}},
                                   {{1, 12}, {1050}},  // two modules away, 950 ns later
                                   {{1, 15}, {1100}},  // three from it
                                   {{2, 10}, {100}},   // another string
                                   {{1, 20}, {100}},
                                   {{1, 21}, {1101}}});  // 1001 ns later
  EXPECT_TRUE(found[0][0].hard);
  EXPECT_TRUE(found[1][0].hard);
  for (const std::size_t module : {2, 3, 4, 5}) EXPECT_FALSE(found[module][0].hard) << module;
}

TEST(Launches, KeepModulesBusy) {
  // An isolated launch takes 2450 ns, a whole one 6450 ns.
  EXPECT_EQ(times_of(launches({{{1, 1}, {0, 100, 2449, 2451}}})[0]), (std::vector<double>{0, 2451}));
  const Launches hard = launches({{{1, 1}, {0, 6449, 6451}}, {{1, 2}, {500}}});
  EXPECT_EQ(times_of(hard[0]), (std::vector<double>{0, 6451}));
  EXPECT_EQ(times_of(launches({{{1, 1}, {0, 2451, 6451}}}, CoincidenceMode::none)[0]),
            (std::vector<double>{0, 6451}));
}

TEST(Launches, WaitForAChip) {
  // Both ATWDs digitise for 29 us each after launches at 0 and 7 us; the first is free at 29 us.
  EXPECT_EQ(
      times_of(launches({{{1, 1}, {0, 7000, 14000, 28999, 29001, 35500, 36001}}}, CoincidenceMode::none)[0]),
      (std::vector<double>{0, 7000, 29001, 36001}));
}

TEST(Discriminator, SeesWhatIsAboveAQuarterOfAPhotoelectron) {
  const PulseShape shape(5.5, 42);
  const auto crossings = [&](std::vector<Photoelectron> pes) { return threshold_crossings({}, shape, pes); };
  EXPECT_TRUE(crossings({}).empty());
  EXPECT_TRUE(crossings({{100, 0.24f}}).empty());
  EXPECT_EQ(crossings({{100, 0.26f}}).size(), 1u);
  EXPECT_EQ(crossings({{100, 0.2f}, {101, 0.2f}}).size(), 1u);  // together
  EXPECT_TRUE(crossings({{100, 0.2f}, {200, 0.2f}}).empty());
  const auto two = crossings({{100, 1}, {300, 1}});
  ASSERT_EQ(two.size(), 2u);
  // A pulse of charge 1 passes a quarter of its peak before it passes half, at its time.
  EXPECT_NEAR(two[0], 99, 1.5);
  EXPECT_NEAR(two[1] - two[0], 200, 0.5);
  EXPECT_EQ(crossings({{100, 1}, {104, 1}}).size(), 1u);  // it never falls below between
}

}  // namespace floe
