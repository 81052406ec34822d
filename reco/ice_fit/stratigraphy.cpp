#include "reco/ice_fit/stratigraphy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/base/constants.h"

namespace floe {

namespace {

constexpr double shown_wavelength = 400;  // [nm]

// The relative error of a family's factor at a depth; 0 where nothing was fitted.
double error_at(const IceFit& fit, const std::string& family, double depth) {
  double error = 0, nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const IceParameter& p = fit.parameters[i];
    if (p.family != family || std::abs(p.depth - depth) >= nearest) continue;
    nearest = std::abs(p.depth - depth);
    error = std::sqrt(fit.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)));
  }
  return error;
}

// The depths of all families, and half a group beyond.
struct Depths {
  double top = -std::numeric_limits<double>::infinity(), bottom = std::numeric_limits<double>::infinity();
};
Depths fitted_depths(const IceFit& fit) {
  double top = std::numeric_limits<double>::infinity(), bottom = -top, step = top;
  double last = -bottom;
  for (const IceParameter& p : fit.parameters) {
    if (p.family.empty()) continue;
    top = std::min(top, p.depth);
    bottom = std::max(bottom, p.depth);
    if (p.depth != last) step = std::min(step, std::abs(p.depth - last));
    last = p.depth;
  }
  if (!(bottom >= top)) return {};
  if (!std::isfinite(step)) step = 100;
  return {top - step / 2, bottom + step / 2};
}

double strength_of(const IceModel& ice, int layer) {
  return ice.birefringence() ? ice.layers()[static_cast<std::size_t>(layer)].diffusion_strength : 0;
}

}  // namespace

double crystal_size(double strength) {
  return strength > 0 ? 1 / strength : std::numeric_limits<double>::infinity();
}

std::vector<StratigraphyRow> stratigraphy(const Model& base, const Model& fitted, const IceFit& fit) {
  const IceModel &was = *base.ice, &is = *fitted.ice;
  const Depths depths = fitted_depths(fit);
  std::vector<StratigraphyRow> rows;
  for (int layer = static_cast<int>(is.layers().size()) - 1; layer >= 0; --layer) {
    const double depth = origin_depth - (is.z_bottom() + (layer + 0.5) * is.layer_step());
    if (depth < depths.top || depth > depths.bottom) continue;
    rows.push_back({depth, 1 / is.effective_scattering(layer, shown_wavelength),
                    1 / was.effective_scattering(layer, shown_wavelength),
                    1 / is.absorption(layer, shown_wavelength), 1 / was.absorption(layer, shown_wavelength),
                    strength_of(is, layer), strength_of(was, layer), error_at(fit, "scattering", depth),
                    error_at(fit, "absorption", depth), error_at(fit, "birefringence", depth)});
  }
  return rows;
}

std::string stratigraphy_csv(const std::vector<StratigraphyRow>& rows) {
  std::string text =
      "depth_m,effective_scattering_length_m,base_effective_scattering_length_m,scattering_relative_error,"
      "absorption_length_m,base_absorption_length_m,absorption_relative_error,"
      "birefringence_strength,base_birefringence_strength,strength_relative_error,crystal_size_mm\n";
  for (const StratigraphyRow& row : rows)
    text += fmt::format("{:.1f},{:.4g},{:.4g},{:.3g},{:.4g},{:.4g},{:.3g},{:.4g},{:.4g},{:.3g},{:.4g}\n",
                        row.depth, row.scattering_length, row.base_scattering_length, row.scattering_error,
                        row.absorption_length, row.base_absorption_length, row.absorption_error, row.strength,
                        row.base_strength, row.strength_error, crystal_size(row.strength));
  return text;
}

}  // namespace floe
