#include "reco/ice_fit/acceptance_slopes.h"

#include <algorithm>
#include <cmath>

namespace floe {

namespace {

bool same_but_for_efficiency(const Module& a, const Module& b) {
  return a.id == b.id && a.position == b.position && a.high_qe_spectrum == b.high_qe_spectrum &&
         a.on == b.on && a.cable_azimuth == b.cable_azimuth && a.up_axis == b.up_axis &&
         a.clock_offset == b.clock_offset;
}

double accepted(const AngularAcceptance& acceptance, const SimulatedHit& hit, const Module& module) {
  return acceptance.maximum() *
         acceptance.probability(hit.direction.cast<double>(), hit.inward.cast<double>(), module.up_axis);
}

}  // namespace

AcceptanceChange::AcceptanceChange(const Model& was, const Model& is)
    : detector_(was.detector), was_(was.acceptance.angular), is_(is.acceptance.angular) {
  for (std::size_t i = 0; i < detector_->size(); ++i)
    efficiency_.push_back(std::log(is.detector->modules()[i].relative_efficiency /
                                   was.detector->modules()[i].relative_efficiency));
}

std::optional<AcceptanceChange> AcceptanceChange::between(const Model& was, const Model& is) {
  const auto &a = was.detector->modules(), &b = is.detector->modules();
  Model rest = is;
  rest.detector = was.detector;
  rest.acceptance.angular = was.acceptance.angular;
  const bool alike = difference(was, rest) == ModelDifference{} &&
                     was.acceptance.angular.is_surface() == is.acceptance.angular.is_surface() &&
                     std::ranges::equal(a, b, same_but_for_efficiency);
  if (!alike) return {};
  return AcceptanceChange(was, is);
}

double AcceptanceChange::ln_ratio(const SimulatedHit& hit) const {
  constexpr double least = 1e-6;
  const Module& module = detector_->modules()[hit.module];
  const double is = std::max(least, accepted(is_, hit, module)),
               was = std::max(least, accepted(was_, hit, module));
  return efficiency_[hit.module] + std::log(is / was);
}

}  // namespace floe
