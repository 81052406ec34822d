#include "propagation/ice/ice_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace floe::ice_files {

bool is_supported(int version) {
  return std::find(supported_versions.begin(), supported_versions.end(), version) != supported_versions.end();
}

std::size_t kept_points(const TiltMap& map) {
  std::size_t kept = 0;
  for (int j = 0; j < map.second.count; ++j)
    for (int i = 0; i < map.first.count; ++i) kept += is_kept(map, i, j);
  return kept;
}

std::optional<std::size_t> first_irregular(const std::vector<double>& depths) {
  if (depths.size() < 2) return {};
  for (std::size_t i = 1; i < depths.size(); ++i)
    if (!(depths[i] > depths[i - 1])) return i;

  const double mean = (depths.back() - depths.front()) / static_cast<double>(depths.size() - 1);
  std::vector<double> steps(depths.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = depths[i + 1] - depths[i];
  const auto off = [&](double step) { return std::abs(step - mean) > depth_tolerance * mean; };
  if (std::none_of(steps.begin(), steps.end(), off)) return {};
  // One bad row moves the mean, so that every row looks wrong; the usual step shows which one is.
  std::vector<double> sorted = steps;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  const double usual = sorted[sorted.size() / 2];
  const auto worst = std::max_element(steps.begin(), steps.end(), [&](double a, double b) {
    return std::abs(a - usual) < std::abs(b - usual);
  });
  return static_cast<std::size_t>(worst - steps.begin()) + 1;
}

std::string rows_found(const std::vector<TextLine>& lines) {
  return fmt::format("{} row{}", lines.size(), lines.size() == 1 ? "" : "s");
}

double read_number(const TextLine& line, std::size_t field, const ice_limits::Range& range) {
  const double value = parse_number(line, field, range.what);
  expect_range(line, value, range.low, range.high, range.what);
  return value;
}

void expect_uniform(const std::vector<TextLine>& lines, const std::vector<double>& depths) {
  const auto bad = first_irregular(depths);
  if (!bad) return;
  const double previous = depths[*bad - 1], depth = depths[*bad];
  const double step = (depths.back() - depths.front()) / static_cast<double>(depths.size() - 1);
  if (depth <= previous)
    throw InputError(lines[*bad].where, fmt::format("depth {} m after {} m", depth, previous),
                     "depths that rise from row to row", "Sort the rows, shallowest first");
  throw InputError(
      lines[*bad].where, fmt::format("a step of {:.6g} m to depth {} m", depth - previous, depth),
      fmt::format("uniform steps (the mean step is {:.6g} m)", step), "Look for a missing or a doubled row");
}

}  // namespace floe::ice_files
