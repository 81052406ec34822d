// Random streams and the simulator's promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "data/base/error.h"
#include "propagation/engine/random.h"
#include "propagation/engine/simulator.h"
#include "propagation/sources/cascade.h"
#include "propagation/sources/flasher.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

TEST(RandomStream, IsAFunctionOfItsCoordinates) {
  RandomStream a(1, 2, 3), b(1, 2, 3);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(a.bits(), b.bits());
  for (RandomStream other : {RandomStream(2, 2, 3), RandomStream(1, 3, 3), RandomStream(1, 2, 4)}) {
    RandomStream same(1, 2, 3);
    int equal = 0;
    for (int i = 0; i < 1000; ++i) equal += same.bits() == other.bits();
    EXPECT_LE(equal, 2);
  }
}

TEST(RandomStream, IsUniformOverPhotonsAndAlongAStream) {
  constexpr int bins = 64, draws = 640000;
  for (const bool along : {true, false}) {
    std::vector<int> counts(bins);
    RandomStream stream(5, 0, 0);
    double lag = 0, previous = 0.5;
    for (int i = 0; i < draws; ++i) {
      RandomStream fresh(5, 0, static_cast<std::uint64_t>(i));
      const float u = along ? stream.uniform() : fresh.uniform();
      ASSERT_GT(u, 0.0f);
      ASSERT_LT(u, 1.0f);
      ++counts[static_cast<int>(u * bins)];
      lag += (u - 0.5) * (previous - 0.5);
      previous = u;
    }
    double chi_square = 0;
    for (const int count : counts) chi_square += std::pow(count - draws / bins, 2) * bins / draws;
    EXPECT_LT(chi_square, bins + 5 * std::sqrt(2.0 * bins));
    EXPECT_NEAR(lag / draws, 0, 5.0 / 12 / std::sqrt(draws));  // independent neighbours
  }
}

class SimulatorTest : public ::testing::Test {
 protected:
  SimulatorTest() {
    model_ = load_model({});
    Cascade cascade;
    cascade.position = {20, -40, -300};
    cascade.energy = 30;
    source_ = std::make_unique<CascadeSource>(cascade, model_.acceptance.spectrum);
  }
  std::vector<SimulatedHit> hits(const SimulationOptions& options) const {
    std::vector<SimulatedHit> all;
    Simulator(model_, 5).run(*source_, options, [&](std::span<const SimulatedHit> portion) {
      all.insert(all.end(), portion.begin(), portion.end());
    });
    return all;
  }
  Model model_;
  std::unique_ptr<Source> source_;
};

bool same(const SimulatedHit& a, const SimulatedHit& b) {
  return a.module == b.module && a.time == b.time && a.wavelength == b.wavelength &&
         a.direction == b.direction && a.inward == b.inward && a.photon == b.photon && a.weight == b.weight;
}

TEST_F(SimulatorTest, GivesTheSameHitsForAnyNumberOfThreads) {
  SimulationOptions options;
  options.scale = 10;
  options.threads = 1;
  const auto one = hits(options);
  ASSERT_GT(one.size(), 100U);
  for (const int threads : {2, 5}) {
    options.threads = threads;
    const auto many = hits(options);
    ASSERT_EQ(one.size(), many.size());
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_TRUE(same(one[i], many[i])) << i;
  }
}

TEST_F(SimulatorTest, ShardsTogetherAreTheWholeRun) {
  SimulationOptions options;
  options.scale = 30;
  const auto whole = hits(options);
  for (const std::uint64_t count : {2, 3, 40}) {
    std::vector<SimulatedHit> together;
    for (std::uint64_t index = 1; index <= count; ++index) {
      options.shard = {index, count};
      const auto part = hits(options);
      together.insert(together.end(), part.begin(), part.end());
    }
    ASSERT_EQ(whole.size(), together.size());
    for (std::size_t i = 0; i < whole.size(); ++i) ASSERT_TRUE(same(whole[i], together[i])) << i;
  }
  for (const Shard wrong : {Shard{0, 2}, Shard{3, 2}, Shard{1, 0}}) {
    options.shard = wrong;
    EXPECT_THROW(hits(options), UsageError);
  }
}

// What the vector engine treats in its own way: stretched absorption, hole-ice columns, a flasher's own
// light, and all of it together. How the photons are shared out changes nothing.
struct SharedOut {
  const char* name;
  double stretch, hole_ice_radius, oversize;
  bool flasher;
  friend void PrintTo(const SharedOut& run, std::ostream* out) { *out << run.name; }
};
class SharedOutRuns : public ::testing::TestWithParam<SharedOut> {
 protected:
  static constexpr double photons = 100000;  // four batches, of which the last is not full

