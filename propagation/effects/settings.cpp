// What --with says, read and applied.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "data/base/error.h"
#include "data/base/words.h"
#include "propagation/effects/effect.h"

namespace floe {

namespace {

[[noreturn]] void refuse(std::string_view text) {
  throw UsageError(
      fmt::format("found \"{}\"; expected EFFECT.PARAMETER=VALUE, e.g. birefringence.strength=2", text));
}

std::size_t index_of(const std::vector<EffectParameter>& parameters, const EffectSetting& setting) {
  std::vector<std::string> names;
  for (const EffectParameter& parameter : parameters) {
    if (parameter.name == setting.parameter) return names.size();
    names.push_back(parameter.name);
  }
  const auto known = by_likeness(setting.parameter, names);
  throw UsageError(fmt::format("effect '{}' has no parameter '{}'; did you mean '{}'? Known: {}",
                               setting.effect, setting.parameter, known.front(), fmt::join(known, ", ")));
}

void expect_valid(const EffectParameter& parameter, const EffectSetting& setting) {
  const double value = setting.value;
  if (value == parameter.null_value) return;
  const bool whole = !parameter.names_a_place || value == std::floor(value);
  if (whole && parameter.low <= value && value <= parameter.high) return;
  throw UsageError(fmt::format("{}.{}: found {}; expected a {}number from {} to {}{}{}", setting.effect,
                               setting.parameter, value, parameter.names_a_place ? "whole " : "",
                               parameter.low, parameter.high, parameter.unit.empty() ? "" : " ",
                               parameter.unit));
}

// All values of an effect, from those of the settings that are its own.
std::vector<double> values_of(const Effect& effect, std::span<const EffectSetting> settings,
                              const ModelParts& model) {
  const auto parameters = effect.parameters(model);
  std::vector<double> values;
  for (const EffectParameter& parameter : parameters) values.push_back(parameter.null_value);
  std::vector<bool> is_set(parameters.size(), false);
  for (const EffectSetting& setting : settings) {
    if (setting.effect != effect.name()) continue;
    const std::size_t index = index_of(parameters, setting);
    expect_valid(parameters[index], setting);
    if (is_set[index]) throw UsageError(fmt::format("{}.{} is set twice", setting.effect, setting.parameter));
    is_set[index] = true;
    values[index] = setting.value;
  }
  return values;
}

}  // namespace

EffectSetting parse_effect_setting(std::string_view text) {
  const std::size_t equals = text.find('='), dot = text.substr(0, equals).find('.');
  if (equals == text.npos || dot == text.npos) refuse(text);
  EffectSetting setting{std::string(text.substr(0, dot)),
                        std::string(text.substr(dot + 1, equals - dot - 1))};
  if (setting.effect.empty() || setting.parameter.empty()) refuse(text);
  const std::string_view number = text.substr(equals + 1);
  const char* const end = number.data() + number.size();
  const auto result = std::from_chars(number.data(), end, setting.value);
  if (result.ec != std::errc{} || result.ptr != end || !std::isfinite(setting.value))
    throw UsageError(
        fmt::format("{}: found \"{}\"; expected a finite number", text.substr(0, equals), number));
  return setting;
}

std::string text_of(const EffectSetting& setting) {
  return fmt::format("{}.{}={}", setting.effect, setting.parameter, setting.value);
}

std::vector<std::string> texts_of(std::span<const EffectSetting> settings) {
  std::vector<std::string> texts;
  for (const EffectSetting& setting : settings) texts.push_back(text_of(setting));
  return texts;
}

void apply_effects(std::span<const EffectSetting> settings, ModelParts& model) {
  for (const EffectSetting& setting : settings) find_effect(setting.effect);  // before anything changes
  for (const Effect* effect : effects()) {
    const auto is_its_own = [&](const EffectSetting& s) { return s.effect == effect->name(); };
    if (std::any_of(settings.begin(), settings.end(), is_its_own))
      effect->apply(values_of(*effect, settings, model), model);
  }
}

}  // namespace floe
