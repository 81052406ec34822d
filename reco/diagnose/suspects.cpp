#include "reco/diagnose/suspects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "data/base/error.h"
#include "propagation/effects/effect.h"
#include "reco/diagnose/place_columns.h"

namespace floe {

namespace {

constexpr double beyond_flashers = 150;  // light of a flasher tells little of ice further above or below [m]
constexpr double thickness = 20;         // of the layers that bands are made of [m]
constexpr double displaced_strings_at_most = 6;  // [m]
constexpr double late_strings_at_most = 60;      // [ns]
constexpr double widest_band = 160;              // [m]; wider ones are no bands

using Kind = SurveyColumn::Kind;

// All but what brightness and time zero of each run take up, and what layers, bands and places say. The size
// of grains is the strength of birefringence by another name.
bool is_plain(const std::string& effect) {
  static const std::vector<std::string> others{"overall-efficiency",
                                               "flasher-brightness",
                                               "time-offset",
                                               "absorption-layer",
                                               "scattering-layer",
                                               "module-efficiency",
                                               "string-efficiency",
                                               "geometry-offset",
                                               "tilt",
                                               "grains"};
  return std::find(others.begin(), others.end(), effect) == others.end();
}

// Why a parameter changes nothing, or nothing if it does change something: the scattering length of hole ice
// does not where there is none. Steps that lead to no physical ice tell only if all do.
std::optional<std::string> why_idle(const Model& model, const IceParameter& parameter) {
  std::string why;
  for (const double share : {0.1, -0.1, 0.01, -0.01}) {
    const double number = parameter.start + share * parameter.scale;
    if (number < parameter.low || number > parameter.high) continue;
    try {
      const Model moved = with_parameters(model, {parameter}, {number});
      if (difference(model, moved) != ModelDifference{}) return std::nullopt;
      return "it changes nothing in this model";
    } catch (const std::exception& error) {
      if (why.empty()) why = error.what();  // it makes no sense in this model
    }
  }
  return why;
}

bool is_hidden_by_width(const std::string& effect, double oversize) {
  return effect == "hole-ice" && oversize > 1;
}

// A parameter of an effect at a place that says how much it changes.
struct Changing {
  const char* name;
  Kind kind;
};
std::vector<Changing> changing(const std::string& effect) {
  if (effect == "geometry-offset")
    return {{"x", Kind::string_x}, {"y", Kind::string_y}, {"z", Kind::string_z}};
  if (effect == "time-offset") return {{"time", Kind::string_time}};
  return {{"factor", effect == "module-efficiency" ? Kind::module_efficiency : Kind::string_efficiency}};
}

// A parameter of an effect at a place.
IceParameter parameter_at_place(const Changing& changing, const Suspect& suspect, const Model& base) {
  const std::string &effect = suspect.effect, name = changing.name;
  const auto all = find_effect(effect).parameters(parts_of(base));
  std::vector<double> values;
  std::size_t index = 0;
  for (const EffectParameter& p : all) {
    const auto place = suspect.place.find(p.name);
    if (p.name == name) index = values.size();
    values.push_back(place != suspect.place.end() ? place->second : p.null_value);
  }
  IceParameter parameter;
  parameter.name = effect + "." + name;
  parameter.unit = all[index].unit;
  parameter.start = all[index].null_value;
  parameter.low = all[index].low;
  parameter.high = all[index].high;
  parameter.scale = large_change(changing.kind);
  parameter.place = text_of(suspect);
  parameter.apply = [effect, values, index](double number, ModelParts& model) {
    std::vector<double> at = values;
    at[index] = number;
    find_effect(effect).apply(at, model);
  };
  return parameter;
}

double within(const IceParameter& parameter, double number, double longest) {
  number = std::clamp(number, parameter.start - longest, parameter.start + longest);
  return parameter.within(number);
}
double within(const IceParameter& parameter, double number) {
  return within(parameter, number, 2 * parameter.scale);
}

void add_bands(const SuspectPlan& plan, const char* effect, int first, std::vector<Suspect>& suspects) {
  const BandGrid& grid = plan.bands;
  // Rows beyond follow the outermost layers, which are no bands therefore.
  for (int i = 1; i < grid.groups - 1; ++i)
    for (int k = i; k < grid.groups - 1 && (k - i + 1) * grid.step <= widest_band; ++k) {
      Suspect band;
      band.effect = effect;
      band.place = {{"depth", grid.top + (i + k + 1) / 2.0 * grid.step}, {"width", (k - i + 1) * grid.step}};
      band.amplitudes.resize(1);
      for (int group = i; group <= k; ++group) band.amplitudes[0].emplace_back(first + group, 1.0);
      suspects.push_back(std::move(band));
    }
}

}  // namespace

bool is_same_place(const Place& a, const Place& b) {
  const auto depth = a.find("depth");
  if (depth == a.end() || !b.count("depth")) return a == b;
  return std::abs(depth->second - b.at("depth")) < (a.at("width") + b.at("width")) / 2;
}

DepthRange layers_of(const FlasherDepths& depths, int flashers) {
  constexpr double beyond = 50;  // the outermost flashers [m]
  constexpr int most = 10;
  return {depths.shallowest - beyond, depths.deepest + beyond, std::min(most, flashers)};
}
DepthRange slopes_of(const FlasherDepths& depths, int flashers) {
  constexpr int flashers_a_slope = 2;
  return layers_of(depths, std::max(1, flashers / flashers_a_slope));
}

SuspectPlan plan_suspects(const Model& model, const FlasherDepths& depths, int flashers, double oversize) {
  SuspectPlan plan;
  for (const Effect* effect : effects()) {
    if (!is_plain(effect->name()) || is_hidden_by_width(effect->name(), oversize)) continue;
    for (const EffectParameter& parameter : effect->parameters(parts_of(model))) {
      IceParameter p = effect_parameter(effect->name() + "." + parameter.name, model);
      if (!why_idle(model, p)) plan.parameters.push_back(std::move(p));
    }
  }
  // Ice of other ages follows the bed below in its own way: it has its slope at each depth (arXiv:1301.5361).
  plan.first_tilt = static_cast<int>(plan.parameters.size());
  plan.tilt = slopes_of(depths, flashers);
  for (IceParameter& p : tilt_parameters(plan.tilt)) plan.parameters.push_back(std::move(p));
  const auto& layers = model.ice->tables().layers;
  DepthRange range{std::max(depths.shallowest - beyond_flashers, layers.front().depth),
                   std::min(depths.deepest + beyond_flashers, layers.back().depth), 1};
  range.groups = std::max(1, static_cast<int>((range.bottom - range.top) / thickness));
  plan.bands = {range.top, (range.bottom - range.top) / range.groups, range.groups};
  plan.first_layer = static_cast<int>(plan.parameters.size());
  for (const LayerFamily family : {LayerFamily::absorption, LayerFamily::scattering})
    for (IceParameter& p : layer_parameters(family, range)) plan.parameters.push_back(std::move(p));
  return plan;
}

namespace {

// Of effects at a place, that no place was tried.
std::optional<std::string> why_nowhere(const std::string& effect) {
  if (effect.ends_with("-layer"))
    return fmt::format("no band fits in the ice's table within {} m of the flashers", beyond_flashers);
  if (effect == "module-efficiency")
    return fmt::format("no module sees {} counts in these runs together", light_of_module);
  if (effect == "string-efficiency" || effect == "geometry-offset" || effect == "time-offset")
    return fmt::format("no string sees {} counts in these runs together", light_of_string);
  return std::nullopt;
}

}  // namespace

std::string why_no_suspect(const std::string& effect, const Model& model, double oversize) {
  if (is_hidden_by_width(effect, oversize))
    return "modules that are simulated wider do not see it; --oversize 1 does";
  if (effect == "grains") return "the size of grains is the strength of birefringence by another name";
  if (effect == "overall-efficiency" || effect == "flasher-brightness")
    return "the brightness of each run takes it up";
  if (auto why = why_nowhere(effect)) return *why;
  if (is_plain(effect))
    for (const EffectParameter& parameter : find_effect(effect).parameters(parts_of(model)))
      if (auto why = why_idle(model, effect_parameter(effect + "." + parameter.name, model))) return *why;
  return "it changes no light of these runs that their brightness and time zero do not take up";
}

std::vector<Suspect> suspects_of(const Survey& survey, const SuspectPlan& plan) {
  std::vector<Suspect> suspects;
  for (int p = 0; p < plan.first_tilt; ++p) {
    const std::string& effect = plan.parameters[static_cast<std::size_t>(p)].effect->effect;
    if (suspects.empty() || suspects.back().effect != effect) suspects.push_back({effect, {}, {}});
    suspects.back().amplitudes.push_back({{p, 1.0}});
  }
  suspects.emplace_back().effect = "tilt";
  suspects.back().layers = plan.tilt;
  for (int p = plan.first_tilt; p < plan.first_layer; ++p) suspects.back().amplitudes.push_back({{p, 1.0}});
  add_bands(plan, "absorption-layer", plan.first_layer, suspects);
  add_bands(plan, "scattering-layer", plan.first_layer + plan.bands.groups, suspects);
  for (std::size_t c = 0; c < survey.columns.size(); ++c) {
    const SurveyColumn& column = survey.columns[c];
    const auto index = static_cast<int>(c);
    const auto string = static_cast<double>(column.string);
    if (column.kind == Kind::string_efficiency)
      suspects.push_back({"string-efficiency", {{"string", string}}, {{{index, 1.0}}}});
    else if (column.kind == Kind::string_time)
      suspects.push_back({"time-offset", {{"string", string}}, {{{index, 1.0}}}, late_strings_at_most});
    else if (column.kind == Kind::module_efficiency)
      suspects.push_back({"module-efficiency",
                          {{"string", string}, {"dom", static_cast<double>(column.dom)}},
                          {{{index, 1.0}}}});
    else if (column.kind == Kind::string_x)
      suspects.push_back({"geometry-offset",
                          {{"string", string}},
                          {{{index, 1.0}}, {{index + 1, 1.0}}, {{index + 2, 1.0}}},
                          displaced_strings_at_most});
  }
  return suspects;
}

namespace {

std::vector<IceParameter> parameters_from(const Suspect& suspect, const Eigen::VectorXd& amplitudes,
                                          const Model& base) {
  std::vector<IceParameter> parameters;
  if (suspect.place.count("depth")) {
    for (const char* name : {"depth", "width", "factor"})
      parameters.push_back(effect_parameter(suspect.effect + "." + name, base));
    parameters[0].start = suspect.place.at("depth");
    // Within one layer of the table, width and factor are the same.
    parameters[1].low = base.ice->layer_step();
    parameters[1].start = std::max(parameters[1].low, suspect.place.at("width"));
    parameters[2].start = std::clamp(std::exp(amplitudes(0)), 0.4, 2.5);
    // The score has looked so far about its place: an edge beyond the light is no further away.
    for (IceParameter& p : parameters)
      if (is_place_of_band(p)) p.prior = widest_band / 2, p.prior_centre = p.start;
  } else if (suspect.place.count("string")) {
    Eigen::Index i = 0;
    for (const Changing& change : changing(suspect.effect)) {
      IceParameter p = parameter_at_place(change, suspect, base);
      // Of what no light shows, noise would make much: a string that moves across the line to the only
      // flasher that it sees.
      if (std::isfinite(suspect.largest)) p.prior = suspect.largest, p.prior_centre = p.start;
      p.start = within(p, p.start + amplitudes(i++), std::min(suspect.largest, 10 * p.scale));
      parameters.push_back(std::move(p));
    }
  } else if (suspect.layers) {
    parameters = tilt_parameters(*suspect.layers);
    for (std::size_t i = 0; i < parameters.size(); ++i)
      parameters[i].begin_at(within(parameters[i], amplitudes(static_cast<Eigen::Index>(i))));
  } else {
    Eigen::Index i = 0;
    for (const EffectParameter& parameter : find_effect(suspect.effect).parameters(parts_of(base))) {
      IceParameter p = effect_parameter(suspect.effect + "." + parameter.name, base);
      if (why_idle(base, p)) continue;
      p.start = within(p, p.start + amplitudes(i++));
      parameters.push_back(std::move(p));
    }
  }
  return parameters;
}

// Crystals as strong as a first guess may scatter more than a clear layer does.
void begin_where_ice_can_be(std::vector<IceParameter>& parameters, const Model& base) {
  constexpr int most_halvings = 6;
  for (int i = 0;; ++i) try {
      std::vector<double> numbers;
      for (const IceParameter& p : parameters) numbers.push_back(p.start);
      with_parameters(base, parameters, numbers);
      return;
    } catch (const InputError&) {
      if (i == most_halvings) throw;
      for (IceParameter& p : parameters)
        if (!is_place_of_band(p)) p.begin_at((p.start + null_number(p, base)) / 2);
    }
}

}  // namespace

std::vector<IceParameter> fit_parameters(const Suspect& suspect, const Eigen::VectorXd& amplitudes,
                                         const Model& base) {
  std::vector<IceParameter> parameters = parameters_from(suspect, amplitudes, base);
  begin_where_ice_can_be(parameters, base);
  return parameters;
}

std::vector<IceParameter> changing_parameters(const Suspect& suspect, const Model& base) {
  const auto none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(suspect.amplitudes.size()));
  std::vector<IceParameter> parameters = fit_parameters(suspect, none, base);
  std::erase_if(parameters, is_place_of_band);
  return parameters;
}

