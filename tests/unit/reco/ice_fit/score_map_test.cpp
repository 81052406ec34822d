#include "reco/ice_fit/score_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

constexpr double wavelength = 450, step = 1e-5;
constexpr std::size_t row_of_change = 90;  // of 201, top first
constexpr std::size_t layer_of_change = 200 - row_of_change;

BirefringenceNumbers crystals() {
  BirefringenceNumbers numbers;
  numbers.sigma_x = numbers.sigma_y = {0.04, 0, 1, 1};
  numbers.mean_x = {0.01, 0, 0, 1};
  return numbers;
}

// Ice in which every part that scores know of is there and depends on the colour.
ModelParts coloured_parts() {
  IceTables tables = test::uniform_tables({25, 100});
  tables.wavelength = {0.9, 1.1, 7000, 6600, {}, {}, {}};
  tables.configuration.birefringence = crystals();
  tables.configuration.absorption_anisotropy = IceConfiguration::AbsorptionAnisotropy{0.2, -0.1, -0.1};
  for (IceLayerRow& row : tables.layers) row.birefringence_strength = 3, row.deflection_strength = 0.7;
  return {tables, Detector("two", test::modules_at({Vec3(0, 0, 0), Vec3(50, 0, 0)}))};
}

// Any numbers that differ.
PathScores some_path() {
  PathScores path;
  path.layers.resize(201);
  path.lowest = 80, path.highest = 140;
  for (int i = path.lowest; i <= path.highest; ++i)
    path.layers[static_cast<std::size_t>(i)] = {-20 - 0.1 * i, 7 - 0.3 * i, 0.4 + 0.01 * i, -3 + 0.02 * i,
                                                20 + 0.1 * i};
  path.absorption_anisotropy = {0.3, -0.2, 0.5};
  return path;
}

// The score of one parameter, of which `change(parts, step)` is a step.
template <class Change>
double score_of(const ModelParts& base, const PathScores& path, Change&& change) {
  ScoreMap map(freeze(base), wavelength, 1);
  ModelParts changed = base;
  change(changed);
  EXPECT_TRUE(map.add(0, freeze(changed), step));
  Eigen::VectorXd scores, dwell;
  map.scores(path, scores, dwell);
  EXPECT_EQ(scores.size(), 1);
  return scores(0);
}

template <class Change>
bool weightable(const ModelParts& base, Change&& change) {
  ScoreMap map(freeze(base), wavelength, 1);
  ModelParts changed = base;
  change(changed);
  return map.add(0, freeze(changed), step);
}

// By exp(step) more dust: the dust's coefficient times the score, without the ice's own absorption.
TEST(ScoreMap, DustOfALayer) {
  const ModelParts base = coloured_parts();
  const PathScores path = some_path();
  const double dust = 0.01 * std::pow(wavelength / 400, -1.1);
  EXPECT_LT(dust, 0.99 * freeze(base).ice->absorption(int(layer_of_change), wavelength));
  const double score = score_of(base, path, [](ModelParts& parts) {
    parts.ice.layers[row_of_change].dust_absorption *= std::exp(step);
  });
  EXPECT_NEAR(score / (dust * path.layers[layer_of_change].absorption), 1, 2 * step);
}

TEST(ScoreMap, ScatteringOfALayer) {
  const ModelParts base = coloured_parts();
  const PathScores path = some_path();
  const double geometric = 0.04 * std::pow(wavelength / 400, -0.9) / (1 - 0.9);
  const double score = score_of(base, path, [](ModelParts& parts) {
    parts.ice.layers[row_of_change].effective_scattering *= std::exp(step);
  });
  EXPECT_NEAR(score / (geometric * path.layers[layer_of_change].scattering), 1, 2 * step);
}

