// floe fit-ice: an ice model from flasher data.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <tuple>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/flasher_input.h"
#include "apps/ice_fit_output.h"
#include "apps/improved_ice.h"
#include "apps/option_values.h"
#include "apps/progress_bar.h"
#include "data/base/atomic_folder.h"
#include "data/base/error.h"
#include "reco/ice_fit/layers_apart.h"

namespace floe {

namespace {

constexpr double beyond_flashers = 50;  // as far as the fit's layers go above and below them [m]

struct FitIceCommand {
  std::string data, folder, command;
  ModelRequest model;
  std::vector<std::string> fit{"absorption", "scattering"};
  int layers = 10;
  std::optional<std::string> depths;
  bool layer_by_layer = false;
  std::vector<EffectSetting> start;
  IceFitOptions options;
  SimulationSettings run;
  OutputOptions output;
};

DepthRange depth_range(const FitIceCommand& command, const Detector& detector, const FlasherData& data) {
  const FlasherDepths flashers = flasher_depths(data, detector);
  DepthRange range{flashers.shallowest - beyond_flashers, flashers.deepest + beyond_flashers, command.layers};
  if (!command.depths) return range;
  std::tie(range.top, range.bottom) = parse_depths(*command.depths);
  return range;
}

std::vector<IceParameter> parameters_of(const FitIceCommand& command, const Model& base,
                                        const DepthRange& range) {
  std::vector<IceParameter> parameters;
  for (const std::string& name : command.fit) {
    std::vector<IceParameter> layers;
    if (const auto family = layer_family_of(name))
      layers = layer_parameters(*family, range);
    else if (name == "tilt")
      layers = tilt_parameters(range);
    else
      layers = {effect_parameter(name, base)};
    parameters.insert(parameters.end(), layers.begin(), layers.end());
    const auto same = [&](const IceParameter& p) { return p.name == parameters.back().name; };
    if (std::count_if(parameters.begin(), parameters.end(), same) > 1)
      throw UsageError(fmt::format("--fit: {} is named twice", name));
  }
  return parameters;
}

// Lets fits of effects begin elsewhere than at the model's own values.
void begin_at(const std::vector<EffectSetting>& start, std::vector<IceParameter>& parameters) {
  for (const EffectSetting& setting : start) {
    const std::string text = text_of(setting);
    const auto same = [&](const IceParameter& p) {
      return p.effect && p.effect->effect == setting.effect && p.effect->parameter == setting.parameter;
    };
    const auto found = std::find_if(parameters.begin(), parameters.end(), same);
    if (found == parameters.end())
      throw UsageError(fmt::format(
          "--start {}: it is not fitted; expected a parameter of an effect that --fit names", text));
    if (setting.value < found->low || setting.value > found->high)
      throw UsageError(
          fmt::format("--start {}: expected a value from {:g} to {:g}", text, found->low, found->high));
    found->start = setting.value;
  }
}

// An ice directory holds ice, and nothing else; and a fit needs something to hold on to.
void expect_changes_of_ice(const std::vector<IceParameter>& parameters, const Model& base) {
  std::vector<double> numbers;
  for (const IceParameter& parameter : parameters) numbers.push_back(parameter.start);
  const Model at_start = with_parameters(base, parameters, numbers);
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const IceParameter& parameter = parameters[p];
    if (!parameter.effect) continue;
    std::vector<double> moved = numbers;
    moved[p] += (parameter.start > parameter.low ? -1e-3 : 1e-3) * parameter.scale;
    if (with_parameters(base, parameters, moved).ice->hash() != at_start.ice->hash()) continue;
    throw UsageError(fmt::format(
        "--fit {}: where it starts, at {:g}, it changes nothing of the ice. Begin elsewhere with --start (a "
        "band of "
        "factor 1 has no depth); what belongs to modules or flashers cannot be held by an ice directory",
        parameter.name, parameter.start));
  }
}

void run_fit_ice(const FitIceCommand& command) {
  IceFitOptions options = command.options;
  options.seed = command.run.seed;
  options.threads = command.run.threads;
  AtomicFolder folder(command.folder);
  PlannedOutput json(command.output.json);
  const std::vector<Event> events = read_flasher_file(command.data);
  options.oversize = oversize_for(events, command.run);
  const Model base = load_model(command.model);
  expect_writable(base.ice->tables());
  copy_base_ice(command.model, folder.temporary() / improved_ice_folder);
  FlasherData data = flasher_data(*base.detector, events);
  auto parameters = parameters_of(command, base, depth_range(command, *base.detector, data));
  begin_at(command.start, parameters);
  expect_changes_of_ice(parameters, base);

  IceFit fit;
  {
    ProgressBar bar(command.output.quiet);
    fit = (command.layer_by_layer ? fit_layers_apart : fit_ice)(base, data, parameters, options,
                                                                bar.callback());
  }
  const Model fitted = with_parameters(base, fit.parameters, fit.numbers);
  const IceFitReport report{command.model,   base,         fitted, std::move(fit),
                            command.command, command.data, options};
  write_ice_fit(report, folder.temporary());
  json.write(json_text(ice_fit_json(report)));
  json.commit();
  folder.commit();
  if (command.output.quiet) return;
  fmt::print("{}The new ice model is {}/improved-ice, its stratigraphy {}/stratigraphy.svg\n",
             ice_fit_table(report), command.folder, command.folder);
}

}  // namespace

