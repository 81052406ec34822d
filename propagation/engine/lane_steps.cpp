// Compiled with fast-math: nothing here may depend on NaN, infinity or the order of a sum. Every loop
// over lanes is meant to become vector code; -fopt-info-vec tells whether it did.
#include "propagation/engine/lane_steps.h"

#ifdef __AVX512F__
#include <immintrin.h>
#endif

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
  return lanes.random.uniform(i);
}

using Columns = float[8][N];

// Absorption's dependence on the direction; `layer` is needed where old_absorption_scaling is not 0.
inline float absorption_factor(const IceView& ice, const float* layer, float nx, float ny, float nz) {
  const float n1 = ice.flow_x * nx + ice.flow_y * ny, n2 = -ice.flow_y * nx + ice.flow_x * ny;
  const float factor =
      absorption_anisotropy_factor(ice.absorption_K1, ice.absorption_K2, ice.absorption_Kz, n1, n2, nz);
  if (ice.old_absorption_scaling == 0) return factor;
  return factor * old_absorption_factor(layer[IceView::k1], layer[IceView::k2], ice.old_absorption_scaling,
                                        n1, n2, nz);
}

// The same for all lanes.
void absorption_factors(const IceView& ice, const Lanes& lanes, const Columns& layer, float* factor) {
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float n1 = ice.flow_x * lanes.nx[i] + ice.flow_y * lanes.ny[i];
    const float n2 = -ice.flow_y * lanes.nx[i] + ice.flow_x * lanes.ny[i];
    factor[i] = absorption_anisotropy_factor(ice.absorption_K1, ice.absorption_K2, ice.absorption_Kz, n1, n2,
                                             lanes.nz[i]);
  }
  if (ice.old_absorption_scaling == 0) return;
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float n1 = ice.flow_x * lanes.nx[i] + ice.flow_y * lanes.ny[i];
    const float n2 = -ice.flow_y * lanes.nx[i] + ice.flow_x * lanes.ny[i];
    factor[i] *= old_absorption_factor(layer[IceView::k1][i], layer[IceView::k2][i],
                                       ice.old_absorption_scaling, n1, n2, lanes.nz[i]);
  }
}

// The lanes whose flags are not 0.
std::uint64_t set_of(const std::int32_t* flags) {
  std::uint64_t set = 0;
#ifdef __AVX512F__
  for (int i = 0; i < N; i += 16) {
    const __m512i some = _mm512_load_si512(flags + i);
    set |= std::uint64_t{_mm512_test_epi32_mask(some, some)} << i;
  }
#else
  for (int i = 0; i < N; ++i) set |= std::uint64_t{flags[i] != 0} << i;
#endif
  return set;
}

// A direction's z component, kept away from 0 so that distances to layer boundaries stay finite.
inline float slope_of(float nz) {
  return std::copysign(larger(std::fabs(nz), 1e-9f), nz);
}

// 1 or 0; of the slope, so that it agrees with the distances that follow from it also for nz = 0.
inline int goes_up(float nz) {
  return slope_of(nz) > 0 ? 1 : 0;
}

// Of a layer at a lane's wavelength and direction [1/m]. Column k of the layer's row is at row[k * stride].
struct Coefficients {
  float scattering, absorption;
};
inline Coefficients coefficients(const float* row, std::ptrdiff_t stride, const Lanes& lanes, int i,
                                 float factor) {
  return {row[IceView::scattering_constant * stride] +
              row[IceView::scattering_power * stride] * lanes.scattering_power[i],
          factor * (row[IceView::absorption_dust * stride] * lanes.absorption_dust[i] +
                    row[IceView::absorption_thermal * stride] * lanes.absorption_thermal[i])};
}

