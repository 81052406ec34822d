// The ice as physics: validated, immutable, named by a hash. Engine and printouts read it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "propagation/ice/ice_tables.h"
#include "propagation/ice/tilt.h"

namespace floe {

// Refractive index of ice (arXiv:1301.5361 and references there), wavelength in nm, 250 <= wavelength <= 700.
double phase_index(double wavelength);
double group_index(double wavelength);

// What the engine needs of one layer. For a photon of wavelength lambda
//   effective scattering coefficient = scattering_constant + scattering_power (lambda/400)^-alpha
//   absorption coefficient           = absorption_dust (lambda/400)^-kappa
//                                      + absorption_thermal A e^(-B/lambda)
// both [1/m] (physics: arXiv:1301.5361 section 4, with bubbles, birefringent share and version folded in).
struct IceLayer {
  double scattering_constant = 0, scattering_power = 0;
  double absorption_dust = 0, absorption_thermal = 0;
  double k1 = 0, k2 = 0;           // scattering anisotropy (natural logs)
  double diffusion_strength = 0;   // a: variances grow with a L
  double deflection_strength = 0;  // a b: the mean deflection grows with a b L
};

// Thickness of uniform layers [m]. A single one fills all space; 100 m stand for it.
double layer_step(const std::vector<IceLayerRow>& layers);

// Tables that were checked, and the physics that follows from them; never changes.
class IceModel {
 public:
  // Throws InputError when a value is not physical: scattering or absorption not positive in a layer
  // at any wavelength of 260-680 nm, g outside (-1, 1), fractions outside [0, 1], ...
  IceModel(IceTables tables, const Detector& detector);

  const std::string& name() const { return tables_.name; }
  const std::string& hash() const { return hash_; }  // of every number that matters, see ice_hash.h
  const IceTables& tables() const { return tables_; }

  // Layers from the bottom up: layer i holds z_bottom + i step <= z - shift < z_bottom + (i + 1) step;
  // below the first and above the last, these continue.
  const std::vector<IceLayer>& layers() const { return layers_; }
  double layer_step() const { return step_; }
  double z_bottom() const { return z_bottom_; }
  int layer_at(double z) const;
  const LayerTilt& tilt() const { return tilt_; }

  // Coefficients at a wavelength [nm], isotropic part [1/m].
  double effective_scattering(int layer, double wavelength) const;
  double geometric_scattering(int layer, double wavelength) const;  // effective / (1 - g)
  double absorption(int layer, double wavelength) const;
  double scattering_power_factor(double wavelength) const;    // (lambda/400)^-alpha
  double absorption_dust_factor(double wavelength) const;     // (lambda/400)^-kappa
  double absorption_thermal_factor(double wavelength) const;  // A e^(-B/lambda)

  double simplified_liu_fraction() const;
  double mean_cosine() const;
  double flow_azimuth() const;  // [rad]
  // Absorption anisotropy factors (K1, K2, Kz), normalised as in arXiv:2107.08692: the coefficient is
  // multiplied by 1/sqrt((K1 n1)^2 + (K2 n2)^2 + (Kz n3)^2); all 1 when off.
  const std::array<double, 3>& absorption_anisotropy() const { return absorption_K_; }
  double old_absorption_scaling() const;  // exponent f; 0: off (also when no layer has k1 or k2)
  const std::optional<BirefringenceNumbers>& birefringence() const;
  // S: birefringent scattering of 1 m at strength 1, averaged over isotropic directions [1/m].
  double birefringent_scattering() const { return birefringent_scattering_; }

 private:
  void expect_light_transport() const;

  IceTables tables_;
  std::string hash_;
  std::vector<IceLayer> layers_;
  double step_ = 0, z_bottom_ = 0;
  LayerTilt tilt_;
  std::array<double, 3> absorption_K_{1, 1, 1};
  double birefringent_scattering_ = 0;
};

// sigma_x, sigma_y, m_x of 1 m at strength 1 for a photon at angle eta to the flow, from |cos eta|.
struct DiffusionStep {
  double sigma_x, sigma_y, mean_x;
};
DiffusionStep diffusion_step(const BirefringenceNumbers& numbers, double abs_cos_eta);

// The mean over isotropic directions of (sigma_x^2 + sigma_y^2 + m_x^2)/2 [1/m].
double mean_birefringent_scattering(const BirefringenceNumbers& numbers);

}  // namespace floe
