#include "propagation/ice/ice_validation.h"

#include <fmt/format.h>

#include <algorithm>

#include "propagation/ice/ice_files.h"

namespace floe {

namespace {

namespace limits = ice_limits;

// Checks numbers and says, when one is wrong, to which ice and which part of it it belongs.
class Checker {
 public:
  explicit Checker(const IceTables& tables) : ice_("ice " + tables.name) {}

  void number(double value, const limits::Range& range, std::string_view place = "") const {
    if (range.low <= value && value <= range.high) return;  // false for NaN
    fail(fmt::format("{} = {}{}", range.what, value, place), fmt::format("{} to {}", range.low, range.high));
  }
  void that(bool holds, std::string_view found, std::string_view expected) const {
    if (!holds) fail(found, expected);
  }
  void uniform(const std::vector<double>& depths, std::string_view what) const {
    for (double depth : depths) number(depth, limits::depth);
    if (const auto bad = ice_files::first_irregular(depths))
      fail(fmt::format("depth {} m after {} m in the {}", depths[*bad], depths[*bad - 1], what),
           "depths that rise in uniform steps");
  }

 private:
  [[noreturn]] void fail(std::string_view found, std::string_view expected) const {
    throw InputError({ice_}, found, expected);
  }
  std::string ice_;
};

void check_layer(const Checker& check, const IceLayerRow& row) {
  const std::string place = fmt::format(" in the layer at {} m", row.depth);
  check.number(row.effective_scattering, limits::effective_scattering, place);
  check.number(row.dust_absorption, limits::dust_absorption, place);
  check.number(row.temperature_difference, limits::temperature_difference, place);
  check.number(row.k1.value_or(0), limits::anisotropy, place);
  check.number(row.k2.value_or(0), limits::anisotropy, place);
  check.number(row.birefringence_strength, limits::birefringence_strength, place);
  check.number(row.deflection_strength, limits::deflection_strength, place);
}

void check_layers(const Checker& check, const std::vector<IceLayerRow>& layers) {
  check.that(!layers.empty(), "no layers", "at least one layer");
  std::vector<double> depths;
  for (const auto& row : layers) {
    check_layer(check, row);
    depths.push_back(row.depth);
  }
  check.uniform(depths, "layers");
}

void check_wavelength(const Checker& check, const WavelengthDependence& wavelength) {
  check.number(wavelength.alpha, limits::alpha);
  check.number(wavelength.kappa, limits::kappa);
  check.number(wavelength.A, limits::thermal_A);
  check.number(wavelength.B, limits::thermal_B);
  check.number(wavelength.D.value_or(0), limits::dust_coefficient);
  check.number(wavelength.E.value_or(0), limits::dust_coefficient);
}

void check_function(const Checker& check, const DiffusionFunction& function) {
  check.number(function.A, limits::diffusion_A);
  check.number(function.B, limits::diffusion_B);
  check.number(function.C, limits::diffusion_C);
  check.number(function.D, limits::diffusion_D);
}

void check_configuration(const Checker& check, const IceConfiguration& c) {
  check.number(c.oversize, limits::oversize);
  check.number(c.module_efficiency, limits::module_efficiency);
  check.number(c.simplified_liu_fraction, limits::simplified_liu_fraction);
  check.number(c.mean_cosine, limits::mean_cosine);
  check.number(c.flow_azimuth_deg, limits::flow_azimuth_deg);
  check.number(c.k1, limits::anisotropy);
  check.number(c.k2, limits::anisotropy);
  check.number(c.hole_ice.radius, limits::hole_ice_radius);
  check.number(c.hole_ice.effective_scattering_length, limits::hole_ice_length);
  check.number(c.hole_ice.absorption_length, limits::hole_ice_length);
  check.number(c.hole_ice.simplified_liu_fraction, limits::simplified_liu_fraction, " of the hole ice");
  check.number(c.hole_ice.mean_cosine, limits::mean_cosine, " of the hole ice");
  const auto absorption = c.absorption_anisotropy.value_or(IceConfiguration::AbsorptionAnisotropy{});
  for (double k : {absorption.k1, absorption.k2, absorption.kz})
    check.number(k, limits::anisotropy, " of absorption");
  check.number(c.old_absorption_scaling, limits::old_absorption_scaling);
  if (!c.birefringence) return;
  for (const auto& f : {c.birefringence->sigma_x, c.birefringence->sigma_y, c.birefringence->mean_x})
    check_function(check, f);
}

void check_shifts(const Checker& check, const std::vector<double>& depths,
                  const std::vector<std::vector<double>>& shifts, std::size_t columns) {
  check.uniform(depths, "tilt");
  check.that(depths.size() >= 2, "a tilt of fewer than 2 depths", "at least 2 depths");
  check.that(shifts.size() == depths.size(), fmt::format("{} rows of layer shifts", shifts.size()),
             fmt::format("one for each of {} depths", depths.size()));
  for (const auto& row : shifts) {
    check.that(row.size() == columns, fmt::format("{} layer shifts", row.size()),
               fmt::format("one for each of {} places", columns));
    for (double shift : row) check.number(shift, limits::tilt_shift);
  }
}

void check_tilt_lines(const Checker& check, const TiltLines& tilt) {
  const auto& distances = tilt.distances;
  check.that(distances.size() >= 2 && distances.size() == tilt.strings.size(),
             fmt::format("a tilt of {} distances and {} strings", distances.size(), tilt.strings.size()),
             "at least 2 distances, each with its string");
  for (double distance : distances) check.number(distance, limits::tilt_distance);
  check.that(
      std::adjacent_find(distances.begin(), distances.end(), std::greater_equal<>()) == distances.end(),
      "tilt distances that do not rise", "rising distances");
  check.that(std::find(distances.begin(), distances.end(), 0.0) != distances.end(), "no tilt distance 0",
             "one string at distance 0, the origin");
  check_shifts(check, tilt.depths, tilt.shifts, distances.size());
}

void check_tilt_map(const Checker& check, const TiltMap& tilt) {
  for (const auto& axis : {tilt.first, tilt.second}) {
    check.number(axis.direction_deg, limits::tilt_direction_deg);
    check.number(axis.start, limits::tilt_distance);
    check.number(axis.step, limits::tilt_step);
    check.number(axis.count, limits::tilt_count);
    check.number(axis.cut, limits::tilt_cut);
  }
  check.that(tilt.first.cut + tilt.second.cut >= 3, "a tilt grid without a cell",
             "corner cuts of sum 3 or more");
  check_shifts(check, tilt.depths, tilt.shifts, ice_files::kept_points(tilt));
}

}  // namespace

void validate(const IceTables& tables) {
  const Checker check(tables);
  check.that(ice_files::is_supported(tables.version), fmt::format("version {}", tables.version),
             "version 0, 10 or 20");
  check_layers(check, tables.layers);
  check_wavelength(check, tables.wavelength);
  if (const auto& bubbles = tables.bubbles) {
    check.number(bubbles->b, limits::bubble_scattering);
    check.number(bubbles->d1, limits::bubble_depth);
    check.number(bubbles->d2, limits::bubble_depth);
  }
  check_configuration(check, tables.configuration);
  if (tables.tilt_lines) check_tilt_lines(check, *tables.tilt_lines);
  if (tables.tilt_map) check_tilt_map(check, *tables.tilt_map);
}

}  // namespace floe