// More crystals diffuse and deflect more, and leave less to dust, by the rule of the model's version.
TEST(ScoreMap, BirefringenceTakesItsShareOutOfScattering) {
  for (const int version : {0, 10, 20}) {
    ModelParts base = coloured_parts();
    base.ice.version = version;
    const PathScores path = some_path();
    const double share = 3 * mean_birefringent_scattering(crystals()) / (1 - 0.9);
    const double taken = version == 10 ? 0 : version == 0 ? share : share * std::pow(wavelength / 400, -0.9);
    const PathScores::Layer& layer = path.layers[layer_of_change];
    const double expected = 3 * layer.diffusion + 3 * 0.7 * layer.deflection - taken * layer.scattering;
    const double score = score_of(base, path, [](ModelParts& parts) {
      parts.ice.layers[row_of_change].birefringence_strength *= std::exp(step);
    });
    EXPECT_NEAR(score / expected, 1, 3 * step) << version;
  }
}

TEST(ScoreMap, DeflectionOfALayer) {
  const PathScores path = some_path();
  const double score = score_of(coloured_parts(), path, [](ModelParts& parts) {
    parts.ice.layers[row_of_change].deflection_strength *= std::exp(step);
  });
  EXPECT_NEAR(score / (3 * 0.7 * path.layers[layer_of_change].deflection), 1, 2 * step);
}

TEST(ScoreMap, AbsorptionAnisotropy) {
  const ModelParts base = coloured_parts();
  const PathScores path = some_path();
  const auto with = [&](double k1) {
    ModelParts parts = base;
    parts.ice.configuration.absorption_anisotropy =
        IceConfiguration::AbsorptionAnisotropy{k1, -k1 / 2, -k1 / 2};
    return parts;
  };
  const double h = 1e-3;
  const auto up = freeze(with(0.2 + h)).ice->absorption_anisotropy();
  const auto down = freeze(with(0.2 - h)).ice->absorption_anisotropy();
  double expected = 0;
  for (std::size_t i = 0; i < 3; ++i) expected += (up[i] - down[i]) / (2 * h) * path.absorption_anisotropy[i];
  const double score = score_of(base, path, [&](ModelParts& parts) { parts = with(0.2 + step); });
  EXPECT_NEAR(score / expected, 1, 1e-4);
}

// Where layers rise by d, a place has the ice that was d below. Here the ice gets clearer upwards.
TEST(ScoreMap, RiseOfLayers) {
  constexpr double rise = 1e-3;  // m a m
  ModelParts base = coloured_parts();
  for (std::size_t i = 0; i < base.ice.layers.size(); ++i)
    base.ice.layers[i].dust_absorption = 0.01 + 1e-4 * static_cast<double>(i);
  base.ice.tilt_lines = TiltLines{{1, 0}, {0, 1000}, {1000, 3000}, {{0, 20}, {0, 20}}};
  ModelParts more = base;
  for (auto& row : more.ice.tilt_lines->shifts) row[1] += 1000 * rise;
  PathScores path = some_path();
  for (PathScores::Layer& layer : path.layers) layer.tilted_absorption = 300 * layer.absorption;
  // Rows are listed from the top, 10 m apart.
  const double gradient = -1e-5 * std::pow(wavelength / 400, -1.1);
  double expected = 0;
  for (int i = path.lowest; i <= path.highest; ++i)
    expected += -gradient * 300 * path.layers[static_cast<std::size_t>(i)].absorption;
  ScoreMap map(freeze(base), wavelength, 2);
  EXPECT_TRUE(map.add(0, freeze(more), rise));
  Eigen::VectorXd scores, dwell;
  map.scores(path, scores, dwell);
  EXPECT_NEAR(scores(0) / expected, 1, 1e-3);
  EXPECT_FALSE(map.is_symmetric(0));
  EXPECT_TRUE(map.is_symmetric(1));
}

TEST(ScoreMap, SumsOverTheLayersOfThePath) {
  const ModelParts base = coloured_parts();
  PathScores path = some_path();
  // What lies outside of the path's layers is left from other paths.
  path.layers[79].absorption = path.layers[141].absorption = 1e9;
  double expected = 0;
  for (int i = path.lowest; i <= path.highest; ++i)
    expected += path.layers[static_cast<std::size_t>(i)].absorption;
  expected *= 0.01 * std::pow(wavelength / 400, -1.1);
  const double score = score_of(base, path, [](ModelParts& parts) {
    for (IceLayerRow& row : parts.ice.layers) row.dust_absorption *= std::exp(step);
  });
  EXPECT_NEAR(score / expected, 1, 2 * step);
}