// The part of a lane's segment in one layer: as far as the scatter, the absorption or the layer's boundary,
// which is `reach` metres away.
struct Piece {
  float length, scattering_depth, absorption_depth;
  std::int32_t absorbed, crosses;  // or goes on into the next layer
};
inline Piece piece_of(Coefficients ice, float scattering_depth, float absorption_depth, float reach) {
  const float to_scatter = larger(0, scattering_depth) / ice.scattering;
  const float to_absorb = larger(0, absorption_depth) / ice.absorption;
  const float length = smaller(smaller(to_scatter, to_absorb), reach);
  return {length, length * ice.scattering, length * ice.absorption, to_absorb <= to_scatter ? 1 : 0,
          reach <= length ? 1 : 0};
}

// The distance to the boundary towards layer `next`; endless out of the outermost layers.
inline float limited_reach(float reach, int next, int last) {
  const float above_bottom = next < 0 ? endless : reach;
  return next > last ? endless : above_bottom;
}

// Takes one lane's segment through the layer that it goes on into.
inline std::int32_t through_next_layer(const float* layer_row, std::ptrdiff_t stride, Lanes& lanes, int i,
                                       float factor, float through, int last, std::int32_t going) {
  const Coefficients ice = coefficients(layer_row, stride, lanes, i, factor);
  const int layer = lanes.layer[i], next = layer + 2 * goes_up(lanes.nz[i]) - 1;
  const Piece piece =
      piece_of(ice, lanes.scattering_depth[i], lanes.absorption_depth[i], limited_reach(through, next, last));
  const float share = going != 0 ? 1 : 0;
  lanes.length[i] += share * piece.length;
  lanes.diffusion[i] += share * piece.length * layer_row[IceView::diffusion * stride];
  lanes.deflection[i] += share * piece.length * layer_row[IceView::deflection * stride];
  lanes.scattering_depth[i] -= share * piece.scattering_depth;
  lanes.absorption_depth[i] -= share * piece.absorption_depth;
  lanes.absorbed[i] = going != 0 ? piece.absorbed : lanes.absorbed[i];
  const std::int32_t crosses = going & piece.crosses;
  lanes.layer[i] = crosses != 0 ? next : layer;
  return crosses;
}

}  // namespace

void draw_scattering_depths(Lanes& lanes) {
#pragma omp simd
  for (int i = 0; i < N; ++i) lanes.scattering_depth[i] = -natural_log(draw(lanes, i));
}

void find_segments(const IceView& ice, Lanes& lanes) {
  const TableRow* rows = ice.layers.data();
  const float step = ice.step, top = static_cast<float>(ice.last_layer);
  const int last = ice.last_layer;
#pragma omp simd
  for (int i = 0; i < N; ++i)
    lanes.layer[i] = static_cast<std::int32_t>(smaller(larger(lanes.height[i], 0), top));
  alignas(64) Columns layer;
  fetch_rows(rows, lanes.layer, layer);
  alignas(64) float factor[N], through[N];  // through: a whole layer [m]
  absorption_factors(ice, lanes, layer, factor);

  // The first layer, from wherever in it the segment starts.
  alignas(64) std::int32_t going[N];
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float per_slope = step / slope_of(lanes.nz[i]);
    const int up = goes_up(lanes.nz[i]), next = lanes.layer[i] + 2 * up - 1;
    const float boundary = static_cast<float>(lanes.layer[i] + up);
    const float reach = larger(0, (boundary - lanes.height[i]) * per_slope);
    through[i] = std::fabs(per_slope);
    const Piece piece =
        piece_of(coefficients(&layer[0][i], N, lanes, i, factor[i]), lanes.scattering_depth[i],
                 lanes.absorption_depth[i], limited_reach(reach, next, last));
    lanes.scattering_depth_before[i] = lanes.scattering_depth[i];
    lanes.absorption_depth_before[i] = lanes.absorption_depth[i];
    lanes.length[i] = piece.length;
    lanes.diffusion[i] = piece.length * layer[IceView::diffusion][i];
    lanes.deflection[i] = piece.length * layer[IceView::deflection][i];
    lanes.scattering_depth[i] -= piece.scattering_depth;
    lanes.absorption_depth[i] -= piece.absorption_depth;
    lanes.absorbed[i] = piece.absorbed;
    going[i] = piece.crosses;
    lanes.layer[i] = piece.crosses != 0 ? next : lanes.layer[i];
  }

  // Nearly all segments end in their first or second layer; the others go on one at a time.
  fetch_rows(rows, lanes.layer, layer);
