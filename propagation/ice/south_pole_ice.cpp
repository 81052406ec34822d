// The built-in ice "south-pole": an idealised South Pole, put together from published facts, to be used
// where no calibrated model is at hand. It is not a calibrated model.
#include <algorithm>
#include <cmath>
#include <span>

#include "data/base/vec3.h"
#include "propagation/ice/ice_tables.h"

namespace floe {

namespace {

// Effective scattering and absorption lengths at 400 nm at the peaks and troughs of the depth profile
// (rounded; depths and sizes of the dust layers: arXiv:1301.5361, with the birefringent share included as in
// arXiv:2107.08692). Above 1350 m, where bubbles take over, and below 2450 m the profile is a guess.
struct ProfilePoint {
  double depth, scattering_length, absorption_length;  // [m]
};
constexpr ProfilePoint profile[] = {
    {1100, 6, 25},   {1350, 9, 37},  {1450, 17, 62},  {1500, 33, 130}, {1548, 13, 41},  // dust at 1548 m
    {1598, 32, 78},  {1628, 17, 54}, {1668, 44, 178}, {1738, 21, 49},  // dust at 1628, 1738 m
    {1808, 46, 201}, {1868, 23, 70}, {1918, 46, 200},                  // dust at 1868 m
    {1998, 8, 24},   {2053, 7, 29},  {2105, 50, 160},                  // main dust layer
    {2148, 56, 208}, {2190, 30, 95}, {2238, 52, 170}, {2290, 70, 240}, {2360, 25, 73},
    {2450, 70, 237}, {2800, 70, 237}};

// Strength of birefringence, 1 mm over the distance between crossings. About 2 where the detector is
// (arXiv:2107.08692); the fall with depth stands for the growth of grains and is idealised.
struct StrengthPoint {
  double depth, strength;
};
constexpr StrengthPoint strengths[] = {{1100, 2.5}, {1400, 2.0}, {2300, 2.0}, {2800, 0.8}};

constexpr double top = 1100, bottom = 2800, step = 10;  // of the layers [m]

// Index i of the interval [i, i + 1] of a table sorted by depth, and the share of it above `depth`.
struct Place {
  std::size_t index;
  double share;
};
template <class Point>
Place place_in(std::span<const Point> table, double depth) {
  std::size_t i = 0;
  while (i + 2 < table.size() && table[i + 1].depth < depth) ++i;
  return {i, std::clamp((depth - table[i].depth) / (table[i + 1].depth - table[i].depth), 0.0, 1.0)};
}

// The points are peaks and troughs: the slope is zero there, and a half cosine in the logarithm joins them.
double joined(double from, double to, double share) {
  return from * std::pow(to / from, (1 - std::cos(pi * share)) / 2);
}

// Temperature of the South Pole's ice [K] (arXiv:1301.5361, section 4).
double temperature(double depth) {
  return 221.5 - 0.00045319 * depth + 5.822e-6 * depth * depth;
}
constexpr double reference_depth = 1730;  // where delta-tau is 0 [m]

WavelengthDependence wavelength_dependence() {  // arXiv:1301.5361, rounded
  WavelengthDependence w;
  w.alpha = 0.90, w.kappa = 1.08, w.A = 6954, w.B = 6618;
  w.uncertainty = {0.03, 0.01, 973, 71, 0, 0};
  return w;
}

IceLayerRow layer_at_depth(double depth, const WavelengthDependence& w) {
  const auto [i, share] = place_in<ProfilePoint>(profile, depth);
  const double scattering_length =
      joined(profile[i].scattering_length, profile[i + 1].scattering_length, share);
  const double absorption_length =
      joined(profile[i].absorption_length, profile[i + 1].absorption_length, share);
  const auto [k, strength_share] = place_in<StrengthPoint>(strengths, depth);

  IceLayerRow row;
  row.depth = depth;
  row.effective_scattering = 1 / scattering_length;
  row.temperature_difference = temperature(depth) - temperature(reference_depth);
  row.dust_absorption =
      1 / absorption_length - w.A * std::exp(-w.B / 400) * (1 + 0.01 * row.temperature_difference);
  row.k1 = row.k2 = 0;
  row.birefringence_strength = std::lerp(strengths[k].strength, strengths[k + 1].strength, strength_share);
  return row;
}

}  // namespace

BirefringenceNumbers published_birefringence() {
  BirefringenceNumbers numbers;
  numbers.sigma_x = {0.076795, 544284.545, 2.229494, 0.002624};
  numbers.sigma_y = {0.077381, 1547618.884, 2.449589, 0.002505};
  numbers.mean_x = {0.000995, 0.248264, 2.354436, 1.680717};
  return numbers;
}

IceTables south_pole_ice() {
  IceTables tables;
  tables.name = "south-pole";
  tables.wavelength = wavelength_dependence();
  for (double depth = top + step / 2; depth < bottom; depth += step)
    tables.layers.push_back(layer_at_depth(depth, tables.wavelength));
  auto& c = tables.configuration;
  c.simplified_liu_fraction = 0.35, c.mean_cosine = 0.9;  // arXiv:1301.5361, 2107.08692
  c.flow_azimuth_deg = 130;                               // arXiv:1309.7010
  c.absorption_anisotropy = {0.6, -0.3, -0.3};            // arXiv:2107.08692
  c.old_absorption_scaling = 0;
  c.birefringence = published_birefringence();
  return tables;
}

}  // namespace floe
