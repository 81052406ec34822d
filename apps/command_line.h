// The command line as a whole: what was typed, and wrong use explained.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace floe {

inline constexpr int internal_error = 70;  // exit code, as in sysexits.h

// Words that a shell takes for these, one space between them.
std::string quoted_command(const std::vector<std::string>& words);
// What was typed, likewise.
std::string quoted_command_line(int argc, char** argv);

// Prints help or version when that was asked for, or says on stderr what is wrong with the command
// line and what was perhaps meant; returns the exit code.
int report_parse_error(const CLI::App& app, const CLI::ParseError& error);

// Throws UsageError when an output of a subcommand, which has been parsed, is a file that another of its
// options names: an input would be lost, or one of two outputs.
void expect_outputs_apart(const CLI::App& command);

}  // namespace floe
