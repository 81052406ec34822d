// floe: light in birefringent glacial ice. Each subcommand is a file beside this one.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <memory>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/help_formatter.h"
#include "data/base/error.h"

namespace {

void describe(CLI::App& app) {
  app.name("floe");
  app.set_version_flag("--version", "floe " FLOE_VERSION);
  app.require_subcommand(1);
  const auto formatter = std::make_shared<floe::HelpFormatter>();
  formatter->column_width(34);
  app.formatter(formatter);
  app.footer(
      "Examples:\n"
      "  floe info\n"
      "  floe simulate --cascade 20,-40,-300,70,130,3000 -o event.h5\n"
      "  floe compare event.h5 --without birefringence --picture compare.svg\n"
      "Exit codes: 0 done, 1 disagreement (validate), 2 wrong usage, 3 bad input, 4 no result, 5 output "
      "could not be written.");
}

void add_commands(CLI::App& app, const std::string& command_line) {
  floe::add_info(app);
  floe::add_effects(app);
  floe::add_simulate(app, command_line);
  floe::add_respond(app, command_line);
  floe::add_reconstruct(app);
  floe::add_compare(app);
  floe::add_study(app);
  floe::add_fit_ice(app, command_line);
  floe::add_ladder(app);
  floe::add_diagnose(app, command_line);
  floe::add_blind_trials(app);
  floe::add_scan(app, command_line);
  floe::add_crystal(app, command_line);
  floe::add_figures(app, command_line);
  floe::add_import(app, command_line);
  floe::add_export(app);
  floe::add_merge(app, command_line);
  floe::add_validate(app);
  floe::add_view(app);
  for (CLI::App* command : app.get_subcommands({}))
    command->parse_complete_callback([command] { floe::expect_outputs_apart(*command); });
}

int run(const std::string& command_line, int argc, char** argv) {
  CLI::App app("Light in birefringent glacial ice: simulate, reconstruct, compare.");
  describe(app);
  add_commands(app, command_line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return floe::report_parse_error(app, error);
  }
  // A full disk shows itself only here.
  if (std::fflush(stdout) != 0) throw floe::OutputError("standard output could not be written");
  return static_cast<int>(floe::ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string command_line = floe::quoted_command_line(argc, argv);
  try {
    return run(command_line, argc, argv);
  } catch (const floe::Error& error) {
    fmt::print(stderr, "floe: error: {}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    if (std::ferror(stdout)) {  // fmt::print throws what is none of floe's errors
      fmt::print(stderr, "floe: error: standard output could not be written: {}\n", error.what());
      return static_cast<int>(floe::ExitCode::bad_output);
    }
    fmt::print(stderr,
               "floe: internal error: {}\n"
               "This is a mistake in floe, not in your input. Please report it, with the command:\n  {}\n",
               error.what(), command_line);
    return floe::internal_error;
  }
}
