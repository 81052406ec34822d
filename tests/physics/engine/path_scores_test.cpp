// What a path says about the ice: scores of detected photons against simulations of other ice.
#include "propagation/engine/path_scores.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "data/base/constants.h"
#include "propagation/ice/ice_model.h"
#include "propagation/ice/tilt.h"
#include "propagation/sources/flasher.h"
#include "reco/ice_fit/score_map.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

using test::line_at_400;
using test::make_model;
using test::uniform_tables;

struct Traced {
  SimulatedHit hit;
  PathScores path;
};
std::vector<Traced> trace(const Model& model, const Source& source, double oversize,
                          const std::vector<std::uint64_t>& photons, std::uint64_t seed,
                          std::uint64_t stream = 0) {
  std::vector<Traced> traced;
  make_path_tracer(model, oversize)
      ->trace(source, seed, stream, photons, [&](const SimulatedHit& hit, const PathScores& path) {
        traced.push_back({hit, path});
      });
  return traced;
}

std::vector<std::uint64_t> first_photons(std::uint64_t count) {
  std::vector<std::uint64_t> photons(count);
  for (std::uint64_t i = 0; i < count; ++i) photons[i] = i;
  return photons;
}

std::vector<SimulatedHit> simulate(const Model& model, const Source& source, double oversize,
                                   std::uint64_t seed, std::uint64_t stream = 0) {
  SimulationOptions options;
  options.seed = seed;
  options.stream = stream;
  options.fixed_number = true;
  std::vector<SimulatedHit> hits;
  Simulator(model, oversize).run(source, options, [&](std::span<const SimulatedHit> portion) {
    hits.insert(hits.end(), portion.begin(), portion.end());
  });
  return hits;
}

// The photons of these hits, each once.
std::vector<std::uint64_t> photons_of(const std::vector<SimulatedHit>& hits) {
  std::vector<std::uint64_t> photons;
  for (const SimulatedHit& hit : hits)
    if (photons.empty() || photons.back() != hit.photon) photons.push_back(hit.photon);
  return photons;
}

// ---- Without scattering a score is the path.

// A beam through layers, along an axis of anisotropic absorption: minus the path in each layer, times the
// direction's factor.
TEST(DirectHit, AbsorptionScoreIsMinusThePath) {
  IceTables tables = uniform_tables({1e9, 100});
  tables.configuration.absorption_anisotropy = IceConfiguration::AbsorptionAnisotropy{0.4, -0.2, -0.2};
  tables.configuration.flow_azimuth_deg = 30;
  // From the middle of the layer centred at 2000 m depth up to 1950 m.
  const Vec3 foot(3, 4, origin_depth - 2000);
  for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(0.48, 0.64, 0.6)}) {
    const Model model = make_model(tables, {foot + 50 / direction.z() * direction});
    const PointSource source(foot, 0, 50, line_at_400(), direction);
    const auto traced = trace(model, source, 1, first_photons(50), 1);
    const Vec3 flow = unit_vector(pi / 2, 30 * degree);
    const Vec3 n(direction.dot(flow), direction.dot(Vec3::UnitZ().cross(flow)), direction.z());
    const auto& K = model.ice->absorption_anisotropy();
    const double factor = 1 / std::hypot(K[0] * n.x(), K[1] * n.y(), K[2] * n.z());
    ASSERT_GT(traced.size(), 10U);
    for (const Traced& hit : traced) {
      const int first = model.ice->layer_at(foot.z()), last = first + 5;
      EXPECT_EQ(hit.path.lowest, first);
      EXPECT_EQ(hit.path.highest, last);
      double sum = 0;
      for (int i = 0; i < static_cast<int>(hit.path.layers.size()); ++i) {
        const PathScores::Layer& layer = hit.path.layers[static_cast<std::size_t>(i)];
        const double length = i == first              ? 5 / direction.z()
                              : i == last             ? 5 / direction.z() - module_radius
                              : i > first && i < last ? 10 / direction.z()
                                                      : 0;
        EXPECT_NEAR(layer.absorption, -factor * length, 1e-4) << i;
        EXPECT_NEAR(layer.scattering, -length, 1e-4) << i;
        EXPECT_EQ(layer.diffusion, 0);
        EXPECT_EQ(layer.deflection, 0);
        sum += length;
      }
      // d/dK of the factor: -factor^3 K n^2, at 1/100 m.
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(hit.path.absorption_anisotropy[i],
                    0.01 * sum * std::pow(factor, 3) * K[i] * n(static_cast<Eigen::Index>(i)) *
                        n(static_cast<Eigen::Index>(i)),
                    1e-5);
    }
  }
}

