// Hole-ice columns in the whole engine, on scenes with closed-form answers.
#include <gtest/gtest.h>

#include <cmath>

#include "data/base/constants.h"
#include "propagation/engine/simulator.h"
#include "propagation/sources/flasher.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

using test::line_at_400;
using test::uniform_tables;
using test::UniformIce;

constexpr UniformIce clear{1e9, 1e9};
constexpr double transparent = 1e6;  // longest length that an ice model may name [m]

HoleIce column_of(double radius, const UniformIce& ice) {
  return {radius / module_radius, ice.effective_scattering_length, ice.absorption_length, ice.liu_fraction,
          ice.mean_cosine};
}

// Modules on strings of their own; the drill holes stand where `holes` says, a string each.
Model make_model(IceTables tables, const HoleIce& column, const std::vector<Vec3>& positions,
                 const std::vector<Eigen::Vector2d>& holes = {}) {
  tables.configuration.hole_ice = column;
  std::vector<Module> modules;
  std::map<int, Eigen::Vector2d> centres;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    Module module;
    module.id = {static_cast<int>(i) + 1, 1};
    module.position = positions[i];
    modules.push_back(module);
    if (i < holes.size()) centres[module.id.string] = holes[i];
  }
  Model model;
  model.detector = std::make_shared<Detector>("test", modules, centres);
  model.ice = std::make_shared<IceModel>(std::move(tables), *model.detector);
  return model;
}

struct Mean {
  double value, error;
};
template <typename Get>
Mean mean_over(const std::vector<SimulatedHit>& hits, const Get& get) {
  double sum = 0, squares = 0;
  for (const SimulatedHit& hit : hits) {
    const double value = get(hit);
    sum += value, squares += value * value;
  }
  const double n = static_cast<double>(hits.size()), mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean) / n)};
}
void expect_same(const Mean& a, const Mean& b) {
  EXPECT_NEAR(a.value, b.value, 4 * std::hypot(a.error, b.error));
}

class HoleIceWalk : public ::testing::TestWithParam<EngineKind> {
 protected:
  std::vector<SimulatedHit> simulate(const Model& model, const Source& source, double oversize = 1,
                                     std::uint64_t seed = 1) const {
    const Simulator simulator(model, oversize, GetParam());
    SimulationOptions options;
    options.seed = seed;
    options.fixed_number = true;
    std::vector<SimulatedHit> hits;
    simulator.run(source, options, [&](std::span<const SimulatedHit> portion) {
      hits.insert(hits.end(), portion.begin(), portion.end());
    });
    return hits;
  }
};

// A beam through a column that only absorbs: exp(-chord/length), after the time of a straight flight.
TEST_P(HoleIceWalk, AbsorbingColumnDimsByItsChord) {
  const double radius = 0.4, length = 0.5, photons = 40000;
  const HoleIce column = column_of(radius, {transparent, length, 0.35, 0.9});
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0.6, 0, 0.8)})
    for (const double aside : {0.0, 0.2, 0.38, 0.45}) {
      const Model model = make_model(uniform_tables(clear), column, {10 * direction}, {{2, aside}});
      const PointSource source(-5 * direction, 0, photons, line_at_400(), direction);
      const auto hits = simulate(model, source);
      const double chord =
          aside < radius ? 2 * std::sqrt(radius * radius - aside * aside) / direction.x() : 0;
      const double expected = photons * std::exp(-chord / length);
      EXPECT_NEAR(static_cast<double>(hits.size()), expected, 4 * std::sqrt(expected) + 1) << aside;
      for (const SimulatedHit& hit : hits) {
        const double flown = hit.time * speed_of_light / group_index(400);
        ASSERT_NEAR(flown, 15 - module_radius, 1e-3);
      }
    }
}

// A beam through a column that only scatters: what arrives undeflected is exp(-chord b), with
// b = 1/(effective length (1 - g)).
TEST_P(HoleIceWalk, ScatteringColumnHasTheGeometricMeanFreePath) {
  const double radius = 0.4, effective_length = 5, photons = 40000;
  for (const double g : {0.0, 0.9}) {
    const HoleIce column = column_of(radius, {effective_length, transparent, 0.35, g});
    const Model model = make_model(uniform_tables(clear), column, {Vec3(10, 0, 0)}, {{2, 0.1}});
    const PointSource source(Vec3(-5, 0, 0), 0, photons, line_at_400(), Vec3::UnitX());
    double straight = 0;
    for (const SimulatedHit& hit : simulate(model, source)) straight += hit.direction.x() == 1;
    const double chord = 2 * std::sqrt(radius * radius - 0.01);
    const double expected = photons * std::exp(-chord / (effective_length * (1 - g)));
    EXPECT_NEAR(straight, expected, 4 * std::sqrt(expected)) << g;
  }
}

