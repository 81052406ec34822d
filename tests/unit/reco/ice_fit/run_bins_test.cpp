#include "reco/ice_fit/run_bins.h"

#include <gtest/gtest.h>

#include <vector>

namespace floe {
namespace {

// `count` hits of a module, evenly from `first` on, `step` apart [ns].
void add_hits(std::vector<SimulatedHit>& hits, std::uint32_t module, int count, float first, float step) {
  for (int i = 0; i < count; ++i) {
    const float time = first + step * static_cast<float>(i);
    hits.push_back({module, time, 400, Vec3f::UnitX(), Vec3f::UnitX(), static_cast<std::uint64_t>(i)});
  }
}

std::vector<int> counts_of(const RunBins& bins, const std::vector<SimulatedHit>& hits) {
  std::vector<int> counts(static_cast<std::size_t>(bins.size()), 0);
  for (const SimulatedHit& hit : hits)
    if (const int bin = bins.bin(hit.module, hit.time); bin >= 0) ++counts[static_cast<std::size_t>(bin)];
  return counts;
}

TEST(RunBins, AreQuantilesOfTheSimulatedTimes) {
  std::vector<SimulatedHit> hits;
  add_hits(hits, 0, 60, 100, 1);
  add_hits(hits, 0, 60, 500, 20);  // a tail
  const RunBins bins(hits, 1, {1}, {5, 30, 30, 8});
  ASSERT_EQ(bins.size(), 4);
  EXPECT_EQ(counts_of(bins, hits), (std::vector<int>{30, 30, 30, 30}));
  EXPECT_EQ(bins.receivers()[0].inner_edges, (std::vector<double>{130, 500, 1100}));
}

TEST(RunBins, OpenEndsTakeWhatComesBeforeAndAfter) {
  std::vector<SimulatedHit> hits;
  add_hits(hits, 0, 90, 100, 1);
  const RunBins bins(hits, 1, {1}, {5, 30, 30, 8});
  ASSERT_EQ(bins.size(), 3);
  EXPECT_EQ(bins.bin(0, -1e9), 0);
  EXPECT_EQ(bins.bin(0, 129.99), 0);
  EXPECT_EQ(bins.bin(0, 130), 1);  // an edge belongs to the later bin, as for the simulated hit that set it
  EXPECT_EQ(bins.bin(0, 159.99), 1);
  EXPECT_EQ(bins.bin(0, 160), 2);
  EXPECT_EQ(bins.bin(0, 1e9), 2);
}

TEST(RunBins, DimAndUnusedModulesAreNoReceivers) {
  std::vector<SimulatedHit> hits;
  add_hits(hits, 0, 9, 0, 1);    // 4.5 counts expected
  add_hits(hits, 1, 10, 0, 1);   // 5
  add_hits(hits, 3, 200, 0, 1);  // not used
  add_hits(hits, 4, 120, 0, 1);
  const RunBins bins(hits, 0.5, {1, 1, 1, 0, 1}, {5, 30, 30, 8});
  ASSERT_EQ(bins.receivers().size(), 2U);
  EXPECT_EQ(bins.receivers()[0].module, 1U);
  EXPECT_EQ(bins.receivers()[1].module, 4U);
  for (const std::uint32_t module : {0U, 2U, 3U}) EXPECT_EQ(bins.bin(module, 3), -1) << module;
  EXPECT_EQ(bins.bin(1, 3), 0);
  EXPECT_EQ(bins.receivers()[1].first, 1);  // numbers run on from receiver to receiver
  EXPECT_EQ(bins.bin(4, -5), 1);
  EXPECT_EQ(bins.bin(4, 500), bins.size() - 1);
  EXPECT_EQ(bins.size(), 3);  // 60 counts of the second: two bins
}

// Each bin has enough counts in the data, and in a simulation of less light than the data enough hits.
TEST(RunBins, AsManyAsTheScarcerOfDataAndSimulationAllows) {
  std::vector<SimulatedHit> hits;
  add_hits(hits, 0, 120, 0, 1);
  EXPECT_EQ(RunBins(hits, 0.25, {1}, {5, 30, 30, 8}).size(), 1);
  EXPECT_EQ(RunBins(hits, 0.5, {1}, {5, 30, 30, 8}).size(), 2);
  EXPECT_EQ(RunBins(hits, 1, {1}, {5, 30, 30, 8}).size(), 4);
  EXPECT_EQ(RunBins(hits, 100, {1}, {5, 30, 30, 8}).size(), 4);
  EXPECT_EQ(RunBins(hits, 100, {1}, {5, 30, 20, 8}).size(), 6);  // fits will have more light than these hits
  EXPECT_EQ(RunBins(hits, 1, {1}, {5, 30, 30, 3}).size(), 3);
}

// Direct light may come at one time to the last bit of a float.
TEST(RunBins, NoBinIsWithoutSimulatedLight) {
  std::vector<SimulatedHit> hits;
  add_hits(hits, 0, 100, 70, 0);
  add_hits(hits, 0, 20, 80, 1);
  add_hits(hits, 1, 90, 70, 0);
  const RunBins bins(hits, 1, {1, 1}, {5, 30, 30, 8});
  for (const int count : counts_of(bins, hits)) EXPECT_GT(count, 0);
}

// Bins end at 130 and 160; the first and the last are open.
TEST(RunBins, PulsesAreSpreadOverTheirWidth) {
  std::vector<SimulatedHit> hits;
  add_hits(hits, 0, 90, 100, 1);
  const RunBins bins(hits, 1, {1, 1}, {5, 30, 30, 8});
  ASSERT_EQ(bins.size(), 3);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(3);
  bins.add_spread(0, 140, 40, 4, counts);  // 120 to 160
  EXPECT_NEAR((counts - Eigen::Vector3d(1, 3, 0)).norm(), 0, 1e-12);
  bins.add_spread(0, 145, 60, 6, counts);  // 115 to 175
  EXPECT_NEAR((counts - Eigen::Vector3d(2.5, 6, 1.5)).norm(), 0, 1e-12);
  bins.add_spread(0, 200, 0, 1, counts);
  bins.add_spread(0, -50, 10, 2, counts);
  bins.add_spread(1, 140, 40, 4, counts);  // no receiver
  EXPECT_NEAR((counts - Eigen::Vector3d(4.5, 6, 2.5)).norm(), 0, 1e-12);
}

TEST(RunBins, OfNoLightAreNone) {
  const RunBins bins({}, 1, {1, 1}, {});
  EXPECT_EQ(bins.size(), 0);
  EXPECT_EQ(bins.bin(1, 0), -1);
}

}  // namespace
}  // namespace floe
