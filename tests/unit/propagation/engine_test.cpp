// Random streams and the simulator's promises.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "data/base/error.h"
#include "propagation/engine/random.h"
#include "propagation/engine/simulator.h"
#include "propagation/sources/cascade.h"

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
         a.direction == b.direction && a.inward == b.inward && a.photon == b.photon;
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