void add_fit_ice(CLI::App& floe, const std::string& command_line) {
  CLI::App& app = *floe.add_subcommand("fit-ice", "Fit an ice model to flasher data");
  const auto command = std::make_shared<FitIceCommand>();
  command->command = command_line;
  command->run.oversize = command->options.oversize;
  app.add_option("data", command->data, flasher_data_description)->type_name("DATA")->required();
  app.add_option("-o,--output", command->folder, "New folder for the result")->type_name("DIR")->required();
  add_model_options(app, command->model);
  app.add_option_function<std::string>(
         "--fit", [command = command.get()](const std::string& list) { command->fit = split_list(list); },
         "What to fit: absorption, scattering, birefringence (a factor for each layer), tilt (a slope for "
         "each), and parameters of effects of the ice, as floe effects lists them")
      ->type_name("NAME[,NAME]")
      ->default_str("absorption,scattering");
  app.add_option_function<std::string>(
         "--start",
         [command = command.get()](const std::string& list) {
           for (const std::string& text : split_list(list))
             command->start.push_back(parse_effect_setting(text));
         },
         "Where fitted parameters of effects begin. Default: where the model has them")
      ->type_name("EFFECT.PARAMETER=VALUE[,...]");
  add_integer(app, "--layers", 1, 1000, "Layers of equal thickness that the depths are divided into",
              [command = command.get()](std::int64_t layers) { command->layers = static_cast<int>(layers); })
      ->default_str("10");
  app.add_option("--depths", command->depths,
                 "Range of the layers [m]; ice beyond it follows the outermost ones. Default: 50 m beyond "
                 "the flashers")
      ->type_name("TOP,BOTTOM");
  app.add_flag("--layer-by-layer", command->layer_by_layer,
               "Fit each layer to the flashers inside it alone, instead of all layers to all flashers");
  add_number(app, "--light", "RATIO", {0.1, 1000}, "Simulated light, in units of the data's",
             command->options.light.light);
  add_number(app, "--least-hits", "N", {100, 1e8}, "Simulated hits of a run, at least",
             command->options.light.least_hits);
  add_number(app, "--model-error", "SIGMA", {0, 1},
             "Relative error of the simulation that the fit allows for", command->options.model_error);
  add_number(
      app, "--efficiencies", "SIGMA", {0, 1},
      "Fit the relative efficiency of every receiver along, known to so much beforehand; 0: as the model "
      "has them",
      command->options.efficiency_width);
  add_number(app, "--smoothness", "SIGMA", {0.001, 100},
             "Prior: width of ln(ratio) between neighbouring layers", command->options.smoothness);
  add_simulation_options(app, command->run);
  add_output_options(app, command->output);
  app.footer(
      "Examples:\n"
      "  floe fit-ice runs.h5 --ice my-ice -o fitted\n"
      "  floe fit-ice runs.h5 --ice my-ice --fit birefringence,absorption,scattering --layers 10 -o fitted\n"
      "  floe fit-ice runs.hits --ice south-pole --fit absorption-anisotropy.k1,flow-azimuth -o fitted\n"
      "  floe fit-ice runs.h5 --fit flow-azimuth --start flow-azimuth.azimuth=100 -o fitted");
  app.callback([command] { say_why_no_result(command->output.json, [&] { run_fit_ice(*command); }); });
}

}  // namespace floe
