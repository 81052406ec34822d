#include "reco/ice_fit/ice_parameter.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "data/base/error.h"
#include "propagation/effects/rising_layers.h"
#include "propagation/effects/row_scaling.h"

namespace floe {

namespace {

constexpr double large_change = 0.04;  // of the range of an effect's parameter, where it does not say itself

struct FamilyTraits {
  const char* name;
  double least, most;  // factors
  void (*scale)(const IceTables& ice, IceLayerRow& row, double factor);
};

// In the order of LayerFamily.
const FamilyTraits families[] = {
    {"absorption", 0.1, 10, scale_absorption},
    {"scattering", 0.1, 10,
     [](const IceTables&, IceLayerRow& row, double factor) { scale_scattering(row, factor); }},
    {"birefringence", 0.02, 20,
     [](const IceTables&, IceLayerRow& row, double factor) { row.birefringence_strength *= factor; }}};

const FamilyTraits& traits_of(LayerFamily family) {
  return families[static_cast<int>(family)];
}

// A factor of this family without what it applies to.
IceParameter factor_of(const FamilyTraits& traits, double depth) {
  IceParameter parameter;
  parameter.family = traits.name;
  parameter.depth = depth;
  parameter.logarithmic = true;
  parameter.low = std::log(traits.least);
  parameter.high = std::log(traits.most);
  return parameter;
}

double thickness_of_group(const DepthRange& range) {
  return (range.bottom - range.top) / range.groups;
}
double middle_of_group(int group, const DepthRange& range) {
  return range.top + (group + 0.5) * thickness_of_group(range);
}
int group_of(double depth, const DepthRange& range) {
  const double share = (depth - range.top) / thickness_of_group(range);
  return std::clamp(static_cast<int>(std::floor(share)), 0, range.groups - 1);
}

// 1 in the middle of a group, 0 in the middle of all others, linear in between; the outermost go on.
double share_of_group(int group, double depth, const DepthRange& range) {
  const double middle = middle_of_group(0, range);
  const double at =
      std::clamp((depth - middle) / thickness_of_group(range), 0.0, static_cast<double>(range.groups - 1));
  return std::max(0.0, 1 - std::abs(at - group));
}

}  // namespace

std::vector<IceParameter> layer_parameters(LayerFamily family, const DepthRange& range) {
  const FamilyTraits& traits = traits_of(family);
  std::vector<IceParameter> parameters;
  for (int group = 0; group < range.groups; ++group) {
    const double depth = middle_of_group(group, range);
    IceParameter parameter = factor_of(traits, depth);
    parameter.name = fmt::format("{} {:.0f} m", traits.name, depth);
    parameter.apply = [&traits, range, group, family](double number, ModelParts& model) {
      auto& numbers = model.ice.configuration.birefringence;
      if (family == LayerFamily::birefringence && !numbers) numbers = published_birefringence();
      for (IceLayerRow& row : model.ice.layers)
        if (group_of(row.depth, range) == group) traits.scale(model.ice, row, std::exp(number));
    };
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

double IceParameter::within(double number) const {
  return std::clamp(number, low, high);
}

void IceParameter::begin_at(double number) {
  if (!prior_centre) prior_centre = start;
  start = number;
}

std::vector<IceParameter> tilt_parameters(const DepthRange& range) {
  // Published slopes stay within 50 m/km (arXiv:2307.13951); light follows a change to first order as far as
  // dust layers are thick: 10 m at 300 m.
  constexpr double usual = 30, most = 300;
  std::vector<IceParameter> parameters;
  for (int group = 0; group < range.groups; ++group) {
    IceParameter parameter;
    parameter.family = "tilt";
    parameter.unit = "m/km";
    parameter.depth = middle_of_group(group, range);
    parameter.name = fmt::format("tilt {:.0f} m", parameter.depth);
    parameter.low = -most, parameter.high = most;
    parameter.scale = usual;
    parameter.apply = [range, group](double number, ModelParts& model) {
      if (number == 0) return;
      add_rise([&](double depth) { return number * share_of_group(group, depth, range); }, model);
    };
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

std::optional<LayerFamily> layer_family_of(std::string_view name) {
  const auto found = std::find_if(std::begin(families), std::end(families),
                                  [&](const FamilyTraits& traits) { return name == traits.name; });
  if (found == std::end(families)) return {};
  return static_cast<LayerFamily>(found - std::begin(families));
}

IceParameter layer_factor(LayerFamily family, double top, double bottom, const Model& base) {
  const FamilyTraits& traits = traits_of(family);
  const auto inside = [top, bottom](const IceLayerRow& row) {
    return row.depth >= top && row.depth <= bottom;
  };
  const IceTables& tables = base.ice->tables();
  if (std::none_of(tables.layers.begin(), tables.layers.end(), inside))
    throw UsageError(fmt::format("{}: the layer table of {} has no row from {:g} to {:g} m", traits.name,
                                 base.ice->name(), top, bottom));
  if (family == LayerFamily::birefringence && !tables.configuration.birefringence)
    throw UsageError(
        fmt::format("birefringence: {} has none that a factor could change; expected "
                    "birefringence.strength, or ice with birefringence",
                    base.ice->name()));
  IceParameter parameter = factor_of(traits, (top + bottom) / 2);
  parameter.name = fmt::format("{} {:g}-{:g} m", traits.name, top, bottom);
  parameter.apply = [&traits, inside](double number, ModelParts& model) {
    for (IceLayerRow& row : model.ice.layers)
      if (inside(row)) traits.scale(model.ice, row, std::exp(number));
  };
  return parameter;
}

IceParameter effect_parameter(std::string_view name, const Model& base) {
  const std::size_t dot = name.find('.');
  const Effect& effect = find_effect(name.substr(0, dot));
  const std::vector<EffectParameter> parameters = effect.parameters(parts_of(base));
  std::vector<std::string> known;
  for (const EffectParameter& parameter : parameters)
    if (!parameter.names_a_place) known.push_back(parameter.name);
  const std::string wanted = dot != name.npos    ? std::string(name.substr(dot + 1))
                             : known.size() == 1 ? known[0]
                                                 : "";
  const bool fits = std::find(known.begin(), known.end(), wanted) != known.end();
  if (!fits || known.size() != parameters.size())
    throw UsageError(fmt::format(
        "\"{}\" is nothing that can be fitted; of the effect {} {}", name, effect.name(),
        known.size() != parameters.size() ? std::string("each module or string would be a fit of its own")
                                          : fmt::format("expected one of {}", fmt::join(known, ", "))));
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const EffectParameter& p) { return p.name == wanted; });
  IceParameter parameter;
  parameter.name = fmt::format("{}.{}", effect.name(), wanted);
  parameter.unit = found->unit;
  parameter.start = found->null_value;
  parameter.low = found->low;
  parameter.high = found->high;
  parameter.scale = found->large_change > 0 ? found->large_change : (found->high - found->low) * large_change;
  parameter.effect = EffectSetting{effect.name(), wanted, 0};
  return parameter;
}

namespace {

bool sets(const std::vector<EffectSetting>& settings, const EffectSetting& one) {
  return std::ranges::any_of(settings, [&](const EffectSetting& setting) {
    return setting.effect == one.effect && setting.parameter == one.parameter;
  });
}

}  // namespace

Model with_parameters(const Model& base, const std::vector<IceParameter>& parameters,
                      const std::vector<double>& numbers) {
  ModelParts parts = parts_of(base);
  std::vector<EffectSetting> settings;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].apply) parameters[i].apply(numbers[i], parts);
    if (!parameters[i].effect) continue;
    // A parameter that comes again is that of another place, a second band.
    if (sets(settings, *parameters[i].effect)) {
      apply_effects(settings, parts);
      settings.clear();
    }
    settings.push_back(*parameters[i].effect);
    settings.back().value = numbers[i];
  }
  apply_effects(settings, parts);
  return freeze(std::move(parts));
}

}  // namespace floe
