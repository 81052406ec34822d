// Between which values a number of an ice model makes sense. The reader checks its files against these
// with the line at hand, IceModel checks tables that come from elsewhere.
#pragma once

#include <string_view>

namespace floe::ice_limits {

struct Range {
  double low, high;  // both allowed
  std::string_view what;
};

inline constexpr Range depth{0, 5000, "depth [m]"};
inline constexpr Range effective_scattering{0, 1e4, "effective scattering coefficient [1/m]"};
// The deepest layers of published models are made opaque with absorption of order 1000 1/m.
inline constexpr Range dust_absorption{0, 1e5, "dust absorption [1/m]"};
inline constexpr Range temperature_difference{-90, 90, "delta-tau [K]"};
inline constexpr Range anisotropy{-3, 3, "anisotropy coefficient (natural logarithm)"};
inline constexpr Range birefringence_strength{0, 1000, "birefringence strength A"};
inline constexpr Range deflection_strength{0, 1000, "deflection strength B"};

inline constexpr Range alpha{-10, 10, "alpha"};
inline constexpr Range kappa{-10, 10, "kappa"};
inline constexpr Range thermal_A{0, 1e9, "A [1/m]"};
inline constexpr Range thermal_B{0, 1e6, "B [nm]"};
inline constexpr Range dust_coefficient{-1e9, 1e9, "coefficient D or E of dust absorption"};
inline constexpr Range uncertainty{0, 1e9, "uncertainty"};

inline constexpr Range bubble_scattering{0, 1e6, "b, scattering by bubbles [1/m]"};
inline constexpr Range bubble_depth{1, 5000, "depth where the bubbles end [m]"};

inline constexpr Range oversize{1, 100, "oversize of the modules"};
inline constexpr Range module_efficiency{1e-6, 1e3, "overall module efficiency"};
inline constexpr Range simplified_liu_fraction{0, 1, "f_SL, fraction of simplified Liu scattering"};
inline constexpr Range mean_cosine{-0.9999, 0.9999, "g, mean cosine of the scattering angle"};
inline constexpr Range flow_azimuth_deg{-360, 360, "azimuth of the ice flow [deg]"};
inline constexpr Range hole_ice_radius{0, 100, "hole ice radius [module radii]"};
inline constexpr Range hole_ice_length{1e-3, 1e6, "hole ice length [m]"};
inline constexpr Range old_absorption_scaling{-10, 10, "scaling of the old absorption anisotropy"};
// Of sigma and m: a negative amplitude or angle scale would turn the functions' meaning around.
inline constexpr Range diffusion_A{0, 1e3, "A of a birefringence function"};
inline constexpr Range diffusion_B{-1e12, 1e12, "B of a birefringence function"};
inline constexpr Range diffusion_C{-1e3, 1e3, "C of a birefringence function"};
inline constexpr Range diffusion_D{0, 1e6, "D of a birefringence function"};

inline constexpr Range tilt_shift{-5000, 5000, "layer shift [m]"};
inline constexpr Range tilt_distance{-1e5, 1e5, "distance [m]"};
inline constexpr Range tilt_direction_deg{-360, 360, "direction of a grid axis [deg]"};
inline constexpr Range tilt_step{1e-3, 1e5, "step of a grid axis [m]"};
inline constexpr Range tilt_count{2, 1000, "number of points of a grid axis"};
inline constexpr Range tilt_cut{1, 1000, "corner cut of a grid axis"};

}  // namespace floe::ice_limits
