#include "apps/option_values.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <utility>

#include "data/base/error.h"

namespace floe {

namespace {

std::string words(const Range& range) {
  const bool has_low = range.low > any_number.low, has_high = range.high < any_number.high;
  if (has_low && has_high)
    return fmt::format("a number {} {} and at most {}", range.above_low ? "above" : "of at least", range.low,
                       range.high);
  if (has_low)
    return fmt::format("a finite number {} {}", range.above_low ? "above" : "of at least", range.low);
  return "a finite number";
}

template <typename Number>
bool parse_all(const std::string& text, Number& value) {
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc{} && result.ptr == end;
}

[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& expected) {
  throw UsageError(fmt::format("{}: found \"{}\"; expected {}", option, text, expected));
}

}  // namespace

double parse_option_number(const std::string& option, const std::string& text, const Range& range) {
  double value = 0;
  const bool inside = parse_all(text, value) && std::isfinite(value) && value <= range.high &&
                      (range.above_low ? value > range.low : value >= range.low);
  if (!inside) refuse(option, text, words(range));
  return value;
}

std::int64_t parse_option_integer(const std::string& option, const std::string& text, std::int64_t low,
                                  std::int64_t high) {
  std::int64_t value = 0;
  if (!parse_all(text, value) || value < low || value > high)
    refuse(option, text, fmt::format("a whole number from {} to {}", low, high));
  return value;
}

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

ModuleId parse_module(const std::string& option, const std::string& text) {
  const std::vector<std::string> parts = split_list(text);
  if (parts.size() != 2)
    throw UsageError(fmt::format("{}: found \"{}\"; expected STRING,DOM, e.g. 63,20", option, text));
  return {static_cast<int>(parse_option_integer(option, parts[0], 0, 100000)),
          static_cast<int>(parse_option_integer(option, parts[1], 0, 100000))};
}

CLI::Option* add_number(CLI::App& app, const std::string& name, const std::string& unit, const Range& range,
                        const std::string& description, std::function<void(double)> set) {
  return app
      .add_option_function<std::string>(
          name, [=](const std::string& text) { set(parse_option_number(name, text, range)); }, description)
      ->type_name(unit);
}

CLI::Option* add_number(CLI::App& app, const std::string& name, const std::string& unit, const Range& range,
                        const std::string& description, double& value) {
  return add_number(app, name, unit, range, description, [&value](double read) { value = read; })
      ->default_str(fmt::format("{}", value));
}

CLI::Option* add_integer(CLI::App& app, const std::string& name, std::int64_t low, std::int64_t high,
                         const std::string& description, std::function<void(std::int64_t)> set) {
  return app
      .add_option_function<std::string>(
          name, [=](const std::string& text) { set(parse_option_integer(name, text, low, high)); },
          description)
      ->type_name("N");
}

CLI::Option* add_output_file(CLI::App& app, const std::string& name, const std::string& suffix,
                             const std::string& description, std::optional<std::string>& path) {
  const auto set = [&path, suffix, option = split_list(name).back()](const std::string& text) {
    if (!text.ends_with(suffix))
      throw UsageError(
          fmt::format("{}: found \"{}\"; expected a name that ends in {}", option, text, suffix));
    path = text;
  };
  return app.add_option_function<std::string>(name, set, description)->type_name("FILE" + suffix);
}

CLI::Option* add_picture(CLI::App& app, const std::string& name, const std::string& description,
                         std::optional<std::string>& path) {
  return add_output_file(app, name, ".svg", description, path);
}

}  // namespace floe
