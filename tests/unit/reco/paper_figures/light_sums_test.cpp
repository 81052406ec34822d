// What figures count: light on strings, and when it arrives.
#include <gtest/gtest.h>

#include <cmath>

#include "data/base/error.h"
#include "reco/paper_figures/arrival_curve.h"
#include "reco/paper_figures/azimuth_light.h"

namespace floe {
namespace {

SimulatedHit hit(std::uint32_t module, double time, std::uint64_t photon) {
  return {module, static_cast<float>(time), 405, Vec3f::UnitX(), Vec3f::UnitX(), photon};
}

Emitter two_neighbours() {
  Emitter emitter;
  emitter.module = {1, 1};
  emitter.neighbours = {{2, 125, 0, {4, 5}}, {3, 125, 1, {7}}};
  return emitter;
}

TEST(LightOnNeighbours, AddsHitsAndTheSquaresOfPhotons) {
  // Photon 1 is seen twice on one string and once on the other; module 9 is on neither.
  const std::vector<SimulatedHit> hits{hit(4, 0, 1), hit(5, 0, 1), hit(7, 0, 1), hit(4, 0, 2), hit(9, 0, 3)};
  const auto light = light_on_neighbours(two_neighbours(), hits);
  ASSERT_EQ(light.size(), 2U);
  EXPECT_EQ(light[0].sum, 3);
  EXPECT_EQ(light[0].variance, 5);
  EXPECT_EQ(light[1].sum, 1);
  EXPECT_EQ(light[1].variance, 1);
}

TEST(AzimuthPoints, AreRatiosWithTheErrorsOfBoth) {
  const std::vector<Emitter> emitters{two_neighbours()};
  const RingLight light{{{100, 100}, {50, 60}}}, isotropic{{{200, 200}, {50, 50}}};
  const auto points = azimuth_points(emitters, light, isotropic);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_DOUBLE_EQ(points[0].ratio, 0.5);
  EXPECT_DOUBLE_EQ(points[0].relative_error, std::sqrt(1 / 100.0 + 1 / 200.0));
  EXPECT_DOUBLE_EQ(points[1].relative_error, std::sqrt(60 / 2500.0 + 1 / 50.0));
  EXPECT_EQ(points[1].azimuth, 1);
  EXPECT_THROW(azimuth_points(emitters, light, {{{200, 200}, {0, 0}}}), NoResult);
}

TEST(ArrivalCurve, CountsByTime) {
  const std::vector<double> edges{100, 120, 150};
  const std::vector<std::uint32_t> modules{4, 5};
  const std::vector<SimulatedHit> hits{hit(4, 100, 1), hit(5, 119, 2), hit(5, 120, 3),
                                       hit(4, 99, 4),  hit(4, 150, 5), hit(7, 110, 6)};
  const ArrivalCurve curve = arrival_curve(hits, modules, edges);
  EXPECT_EQ(curve.charge, (std::vector<double>{2, 1}));
  EXPECT_EQ(curve.variance, (std::vector<double>{2, 1}));
  EXPECT_EQ(curve.total, 5);  // at all times
  EXPECT_EQ(curve.median, 119);
  EXPECT_GT(curve.median_error, 0);
}

TEST(ArrivalEdges, BeginBeforeTheFirstLightAndGrow) {
  const auto edges = arrival_edges(125);
  EXPECT_LT(edges.front(), 125 / 0.2998 * 1.35);
  EXPECT_GT(edges.front(), 125 / 0.2998 * 1.30 - 40);
  for (std::size_t i = 2; i < edges.size(); ++i)
    EXPECT_GE(edges[i] - edges[i - 1], edges[i - 1] - edges[i - 2]);
  EXPECT_GT(edges.back(), 2500);
}

}  // namespace
}  // namespace floe