  // A few strings in ice in which most photons end soon.
  static Model scene() {
    IceTables tables = test::uniform_tables({4, 12});
    tables.wavelength = {0.9, 1.1, 0, 1, {}, {}, {}};
    if (GetParam().hole_ice_radius > 0)
      tables.configuration.hole_ice = {GetParam().hole_ice_radius, 0.5, 10, 0.35, 0.9};
    std::vector<Vec3> places;
    for (const double x : {-6.0, 0.0, 7.0})
      for (const double z : {-2.0, 0.0, 2.0}) places.push_back({x, 0.5 * x, z});
    return test::make_model(tables, places);
  }
  static std::unique_ptr<Source> source(const Model& model) {
    if (!GetParam().flasher)
      return std::make_unique<PointSource>(Vec3(-1, 0.6, 0.5), 0, 1, model.acceptance.spectrum);
    FlasherSettings settings;
    settings.photons = 1;
    return std::make_unique<FlasherSource>(*model.detector, model.detector->modules()[4].id, settings,
                                           led_line(405));
  }
  static std::vector<SimulatedHit> hits(const Simulator& simulator, const Source& source,
                                        SimulationOptions options, SimulationSummary& summary) {
    options.fixed_number = true;
    options.scale = photons * simulator.oversize() * simulator.oversize();
    options.absorption_stretch = GetParam().stretch;
    std::vector<SimulatedHit> all;
    summary = simulator.run(source, options, [&](std::span<const SimulatedHit> portion) {
      all.insert(all.end(), portion.begin(), portion.end());
    });
    return all;
  }
};

TEST_P(SharedOutRuns, GiveTheSameHitsForAnyThreadsAndShards) {
  const Model model = scene();
  const Simulator simulator(model, GetParam().oversize, EngineKind::vector);
  const auto light = source(model);
  SimulationOptions options;
  options.seed = 77;
  options.threads = 1;
  SimulationSummary summary, other;
  const auto whole = hits(simulator, *light, options, summary);
  ASSERT_GT(whole.size(), 200U);
  ASSERT_EQ(summary.propagated, static_cast<std::uint64_t>(photons));
  const bool weighted =
      std::any_of(whole.begin(), whole.end(), [](const auto& hit) { return hit.weight < 1; });
  EXPECT_EQ(weighted, GetParam().stretch > 1);
  for (const int threads : {2, 5}) {
    options.threads = threads;
    const auto again = hits(simulator, *light, options, other);
    ASSERT_EQ(whole.size(), again.size()) << threads;
    for (std::size_t i = 0; i < whole.size(); ++i) ASSERT_TRUE(same(whole[i], again[i])) << i;
    EXPECT_EQ(summary.scatters, other.scatters);
    EXPECT_EQ(summary.queries, other.queries);
    EXPECT_EQ(summary.weights.sum, other.weights.sum);
  }
  for (const std::uint64_t count : {2, 3, 7}) {  // 7: more than there are batches
    std::vector<SimulatedHit> together;
    std::uint64_t propagated = 0, scatters = 0;
    for (std::uint64_t index = 1; index <= count; ++index) {
      options.shard = {index, count};
      const auto part = hits(simulator, *light, options, other);
      together.insert(together.end(), part.begin(), part.end());
      propagated += other.propagated;
      scatters += other.scatters;
    }
    ASSERT_EQ(whole.size(), together.size()) << count;
    for (std::size_t i = 0; i < whole.size(); ++i) ASSERT_TRUE(same(whole[i], together[i])) << i;
    EXPECT_EQ(propagated, summary.propagated);
    EXPECT_EQ(scatters, summary.scatters);
  }
}

INSTANTIATE_TEST_SUITE_P(Simulator, SharedOutRuns,
                         ::testing::Values(SharedOut{"plain", 1, 0, 5, false},
                                           SharedOut{"weighted", 5, 0, 5, false},
                                           SharedOut{"hole_ice", 1, 3, 1, false},
                                           SharedOut{"flasher", 1, 0, 5, true},
                                           SharedOut{"weighted_hole_ice", 3, 3, 1, true}),
                         [](const auto& run) { return std::string(run.param.name); });

TEST_F(SimulatorTest, SeedsAndStreamsAreIndependent) {
  SimulationOptions options;
  const auto first = hits(options);
  options.seed = 2;
  const auto second = hits(options);
  options.seed = 1;
  options.stream = 1;
  const auto third = hits(options);
  EXPECT_FALSE(first.size() == second.size() && same(first.front(), second.front()));
  EXPECT_FALSE(first.size() == third.size() && same(first.front(), third.front()));
}

TEST_F(SimulatorTest, HandsOverPhotonsInOrder) {
  SimulationOptions options;
  options.scale = 10;
  const auto all = hits(options);
  for (std::size_t i = 1; i < all.size(); ++i) ASSERT_LE(all[i - 1].photon, all[i].photon);
}

TEST_F(SimulatorTest, PassesOnWhatTheSinkThrows) {
  SimulationOptions options;
  options.scale = 10;
  EXPECT_THROW(Simulator(model_, 5).run(
                   *source_, options, [](std::span<const SimulatedHit>) { throw OutputError("disk full"); }),
               OutputError);
}

TEST_F(SimulatorTest, RefusesAnOversizeOutOfRange) {
  EXPECT_THROW(Simulator(model_, 0.5), UsageError);
  EXPECT_THROW(Simulator(model_, 1000), UsageError);
}

}  // namespace
}  // namespace floe
