// Numbers of the site, of light and of the optical module that several rooms share.
// Units of the whole library: m, ns, GeV, nm, rad.
#pragma once

namespace floe {

inline constexpr double speed_of_light = 0.299792458;  // in vacuum [m/ns]

// Depth of the detector frame's origin below the surface [m]: z = origin_depth - depth.
inline constexpr double origin_depth = 1948.07;

inline constexpr double module_radius = 0.1651;  // of an optical module's glass sphere [m]
inline constexpr double cable_radius = 0.023;    // of the main cable beside a module [m]

// Cherenkov photons per metre of bare track, weighted by the wavelength acceptance and the area of a
// nominal module [1/m].
inline constexpr double photons_per_metre = 2450.08;

}  // namespace floe
