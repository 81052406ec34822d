// What of an event a fit may use, and what is known about the modules that recorded it.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "data/event.h"

namespace floe {

// Times that are left out: of one module or, without one, of all.
struct TimeWindow {
  std::optional<ModuleId> module;
  double begin = 0, end = 0;  // [ns], begin < end; an end may be infinite
};

struct DataSelection {
  std::vector<ModuleId> bad;            // left out on both sides: data and expectation
  std::vector<TimeWindow> left_out;     // the same for times
  double noise_rate = 0;                // dark noise of one module [1/s]: a known floor under the light
  std::map<ModuleId, double> noise_of;  // modules whose noise differs from that [1/s]
  // Charge of one event at which a module saturates [photoelectrons]. Of a module with at least that
  // much only this is used: that its charge is the cap or more.
  double charge_cap = std::numeric_limits<double>::infinity();

  double noise(ModuleId module) const {
    const auto known = noise_of.find(module);
    return known == noise_of.end() ? noise_rate : known->second;
  }
};

// Throws UsageError: empty windows, negative or endless rates, a cap that is not positive.
void check(const DataSelection& selection);

}  // namespace floe
