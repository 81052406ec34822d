// The catalogue of effects. A new one is a line here, with the name of the function that its file defines
// (NAME_effect).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "data/base/error.h"
#include "data/base/words.h"
#include "propagation/effects/effect.h"

// In the order in which help lists them.
#define FLOE_CATALOGUE(EFFECT)  \
  EFFECT(birefringence)         \
  EFFECT(grains)                \
  EFFECT(absorption_anisotropy) \
  EFFECT(scattering_anisotropy) \
  EFFECT(flow_azimuth)          \
  EFFECT(absorption_scale)      \
  EFFECT(scattering_scale)      \
  EFFECT(absorption_layer)      \
  EFFECT(scattering_layer)      \
  EFFECT(tilt)                  \
  EFFECT(scattering_function)   \
  EFFECT(hole_ice)              \
  EFFECT(angular_acceptance)    \
  EFFECT(cable_shadow)          \
  EFFECT(module_efficiency)     \
  EFFECT(string_efficiency)     \
  EFFECT(overall_efficiency)    \
  EFFECT(geometry_offset)       \
  EFFECT(flasher_profile)       \
  EFFECT(time_offset)           \
  EFFECT(flasher_brightness)    \
  EFFECT(noise)

namespace floe {

#define FLOE_DECLARE(name) const Effect& name##_effect();
FLOE_CATALOGUE(FLOE_DECLARE)

const std::vector<const Effect*>& effects() {
#define FLOE_LIST(name) &name##_effect(),
  static const std::vector<const Effect*> all{FLOE_CATALOGUE(FLOE_LIST)};
  return all;
}

const Effect& find_effect(std::string_view name) {
  std::vector<std::string> names;
  for (const Effect* effect : effects()) {
    if (effect->name() == name) return *effect;
    names.push_back(effect->name());
  }
  const auto known = by_likeness(name, names);
  throw UsageError(fmt::format("no effect '{}'; did you mean '{}'? Known: {}", name, known.front(),
                               fmt::join(known, ", ")));
}

}  // namespace floe