TEST(ScoreMap, KeepsParametersApart) {
  const ModelParts base = coloured_parts();
  ScoreMap map(freeze(base), wavelength, 3);
  ModelParts dust = base, scattering = base;
  dust.ice.layers[row_of_change].dust_absorption *= std::exp(step);
  scattering.ice.layers[row_of_change].effective_scattering *= std::exp(step);
  EXPECT_TRUE(map.add(2, freeze(dust), step));
  EXPECT_TRUE(map.add(0, freeze(scattering), step));
  EXPECT_TRUE(map.add(1, freeze(base), step));
  Eigen::VectorXd scores, dwell;
  const PathScores path = some_path();
  map.scores(path, scores, dwell);
  ASSERT_EQ(scores.size(), 3);
  const auto alone = [&](auto&& change) { return score_of(base, path, change); };
  EXPECT_DOUBLE_EQ(scores(2), alone([&](ModelParts& parts) { parts = dust; }));
  EXPECT_DOUBLE_EQ(scores(0), alone([&](ModelParts& parts) { parts = scattering; }));
  EXPECT_EQ(scores(1), 0);
}

// Light dwells in the layers that a parameter changes, and with the anisotropy in all of them.
TEST(ScoreMap, TellsHowLongLightDwellsWhereAParameterActs) {
  const ModelParts base = coloured_parts();
  ScoreMap map(freeze(base), wavelength, 3);
  ModelParts both = base, anisotropy = base;
  both.ice.layers[row_of_change].dust_absorption *= std::exp(step);
  both.ice.layers[row_of_change + 1].effective_scattering *= std::exp(step);
  anisotropy.ice.configuration.absorption_anisotropy->k1 += step;
  EXPECT_TRUE(map.add(0, freeze(both), step));
  EXPECT_TRUE(map.add(1, freeze(anisotropy), step));
  const PathScores path = some_path();
  Eigen::VectorXd scores, dwell;
  map.scores(path, scores, dwell);
  double length = 0;
  for (int i = path.lowest; i <= path.highest; ++i) length += path.layers[static_cast<std::size_t>(i)].length;
  EXPECT_DOUBLE_EQ(dwell(0), path.layers[layer_of_change].length + path.layers[layer_of_change - 1].length);
  EXPECT_DOUBLE_EQ(dwell(1), length);
  EXPECT_EQ(dwell(2), 0);
}

TEST(ScoreMap, RefusesIceThatPathsSayNothingOf) {
  const ModelParts base = coloured_parts();
  const auto refuses = [&](void (*change)(ModelParts&)) { return !weightable(base, change); };
  EXPECT_TRUE(refuses([](ModelParts& parts) { parts.ice.configuration.mean_cosine += step; }));
  EXPECT_TRUE(refuses([](ModelParts& parts) { parts.ice.configuration.simplified_liu_fraction += step; }));
  EXPECT_TRUE(refuses([](ModelParts& parts) { parts.ice.configuration.k1 += step; }));
  EXPECT_TRUE(refuses([](ModelParts& parts) { parts.ice.layers[row_of_change].k2 = step; }));
  EXPECT_TRUE(refuses([](ModelParts& parts) { parts.ice.configuration.flow_azimuth_deg += step; }));
  EXPECT_TRUE(refuses([](ModelParts& parts) { parts.ice.configuration.hole_ice.radius = step; }));
  EXPECT_TRUE(refuses([](ModelParts& parts) { parts.ice.configuration.module_efficiency += step; }));
  EXPECT_TRUE(refuses([](ModelParts& parts) { parts.ice.configuration.birefringence->sigma_x.A += step; }));
  EXPECT_TRUE(refuses([](ModelParts& parts) { parts.ice.layers.pop_back(); }));
  EXPECT_TRUE(refuses([](ModelParts& parts) {
    for (IceLayerRow& row : parts.ice.layers) row.depth += step;
  }));
  // Layers that rise on one side of a string only.
  EXPECT_TRUE(refuses([](ModelParts& parts) {
    parts.ice.tilt_lines = TiltLines{{1, 2, 3}, {0, 100, 200}, {1000, 2000}, {{0, 0, 5}, {0, 0, 5}}};
  }));
  // Together with something that can be weighted, too.
  EXPECT_TRUE(refuses([](ModelParts& parts) {
    parts.ice.layers[row_of_change].dust_absorption *= 1 + step;
    parts.ice.configuration.mean_cosine += step;
  }));
}

