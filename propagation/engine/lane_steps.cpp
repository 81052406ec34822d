// Compiled with fast-math: nothing here may depend on NaN, infinity or the order of a sum. Every loop
// over lanes is meant to become vector code; -fopt-info-vec tells whether it did.
#include "propagation/engine/lane_steps.h"

#include <cmath>

#include "propagation/engine/anisotropy.h"
#include "propagation/engine/birefringence.h"
#include "propagation/engine/directions.h"
#include "propagation/engine/vector_math.h"

namespace floe {

namespace {

constexpr int N = Lanes::count;
constexpr float endless = 1e30f;  // longer than any path [m]

inline float draw(Lanes& lanes, int i) {
  return RandomStream::to_uniform(
      RandomStream::next(lanes.random0[i], lanes.random1[i], lanes.random2[i], lanes.random3[i]));
}

// Absorption's dependence on the direction, per lane.
void anisotropic_absorption(const IceView& ice, const Lanes& lanes, float* factor) {
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float n1 = ice.flow_x * lanes.nx[i] + ice.flow_y * lanes.ny[i];
    const float n2 = -ice.flow_y * lanes.nx[i] + ice.flow_x * lanes.ny[i];
    factor[i] = absorption_anisotropy_factor(ice.absorption_K1, ice.absorption_K2, ice.absorption_Kz, n1, n2,
                                             lanes.nz[i]);
  }
  if (ice.old_absorption_scaling == 0) return;
  const float* k1 = ice.k1.data();
  const float* k2 = ice.k2.data();
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float n1 = ice.flow_x * lanes.nx[i] + ice.flow_y * lanes.ny[i];
    const float n2 = -ice.flow_y * lanes.nx[i] + ice.flow_x * lanes.ny[i];
    factor[i] *= old_absorption_factor(k1[lanes.layer[i]], k2[lanes.layer[i]], ice.old_absorption_scaling, n1,
                                       n2, lanes.nz[i]);
  }
}

// A direction's z component, kept away from 0 so that distances to layer boundaries stay finite.
inline float slope_of(float nz) {
  return std::copysign(larger(std::fabs(nz), 1e-9f), nz);
}

}  // namespace

void draw_scattering_depths(Lanes& lanes) {
#pragma omp simd
  for (int i = 0; i < N; ++i) lanes.scattering_depth[i] = -std::log(draw(lanes, i));
}

namespace {

struct LayerTables {
  const float *scattering_constant, *scattering_power, *absorption_dust, *absorption_thermal, *diffusion,
      *deflection;
  int last;
};

// Takes one lane's segment through its layer: as far as the scatter, the absorption or the layer's boundary,
// which is `reach` metres away. A lane that is not going (0) stays as it is; one that goes on into the next
// layer (1) has it in lanes.layer.
inline std::int32_t through_layer(const LayerTables& tables, Lanes& lanes, int i, float factor, float reach,
                                  std::int32_t going) {
  const int layer = lanes.layer[i];
  const float scattering =
      tables.scattering_constant[layer] + tables.scattering_power[layer] * lanes.scattering_power[i];
  const float absorption = factor * (tables.absorption_dust[layer] * lanes.absorption_dust[i] +
                                     tables.absorption_thermal[layer] * lanes.absorption_thermal[i]);
  const float to_scatter = larger(0, lanes.scattering_depth[i]) / scattering;
  const float to_absorb = larger(0, lanes.absorption_depth[i]) / absorption;
  const int next = layer + (lanes.nz[i] > 0 ? 1 : -1);
  const float above_bottom = next < 0 ? endless : reach;
  const float to_boundary = next > tables.last ? endless : above_bottom;
  const float shortest = smaller(smaller(to_scatter, to_absorb), to_boundary);
  const float length = going != 0 ? shortest : 0;
  lanes.length[i] += length;
  lanes.diffusion[i] += length * tables.diffusion[layer];
  lanes.deflection[i] += length * tables.deflection[layer];
  lanes.scattering_depth[i] -= length * scattering;
  lanes.absorption_depth[i] -= length * absorption;
  lanes.absorbed[i] = to_absorb <= to_scatter ? 1 : 0;
  const std::int32_t crosses = to_boundary <= length ? going : 0;
  lanes.layer[i] = crosses != 0 ? next : layer;
  return crosses;
}

}  // namespace

void find_segments(const IceView& ice, Lanes& lanes) {
  const LayerTables tables{ice.scattering_constant.data(),
                           ice.scattering_power.data(),
                           ice.absorption_dust.data(),
                           ice.absorption_thermal.data(),
                           ice.diffusion.data(),
                           ice.deflection.data(),
                           ice.last_layer};
  const float step = ice.step, lowest_of_top = static_cast<float>(ice.last_layer);
  alignas(64) float reach[N], through[N];  // to the boundary of the first layer; through a whole layer [m]
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    lanes.layer[i] = static_cast<std::int32_t>(smaller(larger(lanes.height[i], 0), lowest_of_top));
    const float slope = slope_of(lanes.nz[i]);
    const float boundary = static_cast<float>(lanes.layer[i] + (slope > 0 ? 1 : 0));
    through[i] = step / std::fabs(slope);
    reach[i] = larger(0, (boundary - lanes.height[i]) * step / slope);
    lanes.length[i] = 0;
    lanes.diffusion[i] = 0;
    lanes.deflection[i] = 0;
  }
  alignas(64) float factor[N];
  anisotropic_absorption(ice, lanes, factor);

  // Nearly all segments end in their first or second layer; the others go on one at a time.
  alignas(64) std::int32_t going[N];
