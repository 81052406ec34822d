#include "apps/common_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

#include "apps/option_values.h"
#include "data/base/error.h"

namespace floe {

void add_detector_option(CLI::App& app, std::optional<std::string>& detector) {
  app.add_option("--detector", detector,
                 "geo-f2k file, directory with one, or ic86 (built in, idealised); default: of the ice")
      ->type_name("FILE|ic86");
}

CLI::Option* add_without_option(CLI::App& app, std::vector<std::string>& without) {
  return app
      .add_option_function<std::string>(
          "--without", [&without](const std::string& list) { without = split_list(list); },
          fmt::format("Switch effects off: {}", fmt::join(switchable_effects(), ", ")))
      ->type_name("EFFECT[,EFFECT]");
}

CLI::Option* add_effect_settings(CLI::App& app, const std::string& name, const std::string& description,
                                 std::vector<EffectSetting>& settings) {
  const auto read = [name, &settings](const std::vector<std::string>& lists) {
    for (const std::string& list : lists)
      for (const std::string& text : split_list(list)) try {
          settings.push_back(parse_effect_setting(text));
        } catch (const UsageError& error) {
          throw UsageError(name + ": " + error.what());
        }
  };
  return app.add_option_function<std::vector<std::string>>(name, read, description)
      ->type_name("EFFECT.PARAMETER=VALUE[,...]")
      ->allow_extra_args(false);
}

void add_model_options(CLI::App& app, ModelRequest& request) {
  app.add_option("--ice", request.ice, "Ice-model directory, or south-pole (built in, idealised)")
      ->type_name("DIR|south-pole")
      ->capture_default_str();
  add_integer(app, "--ice-version", 0, 1000, "Read the ice directory as this version, whatever it says",
              [&request](std::int64_t version) { request.ice_version = static_cast<int>(version); });
  add_detector_option(app, request.detector);
  add_without_option(app, request.without);
  add_effect_settings(app, "--with", "Change the model, after --without; floe effects lists what there is",
                      request.with);
}

void add_output_options(CLI::App& app, OutputOptions& options) {
  app.add_option("--json", options.json, "Write the results to this file, too")->type_name("FILE");
  app.add_flag("--quiet", options.quiet, "Print nothing but warnings and errors");
}

void add_run_options(CLI::App& app, SimulationSettings& settings) {
  add_integer(app, "--seed", 0, std::numeric_limits<std::int64_t>::max(),
              "Of the random numbers; the same seed gives the same result",
              [&settings](std::int64_t seed) { settings.seed = static_cast<std::uint64_t>(seed); })
      ->default_str("1");
  add_integer(app, "--threads", 1, 4096, "Cores to use, default all; the result does not depend on it",
              [&settings](std::int64_t threads) { settings.threads = static_cast<int>(threads); });
}

void add_simulation_options(CLI::App& app, SimulationSettings& settings) {
  add_run_options(app, settings);
  add_number(app, "--oversize", "X", {1, 100}, "Modules are simulated X times wider, with 1/X^2 of the light",
             settings.oversize)
      ->each([&settings](const std::string&) { settings.oversize_given = true; });
}

std::string model_label(const ModelRequest& request) {
  std::string label = request.ice;
  if (!request.without.empty()) label += fmt::format(" without {}", fmt::join(request.without, ", "));
  if (!request.with.empty()) label += fmt::format(" with {}", fmt::join(texts_of(request.with), ", "));
  return label;
}

}  // namespace floe
