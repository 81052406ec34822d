// Stretched absorption: photons live longer and their hits weigh less, which keeps every expectation.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "propagation/engine/simulator.h"
#include "propagation/sources/flasher.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

using test::line_at_400;
using test::make_model;
using test::uniform_tables;

class Weights : public ::testing::TestWithParam<EngineKind> {
 protected:
  std::vector<SimulatedHit> simulate(const Model& model, const Source& source, double oversize,
                                     double stretch, std::uint64_t seed = 1) const {
    const Simulator simulator(model, oversize, GetParam());
    SimulationOptions options;
    options.seed = seed;
    options.fixed_number = true;
    options.absorption_stretch = stretch;
    std::vector<SimulatedHit> hits;
    summary = simulator.run(source, options, [&](std::span<const SimulatedHit> portion) {
      hits.insert(hits.end(), portion.begin(), portion.end());
    });
    return hits;
  }
  mutable SimulationSummary summary;  // of the last simulation
};

// Sum of weights over a group of modules, and its variance: a photon's hits are not independent, photons are.
struct Light {
  double sum = 0, variance = 0;
  double relative_variance() const { return variance / (sum * sum); }
};
Light light_on(const std::vector<SimulatedHit>& hits, std::uint32_t first, std::uint32_t end) {
  std::map<std::uint64_t, double> photons;
  for (const SimulatedHit& hit : hits)
    if (hit.module >= first && hit.module < end) photons[hit.photon] += hit.weight;
  Light light;
  for (const auto& [photon, weight] : photons) light.sum += weight, light.variance += weight * weight;
  return light;
}

// Rings of 12 modules around a source in scattering ice.
Model rings(const std::vector<double>& radii) {
  std::vector<Vec3> positions;
  for (std::size_t ring = 0; ring < radii.size(); ++ring)
    for (int i = 0; i < 12; ++i)
      positions.push_back(radii[ring] * unit_vector(pi / 2, (30 * i + 15 * static_cast<int>(ring)) * degree));
  return make_model(uniform_tables({10, 15}), positions);
}

TEST_P(Weights, KeepTheLightNearAndFar) {
  const Model model = rings({5, 14, 28});
  const PointSource source(Vec3::Zero(), 0, 6e6, line_at_400());
  const auto analog = simulate(model, source, 10, 1, 1);
  for (const double stretch : {3.0, 20.0}) {
    const auto weighted = simulate(model, source, 10, stretch, 2);
    for (std::uint32_t ring = 0; ring < 3; ++ring) {
      const Light a = light_on(analog, 12 * ring, 12 * ring + 12);
      const Light b = light_on(weighted, 12 * ring, 12 * ring + 12);
      EXPECT_GT(a.sum, 30);
      EXPECT_NEAR(a.sum, b.sum, 4 * std::sqrt(a.variance + b.variance)) << stretch << ", ring " << ring;
    }
  }
}

// From the same number of photons far light comes with less noise, the more the farther.
TEST_P(Weights, LowerTheVarianceFarAway) {
  const Model model = rings({5, 14, 28});
  const PointSource source(Vec3::Zero(), 0, 6e6, line_at_400());
  const auto analog = simulate(model, source, 10, 1), weighted = simulate(model, source, 10, 4);
  std::array<double, 3> gain{};
  for (std::uint32_t ring = 0; ring < 3; ++ring)
    gain[ring] = light_on(analog, 12 * ring, 12 * ring + 12).relative_variance() /
                 light_on(weighted, 12 * ring, 12 * ring + 12).relative_variance();
  EXPECT_GT(gain[0], 1.2);
  EXPECT_GT(gain[1], 1.5 * gain[0]);
  EXPECT_GT(gain[2], 1.5 * gain[1]);
}

// Without scattering every weight is known: exp(-d (1 - 1/k)), d summed over the layers, with the
// direction's factor. exp(-d/k) of the photons arrive.
TEST_P(Weights, AreTheOpticalDepthOfThePath) {
  IceTables tables = uniform_tables({1e9, 1e9});
  for (std::size_t i = 0; i < tables.layers.size(); ++i)
    tables.layers[i].dust_absorption = 0.01 * static_cast<double>(1 + i % 7);
  tables.configuration.absorption_anisotropy = IceConfiguration::AbsorptionAnisotropy{0.6, -0.3, -0.3};
  // From the middle of the layer centred at 2050 m depth upwards to the one at 1950 m, across the flow.
  const Vec3 direction(0, 0.6, 0.8), foot(0, 0, origin_depth - 2050);
  double depth = 0;
  for (const IceLayerRow& row : tables.layers) {
    const bool end = row.depth == 1950 || row.depth == 2050;
    if (row.depth >= 1950 && row.depth <= 2050) depth += (end ? 5 : 10) * row.dust_absorption;
  }
  depth = depth / direction.z() - module_radius * tables.layers[95].dust_absorption;
  const Model model = make_model(tables, {foot + direction / direction.z() * 100});
  depth /= model.ice->absorption_anisotropy()[1];
  const double photons = 20000;
  const PointSource source(foot, 0, photons, line_at_400(), direction);
  for (const double k : {2.0, 5.0}) {
    const auto hits = simulate(model, source, 1, k);
    const double arrive = photons * std::exp(-depth / k);
    EXPECT_NEAR(static_cast<double>(hits.size()), arrive, 4 * std::sqrt(arrive));
    for (const SimulatedHit& hit : hits) ASSERT_NEAR(hit.weight / std::exp(-depth * (1 - 1 / k)), 1, 2e-3);
  }
}

TEST_P(Weights, SummariesAddThemUp) {
  const Model model = rings({6});
  const PointSource source(Vec3::Zero(), 0, 4e5, line_at_400());
  for (const double stretch : {1.0, 3.0}) {
    const auto hits = simulate(model, source, 10, stretch);
    double sum = 0, squares = 0;
    for (const SimulatedHit& hit : hits) sum += hit.weight, squares += hit.weight * hit.weight;
    EXPECT_GT(hits.size(), 50U);
    EXPECT_EQ(summary.weights.hits, hits.size());
    EXPECT_NEAR(summary.weights.sum, sum, 1e-9 * sum);
    EXPECT_NEAR(summary.weights.squares, squares, 1e-5 * squares);
    if (stretch == 1) {
      EXPECT_EQ(summary.weights.sum, static_cast<double>(hits.size()));
    }
  }
}

// Weights too small for a float are no hits: files could not hold them.
TEST_P(Weights, VanishingWeightsAreDropped) {
  const Model model = make_model(uniform_tables({1e9, 0.2}), {Vec3(30, 0, 0)});
  const PointSource source(Vec3::Zero(), 0, 2000, line_at_400(), Vec3::UnitX());
  EXPECT_TRUE(simulate(model, source, 1, 100).empty());
  EXPECT_EQ(summary.weights.hits, 0U);
}

TEST_P(Weights, StretchesOutsideTheirRangeAreRefused) {
  const Model model = rings({6});
  const PointSource source(Vec3::Zero(), 0, 10, line_at_400());
  for (const double stretch : {0.5, 0.0, -1.0, 101.0, std::nan("")})
    EXPECT_THROW(simulate(model, source, 1, stretch), UsageError) << stretch;
}

INSTANTIATE_TEST_SUITE_P(Engines, Weights, ::testing::Values(EngineKind::vector, EngineKind::plain),
                         [](const auto& engine) {
                           return engine.param == EngineKind::vector ? "vector" : "plain";
                         });

}  // namespace
}  // namespace floe