// A column so wide that hardly any light leaves it is a bulk of its ice.
TEST_P(HoleIceWalk, WideColumnIsABulkOfItsIce) {
  const UniformIce ice{1, 3, 0.2, 0.8};
  const std::vector<Vec3> positions = {Vec3(2, 0, 0), Vec3(0, 1, 2)};
  const std::vector<Eigen::Vector2d> holes = {{0, 0}, {0.5, 0}};
  const Model inside = make_model(uniform_tables(clear), column_of(15, ice), positions, holes);
  const Model bulk = make_model(uniform_tables(ice), {}, positions);
  const PointSource source(Vec3::Zero(), 0, 1.5e6, line_at_400());
  const auto a = simulate(inside, source, 4, 1), b = simulate(bulk, source, 4, 2);
  ASSERT_GT(a.size(), 1000U);
  // Photons are seen more than once: counts are over-dispersed (a factor of 2 in variance at most).
  EXPECT_NEAR(static_cast<double>(a.size()), static_cast<double>(b.size()),
              4 * std::sqrt(2.0 * static_cast<double>(a.size() + b.size())));
  expect_same(mean_over(a, [](const SimulatedHit& hit) { return hit.time; }),
              mean_over(b, [](const SimulatedHit& hit) { return hit.time; }));
  for (int axis = 0; axis < 3; ++axis) {
    const auto component = [=](const SimulatedHit& hit) { return hit.direction[axis]; };
    const auto square = [=](const SimulatedHit& hit) { return hit.direction[axis] * hit.direction[axis]; };
    expect_same(mean_over(a, component), mean_over(b, component));
    expect_same(mean_over(a, square), mean_over(b, square));
  }
}

// Columns of the ice around them change nothing but the paths of single photons.
TEST_P(HoleIceWalk, ColumnsOfTheBulksIceChangeNothing) {
  const UniformIce ice{2, 20, 0.35, 0.9};
  const std::vector<Vec3> positions = {Vec3(1, 0, 0), Vec3(6, 0, 0), Vec3(0, -4, 3), Vec3(0.6, 0.6, -1)};
  const Model with = make_model(uniform_tables(ice), column_of(0.4, ice), positions);
  const Model without = make_model(uniform_tables(ice), {}, positions);
  const PointSource source(Vec3::Zero(), 0, 1e6, line_at_400());
  const auto a = simulate(with, source, 4, 1), b = simulate(without, source, 4, 2);
  std::array<double, 4> counts_a{}, counts_b{};
  for (const SimulatedHit& hit : a) ++counts_a[hit.module];
  for (const SimulatedHit& hit : b) ++counts_b[hit.module];
  for (std::size_t i = 0; i < positions.size(); ++i) {
    EXPECT_GT(counts_a[i], 50);
    EXPECT_NEAR(counts_a[i], counts_b[i], 4 * std::sqrt(1.5 * (counts_a[i] + counts_b[i]))) << i;
  }
  expect_same(mean_over(a, [](const SimulatedHit& hit) { return hit.time; }),
              mean_over(b, [](const SimulatedHit& hit) { return hit.time; }));
}

