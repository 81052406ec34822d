#include "propagation/ice/ice_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "data/base/vec3.h"
#include "propagation/ice/dust.h"
#include "propagation/ice/ice_hash.h"
#include "propagation/ice/ice_validation.h"

namespace floe {

namespace {

constexpr double shortest_seen = 260, longest_seen = 680;  // by modules, wv.dat of published models [nm]
constexpr double lone_layer_step = 100;  // a single layer fills all space; any step will do [m]

// arXiv:1301.5361: above the depth where bubbles have turned into clathrate they scatter light of every
// colour alike.
double bubble_scattering(const std::optional<Bubbles>& bubbles, double depth) {
  if (!bubbles || depth >= bubbles->d1 || depth >= bubbles->d2) return 0;
  return bubbles->b * (1 - depth / bubbles->d1) * (1 - depth / bubbles->d2);
}

IceLayer make_layer(const IceTables& tables, const IceLayerRow& row, double birefringent_scattering) {
  const auto& c = tables.configuration;
  IceLayer layer;
  layer.scattering_constant = bubble_scattering(tables.bubbles, row.depth);
  layer.scattering_power = row.effective_scattering;
  const double birefringent_share = row.birefringence_strength * birefringent_scattering;
  if (tables.version == 0) layer.scattering_constant -= birefringent_share;
  if (tables.version == 20) layer.scattering_power -= birefringent_share;

  layer.absorption_dust = dust_law(tables, row).absorption(row.dust_absorption);
  layer.absorption_thermal = 1 + 0.01 * row.temperature_difference;

  layer.k1 = row.k1.value_or(c.k1);
  layer.k2 = row.k2.value_or(c.k2);
  if (c.birefringence) {
    layer.diffusion_strength = row.birefringence_strength;
    layer.deflection_strength = row.birefringence_strength * row.deflection_strength;
  }
  return layer;
}

// The mean over directions of 1/sqrt((K1 n1)^2 + (K2 n2)^2 + (K2 n3)^2) with r = K1/K2 >= 1 is
// acosh(r) / (K2 sqrt(r^2 - 1)); dividing by it leaves the mean absorption as tabulated.
std::array<double, 3> normalised_anisotropy(const IceConfiguration::AbsorptionAnisotropy& k) {
  std::array<double, 3> K{std::exp(k.k1), std::exp(k.k2), std::exp(k.kz)};
  if (!(k.k1 >= k.k2 && k.k2 == k.kz)) return K;
  const double r = std::exp(k.k1 - k.k2), q = std::sqrt(r * r - 1);
  const double mean = (q > 1e-4 ? std::log(r + q) / q : 1 - q * q / 6) / K[1];
  for (double& factor : K) factor *= mean;
  return K;
}

}  // namespace

double layer_step(const std::vector<IceLayerRow>& layers) {
  if (layers.size() < 2) return lone_layer_step;
  return (layers.back().depth - layers.front().depth) / static_cast<double>(layers.size() - 1);
}

IceModel::IceModel(IceTables tables, const Detector& detector) : tables_(std::move(tables)) {
  validate(tables_);
  const auto& rows = tables_.layers;
  const auto& c = tables_.configuration;
  if (c.birefringence) birefringent_scattering_ = mean_birefringent_scattering(*c.birefringence);
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    layers_.push_back(make_layer(tables_, *row, birefringent_scattering_));
  step_ = floe::layer_step(rows);
  z_bottom_ = origin_depth - rows.back().depth - step_ / 2;
  if (c.absorption_anisotropy) absorption_K_ = normalised_anisotropy(*c.absorption_anisotropy);
  expect_light_transport();
  tilt_ = LayerTilt(tables_, detector);
  hash_ = ice_hash(tables_);
}

// Sums of positive and negative shares must stay positive wherever there is light to propagate.
void IceModel::expect_light_transport() const {
  for (int layer = 0; layer < static_cast<int>(layers_.size()); ++layer)
    for (double wavelength = shortest_seen; wavelength <= longest_seen; wavelength += 10) {
      const double scattering = effective_scattering(layer, wavelength);
      const double absorbed = absorption(layer, wavelength);
      if (scattering > 0 && absorbed > 0) continue;
      const auto& row = tables_.layers[layers_.size() - 1 - layer];
      const std::string place = fmt::format("in the layer at {} m for {} nm", row.depth, wavelength);
      if (scattering > 0)
        throw InputError({"ice " + name()}, fmt::format("absorption {:.4g} 1/m {}", absorbed, place),
                         "a positive absorption coefficient");
      const double share = row.birefringence_strength * birefringent_scattering_;
      if (tables_.version != 10 && share > 0)
        throw InputError(
            {"ice " + name()},
            fmt::format("birefringent share {:.4g} 1/m exceeds the scattering {}, which leaves {:.4g} 1/m",
                        share, place, scattering),
            "a birefringence strength below the layer's total scattering",
            "Lower the strength A, raise the scattering, or use version 10 (nothing subtracted)");
      throw InputError({"ice " + name()}, fmt::format("scattering {:.4g} 1/m {}", scattering, place),
                       "a positive scattering coefficient");
    }
}

int IceModel::layer_at(double z) const {
  const double index = std::floor((z - z_bottom_) / step_);
  return static_cast<int>(std::clamp(index, 0.0, static_cast<double>(layers_.size() - 1)));
}

double IceModel::effective_scattering(int layer, double wavelength) const {
  return layers_[layer].scattering_constant +
         layers_[layer].scattering_power * scattering_power_factor(wavelength);
}

double IceModel::geometric_scattering(int layer, double wavelength) const {
  return effective_scattering(layer, wavelength) / (1 - mean_cosine());
}

double IceModel::absorption(int layer, double wavelength) const {
  return layers_[layer].absorption_dust * absorption_dust_factor(wavelength) +
         layers_[layer].absorption_thermal * absorption_thermal_factor(wavelength);
}

double IceModel::scattering_power_factor(double wavelength) const {
  return std::pow(wavelength / reference_wavelength, -tables_.wavelength.alpha);
}

double IceModel::absorption_dust_factor(double wavelength) const {
  return std::pow(wavelength / reference_wavelength, -tables_.wavelength.kappa);
}

double IceModel::absorption_thermal_factor(double wavelength) const {
  return thermal_factor(tables_.wavelength, wavelength);
}

double IceModel::simplified_liu_fraction() const {
  return tables_.configuration.simplified_liu_fraction;
}
double IceModel::mean_cosine() const {
  return tables_.configuration.mean_cosine;
}
double IceModel::flow_azimuth() const {
  return tables_.configuration.flow_azimuth_deg * degree;
}

double IceModel::old_absorption_scaling() const {
  const auto anisotropic = [](const IceLayer& layer) { return layer.k1 != 0 || layer.k2 != 0; };
  return std::any_of(layers_.begin(), layers_.end(), anisotropic)
             ? tables_.configuration.old_absorption_scaling
             : 0;
}

const std::optional<BirefringenceNumbers>& IceModel::birefringence() const {
  return tables_.configuration.birefringence;
}

}  // namespace floe
