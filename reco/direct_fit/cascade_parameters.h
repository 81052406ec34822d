// The seven numbers of a cascade, and how fits count them.
#pragma once

#include <Eigen/Core>
#include <array>

#include "data/base/constants.h"
#include "propagation/sources/cascade.h"

namespace floe {

// What a cascade fit determines. The order of every 7-vector and 7x7 matrix that leaves the fit is
// x, y, z [m], time [ns], zenith, azimuth [rad], energy [GeV].
struct CascadeParameters {
  Vec3 position = Vec3::Zero();    // the vertex [m]
  double time = 0;                 // at the vertex [ns]
  double zenith = 0, azimuth = 0;  // where it comes FROM [rad]
  double energy = 0;               // [GeV], > 0
};
using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

// How tables and files show them: value / unit_size, with so many digits.
struct ShownParameter {
  const char *name, *unit;
  const char* key;  // in JSON
  double unit_size = 1;
  int digits = 2;
};
inline constexpr std::array<ShownParameter, 7> shown_parameters{{{"x", "m", "x"},
                                                                 {"y", "m", "y"},
                                                                 {"z", "m", "z"},
                                                                 {"time", "ns", "time_ns"},
                                                                 {"zenith", "deg", "zenith_deg", degree},
                                                                 {"azimuth", "deg", "azimuth_deg", degree},
                                                                 {"energy", "GeV", "energy_gev", 1, 0}}};

Vector7 to_vector(const CascadeParameters& cascade);
Cascade to_cascade(const CascadeParameters& cascade, CascadeKind kind);

// Distance between vertices [m] and angle between axes [rad] of two cascades.
double distance_between(const CascadeParameters& a, const CascadeParameters& b);
double angle_between(const CascadeParameters& a, const CascadeParameters& b);

// to - from as far as one Gaussian can tell: the turn between the axes is measured along the great circle and
// laid onto the plane of zenith and azimuth at `from`. Angles in radians, azimuth as it stands there (the way
// on the sphere is sin(zenith) times that).
Vector7 displacement(const CascadeParameters& from, const CascadeParameters& to);

// The same cascade as the light sees it. Detectors measure where the light comes from, not where the
// cascade began: place and time are those of the mean of the longitudinal profile, and brightness is
// the light, in metres of bare track. In these numbers place, direction and brightness are nearly
// uncorrelated, which is why fits work in them.
struct LightCentre {
  Vec3 position = Vec3::Zero();     // [m]
  double time = 0;                  // [ns]
  Vec3 direction = -Vec3::UnitZ();  // of travel, unit vector
  double log_light = 0;             // ln(light yield [m])
};
LightCentre light_centre(const CascadeParameters& cascade, CascadeKind kind);
// The inverse; energies are sought in 0.1 GeV to 1e9 GeV and end there.
CascadeParameters cascade_of(const LightCentre& light, CascadeKind kind);

}  // namespace floe
