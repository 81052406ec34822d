// Numbers on the command line, read strictly: the whole text, finite and in range, or a UsageError
// that names the option.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "data/module_id.h"

namespace floe {

// Values allowed: low <= value <= high, or low < value when `above_low`.
struct Range {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
  bool above_low = false;
};
inline constexpr Range any_number{};
inline constexpr Range positive{0, std::numeric_limits<double>::max(), true};

double parse_option_number(const std::string& option, const std::string& text, const Range& range);
std::int64_t parse_option_integer(const std::string& option, const std::string& text, std::int64_t low,
                                  std::int64_t high);

// The parts of "a,b,c"; empty parts are kept, so that they are found and reported.
std::vector<std::string> split_list(const std::string& text);

// "STRING,DOM".
ModuleId parse_module(const std::string& option, const std::string& text);

// Adds an option that takes one number; `unit` is shown in the help, `set` receives the value.
CLI::Option* add_number(CLI::App& app, const std::string& name, const std::string& unit, const Range& range,
                        const std::string& description, std::function<void(double)> set);
CLI::Option* add_number(CLI::App& app, const std::string& name, const std::string& unit, const Range& range,
                        const std::string& description, double& value);
CLI::Option* add_integer(CLI::App& app, const std::string& name, std::int64_t low, std::int64_t high,
                         const std::string& description, std::function<void(std::int64_t)> set);
// Adds an option that names a file to write, which has to end in `suffix`.
CLI::Option* add_output_file(CLI::App& app, const std::string& name, const std::string& suffix,
                             const std::string& description, std::optional<std::string>& path);
// Likewise of a picture, which ends in .svg.
CLI::Option* add_picture(CLI::App& app, const std::string& name, const std::string& description,
                         std::optional<std::string>& path);

}  // namespace floe
