// What becomes of a photon that lands on a module: kept as a hit, or lost.
#pragma once

#include <vector>

#include "geometry/acceptance.h"
#include "geometry/module_scene.h"
#include "propagation/engine/random.h"

namespace floe {

// Of a source's N nominal photons only N x largest_share() are drawn, where
//   largest_share = overall efficiency x max(as.dat) x (largest relative efficiency at any wavelength);
// a drawn photon of wavelength lambda is walked with probability walked_share(lambda) and, on a module,
// kept with what is left of that module's acceptance. Immutable.
class PhotonAcceptance {
 public:
  PhotonAcceptance(const Detector& detector, const ModuleAcceptance& acceptance);

  double largest_share() const { return largest_share_; }
  // Largest relative efficiency of any module at this wavelength, relative to that at any wavelength.
  double walked_share(double wavelength) const;

  // Draws one number from the photon's stream.
  bool accepts(const ModuleCrossing& crossing, const Vec3f& direction, float wavelength,
               RandomStream& random) const;
  // What a module's clock adds to the times of its hits [ns].
  float clock_offset(std::uint32_t module) const { return static_cast<float>(modules_[module].clock_offset); }

 private:
  double relative_efficiency(const Module& module, double wavelength) const;
  double largest_efficiency_at(double wavelength) const;

  std::vector<Module> modules_;
  ModuleAcceptance acceptance_;
  double largest_nominal_ = 0, largest_high_qe_ = 0;  // relative efficiencies, by kind of module
  double largest_ = 0, largest_share_ = 0;
};

}  // namespace floe