TEST(ScoreMap, RefusesCrystalsWhereThereAreNone) {
  ModelParts none = coloured_parts();
  none.ice.configuration.birefringence.reset();
  EXPECT_FALSE(
      weightable(none, [](ModelParts& parts) { parts.ice.configuration.birefringence = crystals(); }));
  // A layer of strength 0: its steps have no width, so that no path says how more of it would spread.
  ModelParts one_without = coloured_parts();
  one_without.ice.layers[row_of_change].birefringence_strength = 0;
  EXPECT_FALSE(weightable(
      one_without, [](ModelParts& parts) { parts.ice.layers[row_of_change].birefringence_strength = step; }));
  EXPECT_TRUE(weightable(one_without, [](ModelParts& parts) {
    for (IceLayerRow& row : parts.ice.layers) row.birefringence_strength *= 1 + step;
  }));
}

// Without the widths of diffusion a deflection is certain, and cannot be weighted.
TEST(ScoreMap, RefusesDeflectionWithoutDiffusion) {
  ModelParts base = coloured_parts();
  base.ice.configuration.birefringence->diffusion = false;
  EXPECT_FALSE(weightable(base, [](ModelParts& parts) {
    for (IceLayerRow& row : parts.ice.layers) row.birefringence_strength *= 1 + step;
  }));
  EXPECT_FALSE(weightable(base, [](ModelParts& parts) {
    for (IceLayerRow& row : parts.ice.layers) row.deflection_strength *= 1 + step;
  }));
}

// Paths are those of the ice; how modules accept and flashers emit is not in their scores.
TEST(ScoreMap, RefusesAnotherDetector) {
  const ModelParts base = coloured_parts();
  EXPECT_FALSE(weightable(base, [](ModelParts& parts) {
    std::vector<Module> modules = parts.detector.modules();
    modules[1].relative_efficiency += step;
    parts.detector = Detector("two", modules);
  }));
  EXPECT_FALSE(weightable(base, [](ModelParts& parts) {
    std::vector<Module> modules = parts.detector.modules();
    modules[1].position.x() += 1;
    parts.detector = Detector("two", modules);
  }));
}

TEST(ScoreMap, RefusesAnotherAcceptance) {
  const ModelParts base = coloured_parts();
  EXPECT_FALSE(weightable(base, [](ModelParts& parts) { parts.acceptance.overall_efficiency += step; }));
  EXPECT_FALSE(weightable(base, [](ModelParts& parts) {
    parts.acceptance.angular = AngularAcceptance::polynomial(1, {0.6, 0.3});
  }));
  EXPECT_FALSE(weightable(
      base, [](ModelParts& parts) { parts.acceptance.angular = AngularAcceptance::surface(0.5); }));
  EXPECT_FALSE(weightable(base, [](ModelParts& parts) {
    parts.acceptance.spectrum = WavelengthSpectrum({{0, 300}, {1, 601}});
  }));
  EXPECT_FALSE(weightable(base, [](ModelParts& parts) {
    parts.acceptance.high_qe = HighQeRatio({{300, 1.3}, {600, 1.4}});
  }));
  EXPECT_FALSE(weightable(base, [](ModelParts& parts) { parts.acceptance.cable_radius += step; }));
}

TEST(ScoreMap, RefusesAnotherNoise) {
  EXPECT_FALSE(weightable(coloured_parts(), [](ModelParts& parts) { parts.noise_rate += step; }));
}

TEST(ScoreMap, RefusesOtherSources) {
  const ModelParts base = coloured_parts();
  EXPECT_FALSE(weightable(base, [](ModelParts& parts) { parts.sources.width_factor += step; }));
  EXPECT_FALSE(weightable(base, [](ModelParts& parts) { parts.sources.brightness_factor += step; }));
  EXPECT_FALSE(weightable(base, [](ModelParts& parts) { parts.sources.time_offset += step; }));
}

}  // namespace
}  // namespace floe
