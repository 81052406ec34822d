// Hits that no light makes: how many there are, where and when, and in which bins of a fit.
#include "reco/ice_fit/noise_slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "reco/ice_fit/ice_parameter.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

Model noisy(double rate) {
  std::vector<Vec3> places;
  for (int i = 0; i < 20; ++i) places.emplace_back(20 * i, 0, 0);
  std::vector<Module> modules = test::modules_at(places);
  modules[3].on = false;
  Model model = test::make_model(test::uniform_tables({25, 100}), std::move(modules));
  model.noise_rate = rate;
  return model;
}

// A Poisson number, the same on all modules that are on, evenly in time: each within four errors.
TEST(NoiseHits, AreWhatTheRateSays) {
  const NoiseWindow window{-1000, 4000, 1000};  // 1000 readouts of 5 us: 5 ms
  const auto hits = noise_hits(noisy(600), window, 7, 1, 2);
  const double expected = 600 * 5e-3 * 18;
  EXPECT_NEAR(static_cast<double>(hits.size()), expected, 4 * std::sqrt(expected));

  const auto many = noise_hits(noisy(6e5), window, 7, 1, 2);
  const double each = 6e5 * 5e-3;
  std::map<std::uint32_t, double> count;
  double mean = 0;
  for (const SimulatedHit& hit : many) {
    ++count[hit.module];
    mean += hit.time / static_cast<double>(many.size());
    EXPECT_GE(hit.time, -1000);
    EXPECT_LE(hit.time, 4000);
    EXPECT_GE(hit.photon, first_noise_hit);
    EXPECT_TRUE(std::isnan(hit.wavelength));
  }
  EXPECT_EQ(count.size(), 18u);  // not the one that is off, nor the flasher
  EXPECT_EQ(count.count(3), 0u);
  EXPECT_EQ(count.count(7), 0u);
  for (const auto& [module, hits_of_it] : count) EXPECT_NEAR(hits_of_it, each, 4 * std::sqrt(each)) << module;
  EXPECT_NEAR(mean, 1500, 4 * 5000 / std::sqrt(12.0 * static_cast<double>(many.size())));
}

TEST(NoiseHits, BelongToTheirSeedAndStream) {
  const NoiseWindow window{0, 5000, 1000};
  const auto times = [&](std::uint64_t seed, std::uint64_t stream) {
    std::vector<float> all;
    for (const SimulatedHit& hit : noise_hits(noisy(600), window, {}, seed, stream)) all.push_back(hit.time);
    return all;
  };
  EXPECT_EQ(times(1, 2), times(1, 2));
  EXPECT_NE(times(1, 2), times(2, 2));
  EXPECT_NE(times(1, 2), times(1, 3));
  EXPECT_TRUE(noise_hits(noisy(0), window, {}, 1, 2).empty());
}

// Bins of light are short, but for the first and the last, which noise fills.
TEST(NoiseOfBins, IsAsLongAsTheyAre) {
  std::vector<SimulatedHit> light;
  for (int i = 0; i < 400; ++i)
    light.push_back({1, 100 + static_cast<float>(i), 400, Vec3f::UnitX(), Vec3f::UnitX(), 0});
  const RunBins bins(light, 1, std::vector<char>(20, 1), {});
  ASSERT_EQ(bins.size(), 8);
  const Eigen::VectorXd noise = noise_of_bins(bins, {-1000, 4000, 2});
  EXPECT_NEAR(noise.sum(), 2 * 5000e-9, 1e-15);
  EXPECT_NEAR(noise(0), 2 * 1150e-9, 3e-9);
  EXPECT_NEAR(noise(1), 2 * 50e-9, 3e-9);
  EXPECT_NEAR(noise(7), 2 * 3550e-9, 3e-9);
  // A window that ends within the light.
  EXPECT_NEAR(noise_of_bins(bins, {120, 260, 1}).sum(), 140e-9, 1e-15);
}

}  // namespace
}  // namespace floe
