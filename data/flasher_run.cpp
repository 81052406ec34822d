#include "data/flasher_run.h"

#include <fmt/format.h>

#include <charconv>

namespace floe {

namespace {

constexpr int leds_of_a_kind = 6;
constexpr double led_spacing = 60 * degree;

}  // namespace

double LedPattern::elevation() const {
  const bool up = kind == Kind::tilted || (kind == Kind::single && number <= leds_of_a_kind);
  return up ? tilted_led_elevation : horizontal_led_elevation;
}

double LedPattern::azimuth() const {
  return kind == Kind::single ? (number - 1) % leds_of_a_kind * led_spacing : 0;
}

int LedPattern::count() const {
  return kind == Kind::single ? 1 : leds_of_a_kind;
}

std::string name_of(const LedPattern& leds) {
  switch (leds.kind) {
    case LedPattern::Kind::ring:
      return "ring";
    case LedPattern::Kind::horizontal:
      return "horizontal";
    case LedPattern::Kind::tilted:
      return "tilted";
    case LedPattern::Kind::single:
      break;
  }
  return fmt::format("{}", leds.number);
}

std::optional<LedPattern> led_pattern_of(std::string_view name) {
  using Kind = LedPattern::Kind;
  for (const Kind kind : {Kind::ring, Kind::horizontal, Kind::tilted})
    if (const LedPattern leds{kind, 0}; name == name_of(leds)) return leds;
  LedPattern leds{Kind::single, 0};
  std::from_chars(name.data(), name.data() + name.size(), leds.number);
  if (!leds.valid() || name != name_of(leds)) return {};
  return leds;
}

std::string FlasherRunNames::next(ModuleId module) {
  const int run = ++runs_[module];
  const std::string name = fmt::format("{},{}", module.string, module.dom);
  return run == 1 ? name : fmt::format("{}-{}", name, run);
}

}  // namespace floe
