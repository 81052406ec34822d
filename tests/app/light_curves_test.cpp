// Hits as light curves: nothing is lost, and many hits become no more bins than were asked for.
#include "apps/view/light_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace floe {
namespace {

Hit hit_at(ModuleId module, double time, float charge = 1) {
  Hit hit;
  hit.module = module;
  hit.time = time;
  hit.charge = charge;
  return hit;
}

TEST(LightCurves, AreBinnedModuleByModule) {
  const Detector detector = ic86_detector();
  const std::vector<Hit> hits{hit_at({3, 4}, 12.5, 2), hit_at({1, 2}, 10.25), hit_at({3, 4}, 12.75),
                              hit_at({3, 4}, 20), hit_at({100, 1}, 0)};
  const LightCurves curves = light_curves(hits, detector);
  EXPECT_EQ(curves.left_out, 1u);
  EXPECT_EQ(curves.begin, 10);
  EXPECT_EQ(curves.end, 20);
  EXPECT_EQ(curves.bin_width, 1);
  ASSERT_EQ(curves.modules.size(), 2u);
  const LightCurve& second = curves.modules[1];
  EXPECT_EQ(second.module, *detector.find({3, 4}));
  EXPECT_EQ(second.hits, 3u);
  EXPECT_EQ(second.charge, 4);
  EXPECT_EQ(second.first, 12.5);
  EXPECT_EQ(second.bins, (std::vector<std::uint32_t>{2, 10}));
  EXPECT_EQ(second.charge_in_bin, (std::vector<double>{3, 1}));
}

TEST(LightCurves, OfManyHitsHaveFewBins) {
  const Detector detector = ic86_detector();
  std::mt19937 random(1);
  std::exponential_distribution<double> time(1 / 1000.0);
  std::vector<Hit> hits;
  for (int i = 0; i < 300000; ++i)
    hits.push_back(hit_at(detector.modules()[random() % 5160].id, time(random), 0.5f));
  const LightCurves curves = light_curves(hits, detector, 50000);
  std::size_t bins = 0;
  double charge = 0;
  for (const LightCurve& curve : curves.modules) {
    bins += curve.bins.size();
    for (const double q : curve.charge_in_bin) charge += q;
    for (std::size_t i = 1; i < curve.bins.size(); ++i) ASSERT_LT(curve.bins[i - 1], curve.bins[i]);
  }
  EXPECT_LE(bins, 50000u);
  EXPECT_GT(bins, 15000u);  // 1, 2, 5: no more than 2.5 times as wide as need be
  EXPECT_EQ(charge, 150000);
  // 58 hits a module within some 1000 ns: 15 bins of 200 ns each would be too many, 8 of 500 ns are not.
  EXPECT_EQ(curves.bin_width, 500);
}

TEST(LightCurves, OfFewBinsOrNoHitsEnd) {
  const Detector detector = ic86_detector();
  EXPECT_TRUE(light_curves({}, detector).modules.empty());
  const std::vector<Hit> far{hit_at({1, 1}, -1e15), hit_at({2, 1}, 1e15)};
  const LightCurves curves = light_curves(far, detector, 1);  // fewer bins than modules
  EXPECT_EQ(curves.modules.size(), 2u);
}

}  // namespace
}  // namespace floe
