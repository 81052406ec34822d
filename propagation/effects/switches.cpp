#include "propagation/effects/switches.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "data/base/error.h"
#include "data/base/words.h"
#include "propagation/model.h"

namespace floe {

namespace {

struct Switch {
  std::string_view name;
  void (*switch_off)(IceTables&);
};

template <bool BirefringenceNumbers::*part>
void switch_off_part(IceTables& tables) {
  if (auto& birefringence = tables.configuration.birefringence) *birefringence.*part = false;
}

void switch_off_absorption_anisotropy(IceTables& tables) {
  tables.configuration.absorption_anisotropy.reset();
  tables.configuration.old_absorption_scaling = 0;
}

void switch_off_scattering_anisotropy(IceTables& tables) {
  tables.configuration.k1 = tables.configuration.k2 = 0;
  for (auto& row : tables.layers) row.k1 = row.k2 = 0;
}

void switch_off_tilt(IceTables& tables) {
  tables.tilt_lines.reset();
  tables.tilt_map.reset();
}

constexpr Switch switches[] = {
    {"birefringence", [](IceTables& tables) { tables.configuration.birefringence.reset(); }},
    {"birefringence.diffusion", switch_off_part<&BirefringenceNumbers::diffusion>},
    {"birefringence.deflection", switch_off_part<&BirefringenceNumbers::deflection>},
    {"birefringence.displacement", switch_off_part<&BirefringenceNumbers::displacement>},
    {"absorption-anisotropy", switch_off_absorption_anisotropy},
    {"scattering-anisotropy", switch_off_scattering_anisotropy},
    {"tilt", switch_off_tilt},
    {"hole-ice", [](IceTables& tables) { tables.configuration.hole_ice.radius = 0; }},
    {"cable-shadow", [](IceTables&) {}},
    {"bubbles", [](IceTables& tables) { tables.bubbles.reset(); }},
};

const Switch& find_switch(std::string_view name) {
  const auto found = std::find_if(std::begin(switches), std::end(switches),
                                  [&](const Switch& effect) { return effect.name == name; });
  if (found != std::end(switches)) return *found;
  const auto known = by_likeness(name, switchable_effects());
  throw UsageError(fmt::format("no effect '{}' can be switched off; did you mean '{}'? Known: {}", name,
                               known.front(), fmt::join(known, ", ")));
}

}  // namespace

std::vector<std::string> switchable_effects() {
  std::vector<std::string> names;
  for (const Switch& effect : switches) names.emplace_back(effect.name);
  return names;
}

void expect_known_effect(std::string_view effect) {
  find_switch(effect);
}

void switch_off(IceTables& tables, std::string_view effect) {
  find_switch(effect).switch_off(tables);
}

}  // namespace floe
