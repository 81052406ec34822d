#include "apps/crystal_options.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "apps/option_values.h"
#include "data/base/error.h"

namespace floe {

Fabric parse_fabric(const std::string& option, const std::string& text) {
  if (text == "isotropic") return Fabric::isotropic();
  if (text == "girdle") return Fabric::girdle();
  const std::vector<std::string> parts = split_list(text);
  if (parts.size() != 2)
    throw UsageError(fmt::format(
        "{}: found \"{}\"; expected isotropic, girdle, or ln(S1/S2),ln(S2/S3), e.g. 0.1,4", option, text));
  const Range range{0, largest_log_ratio};
  return Fabric::from_eigenvalues(fabric_eigenvalues(parse_option_number(option, parts[0], range),
                                                     parse_option_number(option, parts[1], range)));
}

double parse_length(const std::string& option, const std::string& text) {
  constexpr std::array<std::pair<std::string_view, double>, 4> units{
      {{"mm", 1e-3}, {"um", 1e-6}, {"cm", 1e-2}, {"m", 1}}};
  for (const auto& [unit, size] : units) {
    if (!text.ends_with(unit)) continue;
    const std::string number = text.substr(0, text.size() - unit.size());
    return size * parse_option_number(option, number, {1e-6 / size, 1 / size});
  }
  throw UsageError(fmt::format("{}: found \"{}\"; expected a length with its unit, e.g. 1mm", option, text));
}

std::vector<double> parse_numbers(const std::string& option, const std::string& text, double low,
                                  double high) {
  std::vector<double> numbers;
  for (const std::string& part : split_list(text))
    numbers.push_back(parse_option_number(option, part, {low, high}));
  return numbers;
}

std::vector<double> parse_angles(const std::string& option, const std::string& text) {
  std::vector<double> angles = parse_numbers(option, text, 0, 90);
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (!(angles[i] > angles[i - 1]))
      throw UsageError(fmt::format("{}: found \"{}\"; expected rising angles", option, text));
  for (double& angle : angles) angle *= degree;
  return angles;
}

}  // namespace floe
