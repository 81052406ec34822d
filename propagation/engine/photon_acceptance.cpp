#include "propagation/engine/photon_acceptance.h"

#include <algorithm>

#include "data/base/error.h"

namespace floe {

PhotonAcceptance::PhotonAcceptance(const Detector& detector, const ModuleAcceptance& acceptance)
    : modules_(detector.modules()), acceptance_(acceptance) {
  for (const Module& module : modules_) {
    if (!module.on) continue;
    const bool by_spectrum = module.high_qe_spectrum && acceptance_.high_qe;
    double& largest = by_spectrum ? largest_high_qe_ : largest_nominal_;
    largest = std::max(largest, module.relative_efficiency);
  }
  largest_ = std::max(largest_nominal_,
                      largest_high_qe_ * (acceptance_.high_qe ? acceptance_.high_qe->maximum() : 1.0));
  if (!(largest_ > 0))
    throw InputError("every module of detector '" + detector.name() +
                     "' is switched off; switch some on (hvs-f2k) to see light");
  largest_share_ = acceptance_.overall_efficiency * acceptance_.angular.maximum() * largest_;
}

double PhotonAcceptance::relative_efficiency(const Module& module, double wavelength) const {
  const bool by_spectrum = module.high_qe_spectrum && acceptance_.high_qe;
  return module.relative_efficiency * (by_spectrum ? (*acceptance_.high_qe)(wavelength) : 1.0);
}

double PhotonAcceptance::largest_efficiency_at(double wavelength) const {
  const double high_qe = acceptance_.high_qe ? largest_high_qe_ * (*acceptance_.high_qe)(wavelength) : 0.0;
  return std::max(largest_nominal_, high_qe);
}

double PhotonAcceptance::walked_share(double wavelength) const {
  return largest_efficiency_at(wavelength) / largest_;
}

bool PhotonAcceptance::accepts(const ModuleCrossing& crossing, const Vec3f& direction, float wavelength,
                               RandomStream& random) const {
  const Module& module = modules_[crossing.module];
  const float u = random.uniform();
  if (!module.on) return false;
  const Vec3 travel = direction.cast<double>(), inward = crossing.inward.cast<double>();
  const double kept = relative_efficiency(module, wavelength) / largest_efficiency_at(wavelength) *
                      acceptance_.angular.probability(travel, inward, module.up_axis);
  if (!(u < kept)) return false;
  return !module.cable_azimuth || acceptance_.cable_radius == 0 ||
         !cable_shadows(*module.cable_azimuth, travel, inward, acceptance_.cable_radius);
}

}  // namespace floe