#pragma omp simd
  for (int i = 0; i < N; ++i) going[i] = through_layer(tables, lanes, i, factor[i], reach[i], 1);
#pragma omp simd
  for (int i = 0; i < N; ++i) going[i] = through_layer(tables, lanes, i, factor[i], through[i], going[i]);
  for (int i = 0; i < N; ++i)
    while (going[i] != 0) going[i] = through_layer(tables, lanes, i, factor[i], through[i], 1);
}

void find_reach(const ClearanceMap::View& clearance, Lanes& lanes) {
  const ClearanceMap::View view = clearance;
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const ModuleClearance at = view.at(lanes.x[i], lanes.y[i], lanes.z[i]);
    lanes.may_meet[i] = lanes.length[i] >= at.free ? 1 : 0;
    lanes.may_meet_others[i] = lanes.length[i] >= at.free_of_others ? 1 : 0;
    lanes.nearest_module[i] = at.nearest;
  }
}

namespace {

void advance(Lanes& lanes) {
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    lanes.x[i] += lanes.length[i] * lanes.nx[i];
    lanes.y[i] += lanes.length[i] * lanes.ny[i];
    lanes.z[i] += lanes.length[i] * lanes.nz[i];
    lanes.time[i] += lanes.length[i] * lanes.slowness[i];
  }
}

void birefringent_step(const IceView& ice, Lanes& lanes) {
  const float *sigma_x = ice.sigma_x.value.data(), *sigma_x_change = ice.sigma_x.change.data();
  const float *sigma_y = ice.sigma_y.value.data(), *sigma_y_change = ice.sigma_y.change.data();
  const float *drift = ice.drift.value.data(), *drift_change = ice.drift.change.data();
  const float flow_x = ice.flow_x, flow_y = ice.flow_y;
  const float displaced = ice.displacement ? 1.0f : 0.0f;
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float radius_12 = std::sqrt(-2 * std::log(draw(lanes, i)));
    const TurnFunctions<float> turn_12 = turn_functions(draw(lanes, i));
    const float radius_34 = std::sqrt(-2 * std::log(draw(lanes, i)));
    const TurnFunctions<float> turn_34 = turn_functions(draw(lanes, i));

    const float cosine = smaller(1, std::fabs(flow_x * lanes.nx[i] + flow_y * lanes.ny[i]));
    const float steep = cosine * std::sqrt(1 - cosine * cosine);
    const float place = cosine * IceView::birefringence_intervals;
    const int floor = static_cast<int>(place);
    const int index = floor < IceView::birefringence_intervals ? floor : IceView::birefringence_intervals - 1;
    const float w = place - static_cast<float>(index);
    const float width = std::sqrt(larger(0, lanes.diffusion[i]));
    const float across_x = width * (sigma_x[index] + w * sigma_x_change[index]);
    const float across_y = width * (sigma_y[index] + w * sigma_y_change[index]);
    const float mean_x = lanes.deflection[i] * steep * (drift[index] + w * drift_change[index]);

    birefringent_deflection(across_x, across_y, mean_x, flow_x, flow_y, radius_12 * turn_12.cosine,
                            radius_12 * turn_12.sine, radius_34 * turn_34.cosine, radius_34 * turn_34.sine,
                            displaced * lanes.length[i], lanes.nx[i], lanes.ny[i], lanes.nz[i], lanes.x[i],
                            lanes.y[i], lanes.z[i]);
  }
}

// Into the stretched space of anisotropic scattering (sign +1) and back (sign -1).
void stretch(const IceView& ice, Lanes& lanes, float sign) {
  const float* k1 = ice.k1.data();
  const float* k2 = ice.k2.data();
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    float n1 = ice.flow_x * lanes.nx[i] + ice.flow_y * lanes.ny[i];
    float n2 = -ice.flow_y * lanes.nx[i] + ice.flow_x * lanes.ny[i];
    float n3 = lanes.nz[i];
    stretch_direction(std::exp(sign * k1[lanes.layer[i]]), std::exp(sign * k2[lanes.layer[i]]), n1, n2, n3);
    lanes.nx[i] = ice.flow_x * n1 - ice.flow_y * n2;
    lanes.ny[i] = ice.flow_y * n1 + ice.flow_x * n2;
    lanes.nz[i] = n3;
  }
}

void scatter(const IceView& ice, Lanes& lanes) {
  const ScatteringFunction<float> function = ice.scattering;
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float loss = function.one_minus_cos(draw(lanes, i));
    const TurnFunctions<float> turn = turn_functions(draw(lanes, i));
    deflect(loss, turn.cosine, turn.sine, lanes.nx[i], lanes.ny[i], lanes.nz[i]);
  }
}

}  // namespace

void advance_and_scatter(const IceView& ice, Lanes& lanes) {
  advance(lanes);
  if (ice.birefringent) birefringent_step(ice, lanes);
  if (ice.anisotropic_scattering) stretch(ice, lanes, 1);
  scatter(ice, lanes);
  if (ice.anisotropic_scattering) stretch(ice, lanes, -1);
}

}  // namespace floe