// Crystals turn a photon on its way through the bulk, and not inside a column: 5 m before the column, 10 m
// inside, 5 m behind it, with the step for the first 5 m taken at the column's surface.
TEST_P(HoleIceWalk, CrystalsActOnTheBulksShareOfThePath) {
  IceTables tables = uniform_tables({2.0, 1e6, 0.35, 0.9});  // birefringence takes its share of this
  BirefringenceNumbers numbers;
  numbers.sigma_x = {0.03, 0, 1, 1};  // the same at all angles: exp(0)
  numbers.sigma_y = {0.02, 0, 1, 1};
  tables.configuration.birefringence = numbers;
  for (IceLayerRow& row : tables.layers)
    row.effective_scattering = 1e-6 + mean_birefringent_scattering(numbers);
  const double radius = 5, photons = 20000;
  const Model model = make_model(tables, column_of(radius, {transparent, transparent, 0.35, 0.9}),
                                 {Vec3(0, 15, 0)}, {{0, 0}});
  // The widest module catches all of the light.
  const auto hits =
      simulate(model, PointSource(Vec3(0, -10, 0), 0, 1e4 * photons, line_at_400(), Vec3::UnitY()), 100);
  ASSERT_NEAR(static_cast<double>(hits.size()), photons, 0.005 * photons);
  const auto spread = [&](int axis) {
    return mean_over(hits,
                     [=](const SimulatedHit& hit) { return hit.direction[axis] * hit.direction[axis]; });
  };
  // Flow along x: sigma_x turns the photon in x, sigma_y in z. On the sphere p becomes sin(theta),
  // theta = 2 atan(p/2): second order, below p^2 = 0.5%.
  EXPECT_NEAR(spread(0).value, 5 * 0.03 * 0.03, 4 * spread(0).error + 0.005 * 5 * 0.03 * 0.03);
  EXPECT_NEAR(spread(2).value, 5 * 0.02 * 0.02, 4 * spread(2).error + 0.005 * 5 * 0.02 * 0.02);
}

// Light that falls onto a module inside its column comes from more and more directions the more the column
// scatters, and less of it arrives.
TEST_P(HoleIceWalk, ScatteringColumnBlursTheDirections) {
  double narrower = 1 + 1e-6, brighter = 1e9;
  for (const double effective_length : {transparent, 1.0, 0.3, 0.1, 0.05}) {
    const HoleIce column = column_of(2 * module_radius, {effective_length, 100, 0.35, 0.9});
    const Model model = make_model(uniform_tables(clear), column, {Vec3::Zero()});
    const PointSource source(Vec3(-10, 0, 0), 0, 4000, line_at_400(), Vec3::UnitX());
    const auto hits = simulate(model, source);
    const Mean cosine = mean_over(hits, [](const SimulatedHit& hit) { return hit.direction.x(); });
    EXPECT_LE(cosine.value + 4 * cosine.error, narrower) << effective_length;
    EXPECT_LE(static_cast<double>(hits.size()), brighter) << effective_length;
    if (effective_length == transparent) {
      EXPECT_NEAR(cosine.value, 1, 1e-6);
    }
    narrower = cosine.value;
    brighter = static_cast<double>(hits.size());
  }
  EXPECT_LT(narrower, 0.9);
}

// Without a radius every photon is what it is without the block.
TEST_P(HoleIceWalk, RadiusZeroIsOff) {
  const UniformIce ice{2, 20, 0.35, 0.9};
  const std::vector<Vec3> positions = {Vec3(1, 0, 0), Vec3(0, -4, 3)};
  const PointSource source(Vec3::Zero(), 0, 20000, line_at_400());
  const auto a =
      simulate(make_model(uniform_tables(ice), column_of(0, {0.1, 1, 0.5, 0.5}), positions), source);
  const auto b = simulate(make_model(uniform_tables(ice), {}, positions), source);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 50U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].photon, b[i].photon);
    ASSERT_EQ(a[i].time, b[i].time);
  }
}

// A flasher inside its own column shines out of it; light that comes back to the flashing module is lost.
TEST_P(HoleIceWalk, FlasherShinesOutOfItsColumn) {
  const std::vector<Vec3> positions = {Vec3::Zero(), Vec3(2, 0, 0)};
  const HoleIce column = column_of(1.5 * module_radius, {0.2, 100, 0.35, 0.9});
  const Model model = make_model(uniform_tables(clear), column, positions);
  FlasherSettings settings;
  settings.photons = 40000;
  settings.isotropic = true;
  const FlasherSource source(*model.detector, {1, 1}, settings, line_at_400());
  const auto hits = simulate(model, source);
  EXPECT_GT(hits.size(), 20U);
  for (const SimulatedHit& hit : hits) ASSERT_EQ(hit.module, 1U);
}

INSTANTIATE_TEST_SUITE_P(Engines, HoleIceWalk, ::testing::Values(EngineKind::plain, EngineKind::vector),
                         [](const auto& engine) {
                           return engine.param == EngineKind::vector ? "vector" : "plain";
                         });

}  // namespace
}  // namespace floe