// The column of hole ice around the module is no part of the layers.
TEST(DirectHit, HoleIceIsNotScored) {
  IceTables tables = uniform_tables({1e9, 100});
  tables.configuration.hole_ice = {4, 1e6, 100, 0.35, 0.9};
  const Model model = make_model(tables, {Vec3(30, 0, 0)});
  const PointSource source(Vec3::Zero(), 0, 50, line_at_400(), Vec3::UnitX());
  const auto traced = trace(model, source, 1, first_photons(50), 1);
  ASSERT_GT(traced.size(), 10U);
  const auto layer = static_cast<std::size_t>(model.ice->layer_at(0));
  for (const Traced& hit : traced) {
    EXPECT_NEAR(hit.path.layers[layer].absorption, -(30 - 4 * module_radius), 1e-3);
    EXPECT_NEAR(hit.path.layers[layer].scattering, -(30 - 4 * module_radius), 1e-3);
  }
}

// ---- Scores against simulations.

// Which hits are looked at: not all have the same slopes.
struct Selection {
  const char* name;
  bool (*takes)(const SimulatedHit& hit, const Vec3& module);
};

struct Scene {
  IceTables tables;
  std::vector<Vec3> modules;
  double oversize;
  std::optional<Vec3> beam;  // of the light at the origin; none: into all directions
  std::vector<Selection> selections;

  PointSource light(double photons) const {
    return PointSource(Vec3::Zero(), 0, photons, line_at_400(), beam);
  }
};

const Vec3 flow = unit_vector(pi / 2, 40 * degree);

BirefringenceNumbers crystals() {
  BirefringenceNumbers numbers;
  numbers.sigma_x = {0.06, 0, 1, 1};
  numbers.sigma_y = {0.05, 0, 1, 1};
  numbers.mean_x = {0.012, 0, 0, 1};
  numbers.displacement = false;  // of which scores know nothing
  return numbers;
}

// Modules in two shells about a light, in ice in which all that has a score acts: scattering over 4 m,
// absorption, crystals with a third of the effective scattering, and absorption that depends on the
// direction.
Scene shells() {
  Scene scene{uniform_tables({10, 20, 0.35, 0.6}), {}, 14, {}, {}};
  scene.tables.configuration.birefringence = crystals();
  scene.tables.configuration.flow_azimuth_deg = 40;
  scene.tables.configuration.absorption_anisotropy =
      IceConfiguration::AbsorptionAnisotropy{0.3, -0.15, -0.15};
  for (IceLayerRow& row : scene.tables.layers) row.birefringence_strength = 8;
  for (const double radius : {11.0, 19.0})
    for (const double zenith : {35.0, 90.0, 145.0})
      for (int i = 0; i < 6; ++i)
        scene.modules.push_back(
            radius * unit_vector(zenith * degree, (40 + 60 * i + (radius > 15 ? 15 : 0)) * degree));
  scene.selections = {{"all", [](const SimulatedHit&, const Vec3&) { return true; }},
                      {"late", [](const SimulatedHit& hit, const Vec3&) { return hit.time > 130; }},
                      {"along the flow", [](const SimulatedHit&, const Vec3& module) {
                         return std::abs(module.normalized().dot(flow)) > 0.8;
                       }}};
  return scene;
}

// A beam at 45 degrees to the flow, widened by crystals alone: dust scatters it every 7 m by next to nothing.
// Modules stand in its way 25 m off, to the left and to the right.
const Vec3 beam = unit_vector(pi / 2, 85 * degree), left = Vec3::UnitZ().cross(beam);
Scene widened_beam() {
  Scene scene{uniform_tables({1 / 1.5e-4, 100, 0, 0.999}), {}, 10, beam, {}};
  scene.tables.version = 10;  // nothing is taken out of the scattering
  scene.tables.configuration.birefringence = crystals();
  scene.tables.configuration.flow_azimuth_deg = 40;
  for (const double side : {0.0, 4.0, -4.0, 8.0, -8.0})
    for (const double up : {0.0, 4.0, -4.0})
      scene.modules.emplace_back(25 * beam + side * left + Vec3(0, 0, up));
  scene.selections = {
      {"ahead", [](const SimulatedHit&, const Vec3& module) { return module.cross(beam).norm() < 1; }},
      {"left", [](const SimulatedHit&, const Vec3& module) { return module.dot(left) > 1; }},
      {"right", [](const SimulatedHit&, const Vec3& module) { return module.dot(left) < -1; }}};
  return scene;
}

