// Light drawn again from a simulation.
#include "reco/ice_fit/photon_draws.h"

#include <gtest/gtest.h>

#include <cmath>

namespace floe::test {
namespace {

constexpr int photons = 400;

// Every photon hits module 0; every other one module 1 as well.
SimulatedRun some_light() {
  SimulatedRun run;
  for (std::uint64_t photon = 0; photon < photons; ++photon) {
    SimulatedHit hit{0, 0, 400, Vec3f::UnitZ(), Vec3f::UnitZ(), 0};
    hit.photon = photon;
    run.hits.push_back(hit);
    if (photon % 4 < 2) hit.module = 1, run.hits.push_back(hit);
  }
  return run;
}

struct Moments {
  double mean = 0, variance = 0;
};
template <class Value>
Moments moments_of(const PhotonDraws& draws, int number, Value value) {
  std::mt19937_64 random(7);
  Moments sums;
  for (int i = 0; i < number; ++i) {
    const double x = value(draws.draw(random));
    sums.mean += x, sums.variance += x * x;
  }
  sums.mean /= number;
  return {sums.mean, sums.variance / number - sums.mean * sums.mean};
}

class PhotonDrawsTest : public ::testing::Test {
 protected:
  const SimulatedRun light_ = some_light();
  const RunBins bins_{light_.hits, 1, {1, 1}, {.counts_a_bin = 1e9}};
  static constexpr int number_ = 4000;
};

TEST_F(PhotonDrawsTest, MeanIsWhatWasSimulated) {
  const double scale = 0.3;
  const PhotonDraws draws(light_, bins_, scale, true);
  const auto of_data = moments_of(draws, number_, [](const FoldedCounts& c) { return c.data(0); });
  EXPECT_NEAR(of_data.mean, scale * photons, 4 * std::sqrt(scale * photons / number_));
  const auto of_even = moments_of(draws, number_, [](const FoldedCounts& c) { return c.simulated[0](1); });
  EXPECT_NEAR(of_even.mean, photons / 4, 4 * std::sqrt(photons / 4.0 / number_));
}

// Scores with weights of one half judge the other: halves that differ in the simulation must not in draws.
TEST_F(PhotonDrawsTest, HalvesAreAlike) {
  SimulatedRun even_only = light_;
  for (SimulatedHit& hit : even_only.hits) hit.photon *= 2;
  const PhotonDraws draws(even_only, bins_, 1, true);
  for (const std::size_t half : {0, 1}) {
    const auto of_half =
        moments_of(draws, number_, [&](const FoldedCounts& c) { return c.simulated[half](0); });
    EXPECT_NEAR(of_half.mean, photons / 2, 4 * std::sqrt(photons / 2.0 / number_));
    EXPECT_NEAR(of_half.variance / (photons / 2.0), 1, 5 * std::sqrt(2.0 / number_));
  }
}

// A photon that is seen twice counts twice, or not at all: the variance of the sum over both modules is
// 1^2 n/2 + 2^2 n/2 times the scale.
TEST_F(PhotonDrawsTest, WholePhotonsAreDrawn) {
  const double scale = 0.5, error = 5 * std::sqrt(2.0 / number_);
  const auto sum = [](const FoldedCounts& c) { return c.data.sum(); };
  const auto whole = moments_of(PhotonDraws(light_, bins_, scale, true), number_, sum);
  EXPECT_NEAR(whole.variance / (2.5 * scale * photons), 1, error);
  const auto apart = moments_of(PhotonDraws(light_, bins_, scale, false), number_, sum);
  EXPECT_NEAR(apart.variance / (1.5 * scale * photons), 1, error);
  // Charges that differ from photoelectron to photoelectron.
  const auto charged = moments_of(PhotonDraws(light_, bins_, scale, false, 1.4), number_, sum);
  EXPECT_NEAR(charged.variance / (1.4 * 1.5 * scale * photons), 1, error);
}

// Bins that may be off by a tenth: their mean stays, their variance gains (0.1 n)^2, with the Poisson part
// larger by 1.01.
TEST_F(PhotonDrawsTest, ModelErrorIsDrawn) {
  constexpr double model_error = 0.1;
  const auto of_first = [](const FoldedCounts& c) { return c.data(0); };
  const auto found = moments_of(PhotonDraws(light_, bins_, 1, false, 1, model_error), number_, of_first);
  const double variance = 1.01 * photons + model_error * model_error * photons * photons;
  EXPECT_NEAR(found.mean, photons, 4 * std::sqrt(variance / number_));
  EXPECT_NEAR(found.variance / variance, 1,
              5 * std::sqrt(2.5 / number_));  // kurtosis of such a log-normal: 3.2
}

}  // namespace
}  // namespace floe::test
