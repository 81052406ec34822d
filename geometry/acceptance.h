// What light a module accepts: by angle, by wavelength, by the shadow of its cable.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "data/base/constants.h"
#include "data/event.h"
#include "geometry/detector.h"

namespace floe {

// Relative acceptance against the direction of the photon (as.dat), or against the place of impact.
class AngularAcceptance {
 public:
  // Polynomial sum_k c_k cos(eta)^k, cos(eta) = photon direction . up axis (a photon that goes
  // straight up meets the photomultiplier head-on). `maximum` > 0 is the largest value it is used
  // with; negative values count as 0. Throws InputError when it is not in [0, maximum] anywhere.
  static AngularAcceptance polynomial(double maximum, std::vector<double> coefficients);
  // With the largest value that it has for its maximum.
  static AngularAcceptance polynomial(std::vector<double> coefficients);
  // Accepts only a cap around the lower pole: -(impact point . up axis) > cut on the unit sphere.
  static AngularAcceptance surface(double cut);

  // Probability in [0, 1], relative to maximum(), that a photon is accepted.
  double probability(const Vec3& photon_direction, const Vec3& inward, const Vec3& up_axis) const;
  double maximum() const { return maximum_; }  // 1 for surface()
  bool is_surface() const { return surface_; }
  double cut() const { return cut_; }
  const std::vector<double>& coefficients() const { return coefficients_; }
  bool operator==(const AngularAcceptance&) const = default;

 private:
  bool surface_ = false;
  double maximum_ = 1, cut_ = 0;
  std::vector<double> coefficients_;
};
AngularAcceptance read_angular_acceptance(const std::filesystem::path& as_dat);

// A distribution of wavelengths, piecewise uniform between its points (wv.dat): cumulative 0..1
// against wavelength [nm], both rising.
class WavelengthSpectrum {
 public:
  struct Point {
    double cumulative, wavelength;
    bool operator==(const Point&) const = default;
  };
  // Throws InputError unless points rise strictly in wavelength, do not fall in cumulative, start at 0
  // and end at 1.
  explicit WavelengthSpectrum(std::vector<Point> points);

  double sample(double u) const;            // wavelength at cumulative u in [0, 1]
  double density(double wavelength) const;  // [1/nm]
  const std::vector<Point>& points() const { return points_; }
  bool operator==(const WavelengthSpectrum&) const = default;

 private:
  static constexpr std::size_t guides = 256;
  void lay_out_guides();

  std::vector<Point> points_;
  std::array<std::uint16_t, guides> first_interval_{};  // where to look for a cumulative
};
WavelengthSpectrum read_wavelength_spectrum(const std::filesystem::path& wv_dat);

// Ratio of the acceptance of high-QE modules to nominal ones against wavelength (wv.rde); linear
// between points, constant beyond them.
class HighQeRatio {
 public:
  struct Point {
    double wavelength, ratio;
    bool operator==(const Point&) const = default;
  };
  explicit HighQeRatio(std::vector<Point> points);  // throws InputError
  double operator()(double wavelength) const;
  double maximum() const;
  const std::vector<Point>& points() const { return points_; }
  bool operator==(const HighQeRatio&) const = default;

 private:
  std::vector<Point> points_;
};
HighQeRatio read_high_qe_ratio(const std::filesystem::path& wv_rde);

// Whether the main cable, a vertical cylinder of radius `radius` [m] that touches the module at
// `cable_azimuth` [rad], hides the module from a photon: true when the line backwards from its landing
// point meets the cable. `inward`: direction from the landing point to the centre.
bool cable_shadows(double cable_azimuth, const Vec3& photon_direction, const Vec3& inward,
                   double radius = cable_radius);

// How the modules of a detector accept light: one value, part of a Model.
struct ModuleAcceptance {
  double overall_efficiency = 1;  // cfg.txt
  AngularAcceptance angular = AngularAcceptance::polynomial(1, {1});
  WavelengthSpectrum spectrum{{{0, 300}, {1, 600}}};  // Cherenkov light as a nominal module accepts it
  std::optional<HighQeRatio> high_qe;                 // absent: high-QE modules differ by efficiency only
  double cable_radius = floe::cable_radius;           // of the main cables [m]; 0: they hide nothing

  bool operator==(const ModuleAcceptance&) const = default;
};

// The built-in acceptance: nominal IceCube module, from published curves, with its sources.
ModuleAcceptance builtin_acceptance();

}  // namespace floe
