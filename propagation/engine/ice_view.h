// The ice model as the vector engine reads it: single precision, one array a quantity.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "propagation/engine/scattering.h"
#include "propagation/engine/table_rows.h"
#include "propagation/ice/ice_model.h"

namespace floe {

// Read-only after construction.
struct IceView {
  explicit IceView(const IceModel& ice);

  // Layers from the bottom up, a row each; coefficients as in IceLayer, scattering geometric (divided by
  // 1 - g), k1 and k2 natural logs.
  enum LayerColumn {
    scattering_constant,
    scattering_power,
    absorption_dust,
    absorption_thermal,
    diffusion,
    deflection,
    k1,
    k2
  };
  int last_layer;
  float z_bottom, step, layers_per_metre;
  std::vector<TableRow> layers;
  bool anisotropic_scattering;   // any k not 0
  float old_absorption_scaling;  // 0: off

  float flow_x, flow_y;
  float absorption_K1, absorption_K2, absorption_Kz;
  ScatteringFunction<float> scattering;

  // Birefringence, per metre at strength 1, linear in |cos eta| over `birefringence_intervals`, a row each:
  // value at an interval's start and change to its end. The drift is tabulated without its factor
  // sin eta cos eta, which is steep at both ends.
  static constexpr int birefringence_intervals = 512;
  enum BirefringenceColumn { sigma_x, sigma_x_change, sigma_y, sigma_y_change, drift, drift_change };
  bool birefringent, displacement;
  std::vector<TableRow> birefringence;

 private:
  void tabulate_birefringence(const BirefringenceNumbers& numbers);
};

}  // namespace floe
