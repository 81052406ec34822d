#include "propagation/effects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "data/base/error.h"
#include "propagation/model.h"

namespace floe {

namespace {

struct Effect {
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

constexpr Effect effects[] = {
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

// Levenshtein's distance: how many letters to insert, delete or replace.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

const Effect& find_effect(std::string_view name) {
  const auto found = std::find_if(std::begin(effects), std::end(effects),
                                  [&](const Effect& effect) { return effect.name == name; });
  if (found != std::end(effects)) return *found;
  auto known = switchable_effects();
  std::stable_sort(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  });
  throw UsageError(fmt::format("no effect '{}' can be switched off; did you mean '{}'? Known: {}", name,
                               known.front(), fmt::join(known, ", ")));
}

}  // namespace

std::vector<std::string> switchable_effects() {
  std::vector<std::string> names;
  for (const Effect& effect : effects) names.emplace_back(effect.name);
  return names;
}

void expect_known_effect(std::string_view effect) {
  find_effect(effect);
}

void switch_off(IceTables& tables, std::string_view effect) {
  find_effect(effect).switch_off(tables);
}

}  // namespace floe
