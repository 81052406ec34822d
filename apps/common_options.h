// Options that several subcommands share, so that they mean the same everywhere.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "propagation/model.h"

namespace floe {

// --ice, --ice-version, --detector, --without, --with
void add_model_options(CLI::App& app, ModelRequest& request);
// The same without --ice and --ice-version.
void add_detector_option(CLI::App& app, std::optional<std::string>& detector);
CLI::Option* add_without_option(CLI::App& app, std::vector<std::string>& without);
// An option such as --with, which may be repeated. What is not of the form is a UsageError that names it.
CLI::Option* add_effect_settings(CLI::App& app, const std::string& name, const std::string& description,
                                 std::vector<EffectSetting>& settings);

struct OutputOptions {
  std::optional<std::string> json;  // --json FILE
  bool quiet = false;               // --quiet
};
void add_output_options(CLI::App& app, OutputOptions& options);

struct SimulationSettings {
  std::uint64_t seed = 1;  // --seed
  int threads = 0;         // --threads; 0: all cores
  double oversize = 5;     // --oversize
  bool oversize_given = false;
};
void add_run_options(CLI::App& app, SimulationSettings& settings);         // --seed, --threads
void add_simulation_options(CLI::App& app, SimulationSettings& settings);  // these and --oversize

// "DIR" or "DIR without tilt with birefringence.strength=2": how a model is called in printouts.
std::string model_label(const ModelRequest& request);

}  // namespace floe
