#include "reco/data_selection.h"

#include <cmath>
#include <string>

#include "data/base/error.h"

namespace floe {

void check(const DataSelection& selection) {
  const auto need = [](bool valid, const std::string& what) {
    if (!valid) throw UsageError("data selection: " + what);
  };
  const auto rate = [](double value) { return value >= 0 && value <= 1e6; };
  need(rate(selection.noise_rate), "noise rate must be 0 to 1e6 per second");
  for (const auto& [module, value] : selection.noise_of)
    need(rate(value), "noise rate of module " + std::to_string(module.string) + "," +
                          std::to_string(module.dom) + " must be 0 to 1e6 per second");
  for (const TimeWindow& window : selection.left_out)
    need(window.begin < window.end, "a time window must begin before it ends");
  need(selection.charge_cap > 0, "the charge cap must be above 0");
}

}  // namespace floe
