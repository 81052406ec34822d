// The subcommands of floe. A new one is a file with a function add_NAME, declared here and called in
// floe.cpp. `command_line` is what was typed; it goes into output files.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace floe {

void add_info(CLI::App& floe);
void add_effects(CLI::App& floe);
void add_simulate(CLI::App& floe, const std::string& command_line);
void add_respond(CLI::App& floe, const std::string& command_line);
void add_reconstruct(CLI::App& floe);
void add_compare(CLI::App& floe);
void add_study(CLI::App& floe);
void add_fit_ice(CLI::App& floe, const std::string& command_line);
void add_diagnose(CLI::App& floe, const std::string& command_line);
void add_blind_trials(CLI::App& floe);
void add_ladder(CLI::App& floe);
void add_scan(CLI::App& floe, const std::string& command_line);
void add_crystal(CLI::App& floe, const std::string& command_line);
void add_figures(CLI::App& floe, const std::string& command_line);
void add_import(CLI::App& floe, const std::string& command_line);
void add_export(CLI::App& floe);
void add_merge(CLI::App& floe, const std::string& command_line);
void add_validate(CLI::App& floe);
void add_view(CLI::App& floe);

}  // namespace floe
