// Scenes with closed-form answers: uniform ice, a few modules that accept every photon.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "propagation/engine/simulator.h"
#include "propagation/model.h"

namespace floe::test {

struct UniformIce {
  double effective_scattering_length = 1e6, absorption_length = 1e6;  // [m]
  double liu_fraction = 0.35, mean_cosine = 0.9;
};

// Layers of 10 m from 1000 to 3000 m depth that are all alike; at 400 nm the lengths are as named.
inline IceTables uniform_tables(const UniformIce& ice) {
  IceTables tables;
  tables.name = "uniform";
  tables.wavelength = {0, 0, 1e-30, 0, {}, {}, {}};
  for (int i = 0; i <= 200; ++i) {
    IceLayerRow row;
    row.depth = 1000 + 10 * i;
    row.effective_scattering = 1 / ice.effective_scattering_length;
    row.dust_absorption = 1 / ice.absorption_length;
    tables.layers.push_back(row);
  }
  tables.configuration.simplified_liu_fraction = ice.liu_fraction;
  tables.configuration.mean_cosine = ice.mean_cosine;
  return tables;
}

// Nominal modules, each on a string of its own.
inline std::vector<Module> modules_at(const std::vector<Vec3>& positions) {
  std::vector<Module> modules(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    modules[i].id = {static_cast<int>(i) + 1, 1};
    modules[i].position = positions[i];
  }
  return modules;
}

// The default acceptance keeps every photon.
inline Model make_model(IceTables tables, std::vector<Module> modules, ModuleAcceptance acceptance = {}) {
  Model model;
  model.detector = std::make_shared<Detector>("test", std::move(modules));
  model.ice = std::make_shared<IceModel>(std::move(tables), *model.detector);
  model.acceptance = std::move(acceptance);
  return model;
}
inline Model make_model(IceTables tables, const std::vector<Vec3>& positions) {
  return make_model(std::move(tables), modules_at(positions));
}

inline WavelengthSpectrum line_at(double wavelength) {
  return WavelengthSpectrum({{0, wavelength - 0.001}, {1, wavelength + 0.001}});
}
inline WavelengthSpectrum line_at_400() {
  return line_at(400);
}

// Scenes that both engines go through.
class BothEngines : public ::testing::TestWithParam<EngineKind> {
 protected:
  struct Run {
    std::vector<SimulatedHit> hits;
    SimulationSummary summary;
  };

  // The plain engine gets less light: it is slower.
  double light(double photons) const { return GetParam() == EngineKind::plain ? photons / 10 : photons; }

  // Propagates the expected number of photons, not a draw around it.
  Run run(const Model& model, const Source& source, double oversize, std::uint64_t seed = 1) const {
    const Simulator simulator(model, oversize, GetParam());
    SimulationOptions options;
    options.seed = seed;
    options.fixed_number = true;
    Run result;
    result.summary = simulator.run(source, options, [&](std::span<const SimulatedHit> portion) {
      result.hits.insert(result.hits.end(), portion.begin(), portion.end());
    });
    return result;
  }
  std::vector<SimulatedHit> simulate(const Model& model, const Source& source, double oversize,
                                     std::uint64_t seed = 1) const {
    return run(model, source, oversize, seed).hits;
  }
};

#define FLOE_INSTANTIATE_ENGINES(suite)                                         \
  INSTANTIATE_TEST_SUITE_P(                                                     \
      Engines, suite, ::testing::Values(EngineKind::vector, EngineKind::plain), \
      [](const auto& engine) { return engine.param == EngineKind::vector ? "vector" : "plain"; })

}  // namespace floe::test