// The shells in ice whose dust grows by a factor of e over 30 m of depth, in layers of 1 m. Modules are told
// apart by which side of the light they lie on, along the direction in which layers will rise, and by height.
Scene dustier_below() {
  Scene scene = shells();
  scene.tables.configuration.birefringence.reset();
  scene.tables.layers.clear();
  for (int depth = 1850; depth <= 2050; ++depth) {
    IceLayerRow row;
    row.depth = depth;
    const double dust = std::exp((depth - origin_depth) / 30);
    row.effective_scattering = dust / 10;
    row.dust_absorption = dust / 20;
    scene.tables.layers.push_back(row);
  }
  scene.selections = {{"along",
                       [](const SimulatedHit&, const Vec3& module) {
                         return distance_along_tilt(module) > 5 && std::abs(module.z()) < 1;
                       }},
                      {"against",
                       [](const SimulatedHit&, const Vec3& module) {
                         return distance_along_tilt(module) < -5 && std::abs(module.z()) < 1;
                       }},
                      {"above", [](const SimulatedHit&, const Vec3& module) { return module.z() > 5; }},
                      {"all", [](const SimulatedHit&, const Vec3&) { return true; }}};
  return scene;
}

// A number of the ice, of which `apply` adds `number` (to a logarithm, mostly).
struct Number {
  const char* name;
  double step;     // to each side
  double photons;  // of the light whose hits are scored
  double light;    // whose hits are counted
  Scene (*scene)();
  void (*apply)(double number, IceTables& tables);
};
void PrintTo(const Number& number, std::ostream* out) {
  *out << number.name;
}

// The layers that begin 3 m above the light.
bool above(const IceLayerRow& row) {
  return row.depth < 1945;
}

const Number numbers[] = {
    {"absorption", 0.2, 1e8, 4e8, shells,
     [](double number, IceTables& tables) {
       for (IceLayerRow& row : tables.layers) row.dust_absorption *= std::exp(number);
     }},
    {"absorption_above", 0.3, 1e8, 4e8, shells,
     [](double number, IceTables& tables) {
       for (IceLayerRow& row : tables.layers)
         if (above(row)) row.dust_absorption *= std::exp(number);
     }},
    {"scattering", 0.2, 3e8, 4e8, shells,
     [](double number, IceTables& tables) {
       for (IceLayerRow& row : tables.layers) row.effective_scattering *= std::exp(number);
     }},
    {"scattering_above", 0.3, 3e8, 4e8, shells,
     [](double number, IceTables& tables) {
       for (IceLayerRow& row : tables.layers)
         if (above(row)) row.effective_scattering *= std::exp(number);
     }},
    {"birefringence", 0.3, 2e8, 4e8, shells,
     [](double number, IceTables& tables) {
       for (IceLayerRow& row : tables.layers) row.birefringence_strength *= std::exp(number);
     }},
    {"birefringence_alone", 0.3, 2e8, 4e8, shells,  // without what is taken out of the scattering for it
     [](double number, IceTables& tables) {
       const double share = mean_birefringent_scattering(*tables.configuration.birefringence);
       for (IceLayerRow& row : tables.layers) {
         row.effective_scattering += share * row.birefringence_strength * (std::exp(number) - 1);
         row.birefringence_strength *= std::exp(number);
       }
     }},
    {"deflection", 0.3, 1e8, 4e8, shells,
     [](double number, IceTables& tables) {
       for (IceLayerRow& row : tables.layers) row.deflection_strength *= std::exp(number);
     }},
    {"absorption_anisotropy", 0.2, 1e8, 4e8, shells,
     [](double number, IceTables& tables) {
       const double k1 = tables.configuration.absorption_anisotropy->k1 + number;
       tables.configuration.absorption_anisotropy =
           IceConfiguration::AbsorptionAnisotropy{k1, -k1 / 2, -k1 / 2};
     }},
    {"rise_of_layers", 0.2, 1e8, 8e8, dustier_below,
     [](double number, IceTables& tables) {
       tables.tilt_lines = TiltLines{{1, 2}, {0, 100}, {1800, 2100}, {{0, 100 * number}, {0, 100 * number}}};
     }},
    {"birefringence_of_a_beam", 0.3, 7e7, 1.2e8, widened_beam,
     [](double number, IceTables& tables) {
       for (IceLayerRow& row : tables.layers) row.birefringence_strength *= std::exp(number);
     }},
    {"deflection_of_a_beam", 0.3, 2e7, 1.2e8, widened_beam,
     [](double number, IceTables& tables) {
       for (IceLayerRow& row : tables.layers) row.deflection_strength *= std::exp(number);
     }},
};