#pragma omp simd
  for (int i = 0; i < N; ++i)
    going[i] = through_next_layer(&layer[0][i], N, lanes, i, factor[i], through[i], last, going[i]);
  for (int i = 0; i < N; ++i)
    while (going[i] != 0)
      going[i] = through_next_layer(rows[lanes.layer[i]].values, 1, lanes, i, factor[i], through[i], last, 1);
}

LaneSets find_reach(const ClearanceMap::View& clearance, Lanes& lanes) {
  const ClearanceMap::View view = clearance;
  alignas(64) std::int32_t may_meet[N];
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const ClearanceMap::View::Distances at = view.distances(lanes.x[i], lanes.y[i], lanes.z[i]);
    const float within = lanes.length[i] + view.reach();
    may_meet[i] = within * within >= at.square ? 1 : 0;
    lanes.may_meet_others[i] = within * within >= at.others_square ? 1 : 0;
    lanes.nearest_module[i] = at.nearest;
  }
  return {set_of(may_meet), set_of(lanes.absorbed)};
}

namespace {

void straight_on(Lanes& lanes) {
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    lanes.x[i] += lanes.length[i] * lanes.nx[i];
    lanes.y[i] += lanes.length[i] * lanes.ny[i];
    lanes.z[i] += lanes.length[i] * lanes.nz[i];
    lanes.time[i] += lanes.length[i] * lanes.slowness[i];
  }
}

// Where the lanes' directions lie in the birefringence tables.
void look_up_birefringence(const IceView& ice, const Lanes& lanes, float* share, Columns& columns) {
  alignas(64) std::int32_t index[N];
  const float flow_x = ice.flow_x, flow_y = ice.flow_y;
  constexpr float intervals = IceView::birefringence_intervals;
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float cosine = std::fabs(flow_x * lanes.nx[i] + flow_y * lanes.ny[i]);
    const float place = smaller(cosine * intervals, intervals - 0.001f);
    index[i] = static_cast<std::int32_t>(place);
    share[i] = place - static_cast<float>(index[i]);
  }
  fetch_rows(ice.birefringence.data(), index, columns);
}

void birefringent_step(const IceView& ice, Lanes& lanes) {
  alignas(64) Columns table;
  alignas(64) float share[N];
  look_up_birefringence(ice, lanes, share, table);
  const float flow_x = ice.flow_x, flow_y = ice.flow_y;
  const float displaced = ice.displacement ? 1.0f : 0.0f;
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float radius_12 = std::sqrt(-2 * natural_log(draw(lanes, i)));
    const TurnFunctions<float> turn_12 = turn_functions(draw(lanes, i));
    const float radius_34 = std::sqrt(-2 * natural_log(draw(lanes, i)));
    const TurnFunctions<float> turn_34 = turn_functions(draw(lanes, i));

    const FlowFrame<float> frame = flow_frame(flow_x, flow_y, lanes.nx[i], lanes.ny[i], lanes.nz[i]);
    const float width = std::sqrt(larger(0, lanes.diffusion[i]));
    const float sigma_x = width * (table[IceView::sigma_x][i] + share[i] * table[IceView::sigma_x_change][i]);
    const float sigma_y = width * (table[IceView::sigma_y][i] + share[i] * table[IceView::sigma_y_change][i]);
    const float mean_x = lanes.deflection[i] * frame.cosine * frame.sine *
                         (table[IceView::drift][i] + share[i] * table[IceView::drift_change][i]);
    birefringent_deflection(frame, sigma_x, sigma_y, mean_x, radius_12 * turn_12.cosine,
                            radius_12 * turn_12.sine, radius_34 * turn_34.cosine, radius_34 * turn_34.sine,
                            displaced * lanes.length[i], lanes.nx[i], lanes.ny[i], lanes.nz[i], lanes.x[i],
                            lanes.y[i], lanes.z[i]);
  }
}