double large_change(Kind kind) {
  switch (kind) {
    case Kind::string_time:
      return 10;
    case Kind::string_x:
    case Kind::string_y:
    case Kind::string_z:
      return 5;
    case Kind::parameter:
    case Kind::string_efficiency:
    case Kind::module_efficiency:
      break;
  }
  return 0.3;
}

double null_number(const IceParameter& parameter, const Model& base) {
  if (!parameter.family.empty()) return 0;  // factor 1, slope 0
  const std::size_t dot = parameter.name.find('.');
  for (const EffectParameter& p : find_effect(parameter.name.substr(0, dot)).parameters(parts_of(base)))
    if (p.name == parameter.name.substr(dot + 1)) return p.null_value;
  throw std::logic_error(parameter.name + " is no parameter of an effect");
}

bool is_place_of_band(const IceParameter& parameter) {
  return parameter.name.ends_with("-layer.depth") || parameter.name.ends_with("-layer.width");
}

std::string text_of(const Suspect& suspect) {
  const auto& place = suspect.place;
  if (const auto depth = place.find("depth"); depth != place.end()) {
    const double half = place.at("width") / 2;
    return fmt::format("{} at {:.0f}-{:.0f} m", suspect.effect, depth->second - half, depth->second + half);
  }
  if (const auto dom = place.find("dom"); dom != place.end())
    return fmt::format("{} of {:.0f},{:.0f}", suspect.effect, place.at("string"), dom->second);
  if (const auto string = place.find("string"); string != place.end())
    return fmt::format("{} of string {:.0f}", suspect.effect, string->second);
  return suspect.effect;
}

}  // namespace floe
