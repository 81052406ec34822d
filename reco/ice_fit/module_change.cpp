#include "reco/ice_fit/module_change.h"

namespace floe {

namespace {

bool is_same_light(const Module& a, const Module& b) {
  return a.position == b.position && a.relative_efficiency == b.relative_efficiency &&
         a.high_qe_spectrum == b.high_qe_spectrum && a.on == b.on && a.cable_azimuth == b.cable_azimuth &&
         a.up_axis == b.up_axis;
}

}  // namespace

std::optional<ModuleChange> ModuleChange::between(const Model& was, const Model& is) {
  const auto &before = was.detector->modules(), &after = is.detector->modules();
  Model rest = is;
  rest.detector = was.detector;
  if (before.size() != after.size() || difference(was, rest) != ModelDifference{}) return {};
  ModuleChange change;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool light = !is_same_light(before[i], after[i]);
    change.later.push_back(after[i].clock_offset - before[i].clock_offset);
    change.moved.push_back(before[i].position != after[i].position);
    change.touched.push_back(light || change.later.back() != 0);
    if (light) change.only_clocks = false;
  }
  return change;
}

}  // namespace floe
