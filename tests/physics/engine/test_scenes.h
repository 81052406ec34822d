// Scenes with closed-form answers: uniform ice, a few modules that accept every photon.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

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

inline Model make_model(IceTables tables, const std::vector<Vec3>& positions) {
  std::vector<Module> modules;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    Module module;
    module.id = {static_cast<int>(i) + 1, 1};
    module.position = positions[i];
    modules.push_back(module);
  }
  Model model;
  model.detector = std::make_shared<Detector>("test", modules);
  model.ice = std::make_shared<IceModel>(std::move(tables), *model.detector);
  return model;  // the default acceptance keeps every photon
}

inline WavelengthSpectrum line_at_400() {
  return WavelengthSpectrum({{0, 399.999}, {1, 400.001}});
}

}  // namespace floe::test