Model changed_model(const Scene& scene, const Number& number, double value) {
  IceTables tables = scene.tables;
  number.apply(value, tables);
  return make_model(std::move(tables), scene.modules);
}

struct Estimate {
  double value = 0, variance = 0;
};
using Estimates = std::vector<Estimate>;  // by selection

// Calls add(s) for each selection that takes the hit.
template <class Add>
void select(const Scene& scene, const SimulatedHit& hit, Add&& add) {
  for (std::size_t s = 0; s < scene.selections.size(); ++s)
    if (scene.selections[s].takes(hit, scene.modules[hit.module])) add(s);
}

// How many hits each photon makes in two kinds of ice, all with the same random numbers: paths that are alike
// for a while leave less noise in the difference. A photon's hits are not independent, photons are.
Estimates slopes_of_light(const Scene& scene, const Number& number, double photons) {
  struct Pair {
    double low = 0, high = 0;
  };
  const std::size_t ways = scene.selections.size();
  std::vector<std::unordered_map<std::uint64_t, Pair>> by_photon(ways);
  std::vector<Pair> sums(ways);
  for (const bool upper : {false, true}) {
    const Model model = changed_model(scene, number, upper ? number.step : -number.step);
    for (const SimulatedHit& hit : simulate(model, scene.light(photons), scene.oversize, 11))
      select(scene, hit, [&](std::size_t s) {
        for (Pair* pair : {&by_photon[s][hit.photon], &sums[s]}) (upper ? pair->high : pair->low) += 1;
      });
  }
  Estimates result(ways);
  for (std::size_t s = 0; s < ways; ++s) {
    result[s].value = std::log(sums[s].high / sums[s].low) / (2 * number.step);
    for (const auto& [photon, pair] : by_photon[s])
      result[s].variance +=
          std::pow((pair.high / sums[s].high - pair.low / sums[s].low) / (2 * number.step), 2);
  }
  return result;
}

// The mean score of a hit, as a fit finds it out.
Estimates mean_scores(const Scene& scene, const Number& number, double value, std::uint64_t seed) {
  const Model model = changed_model(scene, number, value);
  const PointSource source = scene.light(number.photons);
  ScoreMap map(model, 400, 1);
  constexpr double step = 1e-4;
  EXPECT_TRUE(map.add(0, changed_model(scene, number, value + step), step));
  struct Sums {
    double hits = 0, score = 0;
  };
  const std::size_t ways = scene.selections.size();
  std::vector<std::unordered_map<std::uint64_t, Sums>> by_photon(ways);
  std::vector<Sums> all(ways);
  Eigen::VectorXd score, dwell;
  make_path_tracer(model, scene.oversize)
      ->trace(source, seed, 0, photons_of(simulate(model, source, scene.oversize, seed)),
              [&](const SimulatedHit& hit, const PathScores& path) {
                map.scores(path, score, dwell);
                select(scene, hit, [&](std::size_t s) {
                  for (Sums* sums : {&by_photon[s][hit.photon], &all[s]})
                    sums->hits += 1, sums->score += score(0);
                });
              });
  Estimates result(ways);
  for (std::size_t s = 0; s < ways; ++s) {
    result[s].value = all[s].score / all[s].hits;
    for (const auto& [photon, sums] : by_photon[s])
      result[s].variance += std::pow((sums.score - result[s].value * sums.hits) / all[s].hits, 2);
  }
  return result;
}

class Scores : public ::testing::TestWithParam<Number> {};

