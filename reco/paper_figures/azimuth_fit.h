// How much of the light goes along one axis: level x (1 + c cos 2(azimuth - phi)).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace floe {

struct AzimuthPoint {
  std::size_t group = 0;      // points of one group (the neighbours of one emitter) share a level
  double azimuth = 0;         // [rad]
  double ratio = 0;           // light in units of that in isotropic ice, > 0
  double relative_error = 0;  // of the ratio, > 0
};

struct AzimuthFit {
  Eigen::Vector2d modulation = Eigen::Vector2d::Zero();  // c cos 2 phi, c sin 2 phi
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  std::vector<double> levels;  // by group
  double chi2 = 0;
  int ndof = 0;

  double value(double azimuth) const;                     // of the curve, for level 1
  double amplitude() const { return modulation.norm(); }  // c
  double amplitude_error() const;
  double phase() const;        // phi, where there is most light: [0, pi) [rad]
  double phase_error() const;  // [rad]
  double max_over_min() const { return (1 + amplitude()) / (1 - amplitude()); }
  double max_over_min_error() const;
  // The amplitude is never negative, not even that of noise; its part along an axis that is known
  // beforehand is, as often as not, when there is none.
  double along(double axis) const;
  double along_error(double axis) const;
  double isotropy_p_value() const;  // of a modulation as large as this in isotropic ice
};

// Weighted least squares. For given levels the curve is linear in c cos 2 phi and c sin 2 phi, and for a
// given curve in the levels: Gauss-Newton steps from isotropy until nothing changes. Weights belong to the
// fitted values, not to the scattered ones, which would pull the fit downwards. Throws NoResult when the
// points do not tell the numbers.
AzimuthFit fit_azimuth(std::span<const AzimuthPoint> points);

}  // namespace floe
