// floe effects: the catalogue of effects, with what each parameter is in a model.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/help_formatter.h"
#include "apps/model_json.h"
#include "apps/planned_output.h"
#include "apps/text_table.h"
#include "propagation/effects/effect.h"

namespace floe {

namespace {

struct EffectsOptions {
  std::string name;  // of one effect; empty: all
  ModelRequest model;
  OutputOptions output;
};

std::vector<const Effect*> chosen_effects(const EffectsOptions& options) {
  if (options.name.empty()) return effects();
  return {&find_effect(options.name)};
}

Json effect_json(const Effect& effect, const ModelParts& model) {
  Json parameters = Json::array();
  for (const EffectParameter& parameter : effect.parameters(model))
    parameters.push_back({{"name", parameter.name},
                          {"unit", parameter.unit},
                          {"description", parameter.description},
                          {"null_value", parameter.null_value},
                          {"low", parameter.low},
                          {"high", parameter.high},
                          {"names_a_place", parameter.names_a_place}});
  return {{"name", effect.name()},
          {"description", effect.description()},
          {"source", effect.source()},
          {"parameters", parameters}};
}

std::string parameter_table(const std::vector<const Effect*>& listed, const ModelParts& model) {
  TextTable table({"effect.parameter", "null", "unit", "range", "description"}, 3);
  for (const Effect* effect : listed)
    for (const EffectParameter& parameter : effect->parameters(model))
      table.add({effect->name() + "." + parameter.name, fmt::format("{:g}", parameter.null_value),
                 parameter.unit, fmt::format("{:g} to {:g}", parameter.low, parameter.high),
                 parameter.description});
  return table.str();
}

void print(const EffectsOptions& options, const std::vector<const Effect*>& listed, const ModelParts& model) {
  if (!options.name.empty()) {
    const Effect& effect = *listed.front();
    fmt::print("{}\n  {}\n  source: {}\n\n", effect.name(), effect.description(), effect.source());
  }
  fmt::print("{}", parameter_table(listed, model));
  if (!options.name.empty()) return;
  fmt::print("\nAt its null values an effect leaves {} as it is. --with EFFECT.PARAMETER=VALUE changes it.\n",
             model_label(options.model));
  fmt::print("{}\n", wrapped(fmt::format("--without switches off: {}", fmt::join(switchable_effects(), ", ")),
                             100, 2));
}

void run_effects(const EffectsOptions& options) {
  const std::vector<const Effect*> listed = chosen_effects(options);
  PlannedOutput json(options.output.json);
  const Model model = load_model(options.model);
  const ModelParts parts = parts_of(model);
  Json list = Json::array();
  for (const Effect* effect : listed) list.push_back(effect_json(*effect, parts));
  json.write(json_text({{"model", to_json(model)}, {"effects", list}}));
  json.commit();
  if (!options.output.quiet) print(options, listed, parts);
}

}  // namespace

void add_effects(CLI::App& floe) {
  CLI::App& app = *floe.add_subcommand("effects", "List what --with can change, with ranges and null values");
  const auto options = std::make_shared<EffectsOptions>();
  app.add_option("NAME", options->name, "Of one effect: say more of it")->type_name("NAME");
  add_model_options(app, options->model);
  add_output_options(app, options->output);
  app.footer(
      "Examples:\n"
      "  floe effects\n"
      "  floe effects birefringence\n"
      "  floe effects --ice my-ice --json effects.json");
  app.callback([options] { run_effects(*options); });
}

}  // namespace floe