// The light at both ends of a range against the slope in between, by Simpson's rule: unlike a difference
// against the slope in the middle alone this needs no small step, in which the difference would drown. Seen,
// at four errors, would be scores wrong by 1% for absorption (3% of the layers above alone), 8% for
// scattering (11% above), 5% for birefringence (in the beam ahead), 3% for deflection (in the beam), 5%
// for the anisotropy; and parts that are forgotten: what birefringence takes out of scattering is worth 0.3
// in late light, a dozen errors.
TEST_P(Scores, AreTheSlopesOfTheLight) {
  const Number& number = GetParam();
  const Scene scene = number.scene();
  const Estimates difference = slopes_of_light(scene, number, number.light);
  const Estimates low = mean_scores(scene, number, -number.step, 1);
  const Estimates middle = mean_scores(scene, number, 0, 2);
  const Estimates high = mean_scores(scene, number, number.step, 3);
  for (std::size_t s = 0; s < difference.size(); ++s) {
    const Estimate score{(low[s].value + 4 * middle[s].value + high[s].value) / 6,
                         (low[s].variance + 16 * middle[s].variance + high[s].variance) / 36};
    const double error = std::sqrt(difference[s].variance + score.variance);
    EXPECT_NEAR(score.value, difference[s].value, 4 * error) << scene.selections[s].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Numbers, Scores, ::testing::ValuesIn(numbers),
                         [](const auto& number) { return std::string(number.param.name); });

// ---- The photons of a simulation are walked again.

// Share of the simulated hits that tracing finds again, at the same module within a nanosecond, and of how
// many it finds in all.
struct Found {
  double again, all;
};
Found find_again(const Model& model, const Source& source, double wide, std::uint64_t stream) {
  const auto hits = simulate(model, source, wide, 5, stream);
  EXPECT_GT(hits.size(), 10000U);
  const auto traced = trace(model, source, wide, photons_of(hits), 5, stream);
  std::multimap<std::pair<std::uint64_t, std::uint32_t>, double> times;
  for (const Traced& t : traced) times.emplace(std::pair(t.hit.photon, t.hit.module), t.hit.time);
  double again = 0;
  for (const SimulatedHit& hit : hits) {
    const auto [first, end] = times.equal_range({hit.photon, hit.module});
    again += std::any_of(first, end, [&](const auto& time) { return std::abs(time.second - hit.time) < 1; });
  }
  const auto all = static_cast<double>(hits.size());
  return {again / all, static_cast<double>(traced.size()) / all};
}

TEST(Tracing, FindsTheHitsOfARun) {
  const Scene scene = shells();
  const Found found =
      find_again(make_model(scene.tables, scene.modules), scene.light(2e7), scene.oversize, 3);
  EXPECT_GT(found.again, 0.98);
  EXPECT_NEAR(found.all, 1, 0.02);
}

// Real ice has tilted layers, and modules a hundred scatters away.
TEST(Tracing, FindsTheHitsOfAFlasherRun) {
  Model model;
  model.detector = std::make_shared<Detector>(ic86_detector());
  model.ice = std::make_shared<IceModel>(south_pole_ice(), *model.detector);
  model.acceptance = builtin_acceptance();
  FlasherSettings settings;
  settings.photons = 1e9;
  const FlasherSource source(*model.detector, {36, 30}, settings, line_at_400());
  const Found found = find_again(model, source, 16, 7);
  EXPECT_GT(found.again, 0.98);
  EXPECT_NEAR(found.all, 1, 0.02);
}

// A photon's hits come in the order of its path, whose scores grow by what lies between them.
TEST(Tracing, TellsHitsInTheOrderOfThePath) {
  const Scene scene = shells();
  const Model model = make_model(scene.tables, scene.modules);
  const auto traced = trace(model, scene.light(1e7), scene.oversize, first_photons(20000), 5);
  int pairs = 0;
  for (std::size_t i = 1; i < traced.size(); ++i) {
    ASSERT_GE(traced[i].hit.photon, traced[i - 1].hit.photon);
    if (traced[i].hit.photon != traced[i - 1].hit.photon) continue;
    ++pairs;
    EXPECT_GE(traced[i].hit.time, traced[i - 1].hit.time);
    for (std::size_t k = 0; k < traced[i].path.layers.size(); ++k)
      EXPECT_LE(traced[i].path.layers[k].absorption, traced[i - 1].path.layers[k].absorption);
  }
  EXPECT_GT(pairs, 100);
}

}  // namespace
}  // namespace floe