// Into the stretched space of anisotropic scattering (sign +1) and back (sign -1).
void stretch(const IceView& ice, Lanes& lanes, float sign) {
  alignas(64) Columns layer;
  fetch_rows(ice.layers.data(), lanes.layer, layer);
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    float n1 = ice.flow_x * lanes.nx[i] + ice.flow_y * lanes.ny[i];
    float n2 = -ice.flow_y * lanes.nx[i] + ice.flow_x * lanes.ny[i];
    float n3 = lanes.nz[i];
    stretch_direction(std::exp(sign * layer[IceView::k1][i]), std::exp(sign * layer[IceView::k2][i]), n1, n2,
                      n3);
    lanes.nx[i] = ice.flow_x * n1 - ice.flow_y * n2;
    lanes.ny[i] = ice.flow_y * n1 + ice.flow_x * n2;
    lanes.nz[i] = n3;
  }
}

void new_direction(const IceView& ice, Lanes& lanes) {
  const ScatteringFunction<float> function = ice.scattering;
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float loss = function.one_minus_cos(draw(lanes, i));
    const TurnFunctions<float> turn = turn_functions(draw(lanes, i));
    deflect(loss, turn.cosine, turn.sine, lanes.nx[i], lanes.ny[i], lanes.nz[i]);
    ++lanes.scatters[i];
  }
}

}  // namespace

void advance(const IceView& ice, Lanes& lanes) {
  straight_on(lanes);
  if (ice.birefringent) birefringent_step(ice, lanes);
}

void scatter(const IceView& ice, Lanes& lanes) {
  if (ice.anisotropic_scattering) stretch(ice, lanes, 1);
  new_direction(ice, lanes);
  if (ice.anisotropic_scattering) stretch(ice, lanes, -1);
}

LanePiece piece_of_segment(const IceView& ice, const Lanes& lanes, int lane, float limit) {
  LanePiece result{0, lanes.scattering_depth_before[lane], lanes.absorption_depth_before[lane], 0, 0, 0};
  const float top = static_cast<float>(ice.last_layer);
  result.layer = static_cast<std::int32_t>(smaller(larger(lanes.height[lane], 0), top));
  const float per_slope = ice.step / slope_of(lanes.nz[lane]);
  const int up = goes_up(lanes.nz[lane]);
  const float factor =
      absorption_factor(ice, ice.layers[result.layer].values, lanes.nx[lane], lanes.ny[lane], lanes.nz[lane]);
  float reach = larger(0, (static_cast<float>(result.layer + up) - lanes.height[lane]) * per_slope);
  for (;;) {
    const float* layer = ice.layers[result.layer].values;
    const Coefficients here = coefficients(layer, 1, lanes, lane, factor);
    const int next = result.layer + 2 * up - 1;
    const float to_limit = limit - result.length, to_boundary = limited_reach(reach, next, ice.last_layer);
    const Piece piece =
        piece_of(here, result.scattering_depth, result.absorption_depth, smaller(to_boundary, to_limit));
    result.length += piece.length;
    result.diffusion += piece.length * layer[IceView::diffusion];
    result.deflection += piece.length * layer[IceView::deflection];
    result.scattering_depth -= piece.scattering_depth;
    result.absorption_depth -= piece.absorption_depth;
    if (piece.crosses == 0 || to_limit <= to_boundary) return result;
    result.layer = next;
    reach = std::fabs(per_slope);
  }
}

}  // namespace floe
