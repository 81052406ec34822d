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

void add_model_options(CLI::App& app, ModelRequest& request) {
  app.add_option("--ice", request.ice, "Ice-model directory, or south-pole (built in, idealised)")
      ->type_name("DIR|south-pole")
      ->capture_default_str();
  add_integer(app, "--ice-version", 0, 1000, "Read the ice directory as this version, whatever it says",
              [&request](std::int64_t version) { request.ice_version = static_cast<int>(version); });
  add_detector_option(app, request.detector);
  add_without_option(app, request.without);
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
             settings.oversize);
}

std::string model_label(const ModelRequest& request) {
  if (request.without.empty()) return request.ice;
  return fmt::format("{} without {}", request.ice, fmt::join(request.without, ", "));
}

}  // namespace floe
