// Dark noise, modules and times left out, saturation: what they do to bins and likelihood.
#include "reco/data_selection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "data/base/error.h"
#include "reco/direct_fit/goodness_of_fit.h"
#include "reco/event_data.h"
#include "reco/likelihood/limited_simulation.h"
#include "tests/unit/reco/one_string.h"

namespace floe {
namespace {

using test::hit;

const Detector detector = test::one_string(4, 4);

TEST(DataSelection, BadModulesAreLeftOutOnBothSides) {
  DataSelection selection;
  selection.bad = {{1, 1}, {1, 3}};
  const EventData data(detector, {"e", {hit(1, 50), hit(2, 10, 2)}, {}, 1}, selection);
  ASSERT_EQ(data.lit().size(), 1u);
  EXPECT_EQ(data.lit()[0].module, 1u);
  EXPECT_EQ(data.dark(), (std::vector<std::uint32_t>{3}));
  EXPECT_DOUBLE_EQ(data.charge(), 2);
  selection.bad = {{7, 1}};
  EXPECT_THROW(EventData(detector, {"e", {}, {}, 1}, selection), InputError);
}

TEST(DataSelection, TimesLeftOutHoldNothingAndCostNothing) {
  DataSelection selection;
  selection.left_out = {{std::nullopt, 100, 200}, {ModuleId{1, 2}, 300, 400}};
  const EventData data(detector, {"e", {hit(1, 50), hit(1, 150, 5), hit(2, 350, 7), hit(3, 350, 3)}, {}, 1},
                       selection);
  EXPECT_DOUBLE_EQ(data.charge(), 4);
  ASSERT_EQ(data.lit().size(), 4u);  // all have a window
  for (const ModuleData& lit : data.lit())
    for (std::size_t b = 0; b < lit.counts.size(); ++b) {
      const double low = b == 0 ? -1e9 : lit.edges[b - 1], high = b == lit.edges.size() ? 1e9 : lit.edges[b];
      const bool inside = (low >= 100 && high <= 200) || (lit.module == 1 && low >= 300 && high <= 400);
      EXPECT_EQ(lit.left_out[b], inside) << lit.module << " " << low;
      if (inside) {
        EXPECT_EQ(lit.counts[b], 0);
      }
    }
  // Expected light in the windows costs no likelihood.
  LightSample sample;
  fill(sample, 4,
       {{0, 50.f}, {0, 110.f}, {0, 190.f}, {1, 310.f}, {1, 390.f}, {2, 350.f}, {2, 350.f}, {2, 350.f}});
  EXPECT_DOUBLE_EQ(neg_llh(count_bins(data, sample, 0), 0.1), 0);
}

TEST(DataSelection, NoiseIsAKnownFloor) {
  DataSelection selection;
  selection.noise_rate = 500;
  selection.noise_of[{1, 2}] = 2000;
  const EventData data(detector, {"e", {hit(1, 0), hit(2, 600)}, {}, 1}, selection);
  const double width = 600 + 2 * EventData::margin;
  for (const ModuleData& lit : data.lit()) {
    const double rate = lit.module == 1 ? 2000 : 500;
    EXPECT_NEAR(std::accumulate(lit.noise.begin(), lit.noise.end(), 0.0), rate * 1e-9 * width, 1e-15);
  }
  EXPECT_NEAR(data.dark_noise(2), 500e-9 * width, 1e-15);
  LightSample empty;
  fill(empty, 4, {});
  empty.repeats = 3;
  for (const BinOfData& bin : count_bins(data, empty, 0)) {
    EXPECT_GT(bin.simulation, 0);  // no hit is impossible
    EXPECT_TRUE(std::isfinite(bin.likelihood(0.1).value));
  }
}

TEST(DataSelection, SaturatedModulesOnlySayThatThereWasSoMuch) {
  DataSelection selection;
  selection.charge_cap = 100;
  const EventData data(detector, {"e", {hit(1, 0, 400), hit(2, 600, 99)}, {}, 1}, selection);
  ASSERT_EQ(data.lit().size(), 2u);
  EXPECT_TRUE(data.lit()[0].saturated);
  EXPECT_EQ(data.lit()[0].counts, (std::vector<double>{100}));
  EXPECT_FALSE(data.lit()[1].saturated);
  // In whatever bins it is cut.
  const EventData again = data.with_edges(std::vector<std::vector<double>>{{10, 20}, {590, 610}});
  EXPECT_EQ(again.lit()[0].counts.size(), 1u);
  EXPECT_EQ(again.lit()[1].counts, (std::vector<double>{0, 99, 0}));
}

TEST(DataSelection, RefusesWhatMakesNoSense) {
  const auto refused = [](const DataSelection& selection) {
    EXPECT_THROW(EventData(detector, {"e", {}, {}, 1}, selection), UsageError);
  };
  DataSelection noise, window, cap, of;
  noise.noise_rate = -1;
  of.noise_of[{1, 1}] = 1e9;
  window.left_out = {{std::nullopt, 5, 5}};
  cap.charge_cap = 0;
  for (const DataSelection& selection : {noise, window, cap, of}) refused(selection);
}

// P(N >= d) by summing the Poisson distribution.
TEST(AtLeast, IsThePoissonTailForEndlessSimulations) {
  for (const double mean : {0.3, 5.0, 40.0, 200.0})
    for (const int cap : {1, 3, 30, 150}) {
      double below = 0, term = std::exp(-mean);
      for (int n = 0; n < cap; ++n) below += term, term *= mean / (n + 1);
      if (1 - below < 1e-6) continue;  // lost to cancellation here, not there
      const BinLikelihood value = at_least({double(cap), 1, 1e12 * mean, 1e12}, 0);
      EXPECT_NEAR(value.value, -std::log(1 - below), 1e-4 * (1 + value.value)) << mean << " " << cap;
    }
}

TEST(AtLeast, HasTheRightDerivatives) {
  for (const double sigma : {0.0, 0.1, 0.5})
    for (const double mean : {2.0, 60.0, 100.0, 140.0, 1000.0}) {
      const auto at = [&](double log_change) {
        return at_least({100, 1, 50 * mean, 50 * std::exp(-log_change)}, sigma);
      };
      const double step = 1e-4;
      const BinLikelihood here = at(0);
      EXPECT_NEAR(here.slope, (at(step).value - at(-step).value) / (2 * step),
                  1e-5 * (1 + std::abs(here.slope)));
      EXPECT_NEAR(here.curvature, (at(step).slope - at(-step).slope) / (2 * step),
                  1e-5 * (1 + std::abs(here.curvature)));
      EXPECT_LE(here.slope, 0);  // more light never contradicts it
    }
}

TEST(AtLeast, CostsNothingWhenMuchMoreIsExpected) {
  EXPECT_NEAR(at_least({100, 1, 1e5, 100}, 0.1).value, 0, 1e-9);
}

}  // namespace
}  // namespace floe
