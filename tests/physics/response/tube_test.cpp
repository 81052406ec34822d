// What the photomultiplier does, against the formulas that it is said to follow.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/physics/response/chi_square.h"

#include "response/afterpulses.h"
#include "response/dark_noise.h"
#include "response/photoelectron_charge.h"
#include "response/transit_time.h"
#include "response/tube_saturation.h"

namespace floe {

using namespace test;

namespace {

constexpr int many = 400000;

double normal_below(double z) {
  return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

TEST(PhotoelectronCharge, FollowsItsDensity) {
  PhotoelectronChargeSettings three;  // with the steep part, as published for single modules
  three.steep_share = 0.2289;
  three.exponential_share = 0.2322;
  for (const auto& settings : {PhotoelectronChargeSettings(), three}) {
    const PhotoelectronCharge charge(settings);
    RandomStream stream(1, 2, 3);
    std::vector<double> drawn(many);
    for (double& q : drawn) q = charge.draw(stream);
    expect_distribution(drawn, even_edges(0, 2, 100), [&](double q) { return charge.probability_below(q); });
    // The width of one charge is below 0.6: the mean of many is good to 0.6/sqrt(N).
    EXPECT_NEAR(mean_of(drawn), charge.mean(), 5 * 0.6 / std::sqrt(many));
  }
}

TEST(PhotoelectronCharge, DensityAndProbabilityAndMeanBelongTogether) {
  const PhotoelectronCharge charge;
  double below = 0, mean = 0;
  constexpr double step = 1e-4;
  for (double q = step / 2; q < 12; q += step) {
    below += charge.density(q) * step;
    mean += q * charge.density(q) * step;
    if (std::abs(q - 0.70005) < step / 4) {
      EXPECT_NEAR(below, charge.probability_below(q + step / 2), 1e-6);
    }
  }
  EXPECT_NEAR(below, 1, 1e-6);
  EXPECT_NEAR(mean, charge.mean(), 1e-5);
}

TEST(TransitTime, PeakFollowsItsDensityAndHasMeanZero) {
  const TransitTimeSettings settings;
  const TransitTime time(settings);
  RandomStream stream(4, 5, 6);
  std::vector<double> peak;
  for (int i = 0; i < many; ++i)
    if (const auto arrival = time.draw(stream); arrival.origin == PhotoelectronOrigin::photon)
      peak.push_back(arrival.delay);
  // Two halves of Gaussians that meet 1.197 ns before the mean, 1.2 and 2.7 ns wide, shares as their widths.
  const double mode = -std::sqrt(2 / 3.14159265358979) * (settings.fall - settings.rise);
  const double early = settings.rise / (settings.rise + settings.fall);
  expect_distribution(peak, even_edges(-4, 7, 110), [&](double t) {
    const double z = (t - mode) / (t < mode ? settings.rise : settings.fall);
    return t < mode ? 2 * early * normal_below(z) : early + (1 - early) * (2 * normal_below(z) - 1);
  });
  EXPECT_NEAR(mean_of(peak), 0, 5 * 2.1 / std::sqrt(many));
}

TEST(TransitTime, OtherPulsesHaveTheirSharesAndTimes) {
  const TransitTimeSettings settings;
  const TransitTime time(settings);
  RandomStream stream(7, 8, 9);
  int pre = 0, shoulder = 0, peak = 0, tail = 0;
  for (int i = 0; i < many; ++i) {
    const auto arrival = time.draw(stream);
    if (arrival.origin == PhotoelectronOrigin::prepulse) {
      ++pre;
      EXPECT_EQ(arrival.delay, settings.prepulse_time);
      EXPECT_EQ(arrival.charge_share, settings.prepulse_charge);
    }
    if (arrival.origin != PhotoelectronOrigin::late) continue;
    EXPECT_EQ(arrival.charge_share, 1);
    (arrival.delay < 50 ? shoulder : arrival.delay < 84 ? peak : tail) += 1;
  }
  const auto expect_share = [](int count, double share) {
    EXPECT_NEAR(count, many * share, 5 * std::sqrt(many * share));
  };
  expect_share(pre, settings.prepulse_share);
  expect_share(shoulder, settings.shoulder_share * 25 / 40);  // from 25 to 50 of 25 to 65 ns
  expect_share(peak, settings.late_peak_share + settings.shoulder_share * 15 / 40);
  expect_share(tail, settings.tail_share);
}

struct Moments {
  double share = 0, mean = 0, deviation = 0;
};
template <typename Wanted>
Moments moments_of(const std::vector<ExpectedDelay>& delays, Wanted wanted) {
  Moments m;
  double square = 0;
  for (const ExpectedDelay& delay : delays) {
    const double middle = (delay.begin + delay.end) / 2, width = delay.end - delay.begin;
    if (!wanted(middle)) continue;
    m.share += delay.share;
    m.mean += delay.share * middle;
    square += delay.share * (middle * middle + width * width / 12);
  }
  m.mean /= m.share;
  m.deviation = std::sqrt(square / m.share - m.mean * m.mean);
  return m;
}

// What fits are told has the share, mean and width of what is drawn: of the peak, and of late pulses.
TEST(TransitTime, DelaysAreAsExpected) {
  const TransitTime time;
  constexpr double late = 15;  // [ns]: far from both
  for (const PhotoelectronOrigin origin : {PhotoelectronOrigin::photon, PhotoelectronOrigin::late}) {
    RandomStream stream(3, 1, 4);
    std::vector<double> drawn;
    for (int i = 0; i < many; ++i)
      if (const auto arrival = time.draw(stream); arrival.origin == origin) drawn.push_back(arrival.delay);
    const auto expected = moments_of(time.expected_delays(), [&](double middle) {
      return (middle > late) == (origin == PhotoelectronOrigin::late);
    });
    const double n = static_cast<double>(drawn.size()), mean = mean_of(drawn);
    EXPECT_NEAR(n, many * expected.share, 5 * std::sqrt(many * expected.share * (1 - expected.share)));
    EXPECT_NEAR(mean, expected.mean, 5 * expected.deviation / std::sqrt(n));
    double variance = 0;
    for (const double delay : drawn) variance += (delay - mean) * (delay - mean) / n;
    const double by_boxes = 0.003;
    EXPECT_NEAR(std::sqrt(variance), expected.deviation,
                (5 / std::sqrt(2 * n) + by_boxes) * expected.deviation);
  }
}

// A tube without spread gives its light at once.
TEST(TransitTime, WithoutSpreadNothingIsDelayed) {
  TransitTimeSettings settings;
  settings.rise = settings.fall = settings.shoulder_share = settings.late_peak_share = settings.tail_share =
      0;
  EXPECT_TRUE(TransitTime(settings).expected_delays().empty());
}

TEST(Afterpulses, AreEvenInTheLogarithmOfTime) {
  const ExpectedAfterpulses after{0.059, 300, 11000};
  RandomStream stream(10, 11, 12);
  std::vector<double> delays(many);
  for (double& delay : delays) delay = draw_afterpulse_delay(after, stream);
  expect_distribution(delays, even_edges(300, 11000, 100),
                      [&](double delay) { return afterpulses_until(after, delay); });
}

TEST(DarkNoise, SinglesArePoissonAndBurstsAddUp) {
  const DarkNoiseSettings settings;
  constexpr double window = 1e7;  // [ns]
  constexpr int windows = 20000;
  double count = 0, square = 0;
  for (int i = 0; i < windows; ++i) {
    RandomStream stream(1, 1, static_cast<std::uint64_t>(i));
    const auto times = draw_dark_noise(settings, 1, 0, window, stream);
    for (const double time : times) EXPECT_TRUE(time >= 0 && time < window);
    count += static_cast<double>(times.size());
    square += static_cast<double>(times.size() * times.size());
  }
  const double mean = count / windows, variance = square / windows - mean * mean;
  EXPECT_NEAR(mean, settings.rate() * window * 1e-9, 5 * std::sqrt(variance / windows) + 2e-4 * mean);
  // A window is long beside a burst: singles have variance 1 a photoelectron, bursts of Poisson size b 1 + b.
  const double singles = settings.single_rate / settings.rate();
  EXPECT_NEAR(variance / mean, singles + (1 - singles) * (1 + settings.burst_size), 0.1);
}

TEST(DarkNoise, GapsInBurstsAreLogNormal) {
  DarkNoiseSettings bursts;
  bursts.single_rate = 0;
  bursts.burst_rate = 0.05;  // so rare that two hardly ever overlap
  std::vector<double> gaps;
  for (int i = 0; i < 60; ++i) {
    RandomStream stream(2, 2, static_cast<std::uint64_t>(i));
    auto times = draw_dark_noise(bursts, 1, 0, 1e13, stream);
    std::sort(times.begin(), times.end());
    for (std::size_t k = 1; k < times.size(); ++k)
      if (const double gap = std::log10((times[k] - times[k - 1]) * 1e-9); gap < -2.6) gaps.push_back(gap);
  }
  // Beyond 10^-2.6 s (4 sigma) a gap may be one between bursts.
  ASSERT_GT(gaps.size(), 50000u);
  expect_distribution(gaps, even_edges(-8.5, -3.5, 50), [&](double gap) {
    return normal_below((gap - bursts.gap_log10_mean) / bursts.gap_log10_width) / normal_below(4);
  });
}

TEST(DarkNoise, ModulesOfHighEfficiencyHaveMore) {
  const DarkNoiseSettings settings;
  double count = 0;
  for (int i = 0; i < 1000; ++i) {
    RandomStream stream(3, 3, static_cast<std::uint64_t>(i));
    count += static_cast<double>(draw_dark_noise(settings, 1.39, 0, 1e8, stream).size());
  }
  EXPECT_NEAR(count / 100, settings.rate() * 1.39, 5 * std::sqrt(3.0 * settings.rate() * 1.39 / 100));
}

TEST(TubeSaturation, SolvesThePublishedEquation) {
  const TubeSettings tube;
  for (const double ideal : {1e-3, 1.0, 10.0, 40.0, 150.0, 1000.0, 1e5}) {
    const double current = compressed_current(tube, ideal), x = current / tube.largest_current;
    ASSERT_LT(x, 1);
    EXPECT_NEAR(std::log(ideal),
                std::log(current) + tube.factor * std::pow(x, tube.exponent) / std::pow(1 - x, 0.25), 1e-6);
  }
  EXPECT_EQ(compressed_current(tube, 0), 0);
}

TEST(TubeSaturation, ReducesWhatComesAtOnceAndNothingElse) {
  const TubeSettings tube;
  // 2000 photoelectrons within a nanosecond: an ideal current far above what the tube can give; 2000 over 20
  // microseconds: 0.16 mA.
  std::vector<Photoelectron> flash, rain;
  for (int i = 0; i < 2000; ++i) {
    flash.push_back({1000 + 0.0005 * i});
    rain.push_back({10.0 * i});
  }
  const auto saturated = saturate(tube, flash);
  ASSERT_EQ(saturated.size(), 1u);
  EXPECT_LT(saturated[0].begin, 1000);
  EXPECT_GT(saturated[0].end, 1001);
  const double ideal = 2000 * 1e7 * 1.602176634e-19 * 1e12 / (3.2 * std::sqrt(2 * 3.14159265358979));
  EXPECT_NEAR(flash[1000].charge, compressed_current(tube, ideal) / ideal, 0.01);
  EXPECT_TRUE(saturate(tube, rain).empty());
  for (const Photoelectron& pe : rain) EXPECT_NEAR(pe.charge, 1, 1e-3);
}

}  // namespace floe
