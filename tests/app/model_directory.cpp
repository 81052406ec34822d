#include "tests/app/model_directory.h"

#include <fmt/format.h>

#include <sstream>
#include <utility>
#include <vector>

#include "data/base/constants.h"
#include "propagation/ice/ice_tables.h"
#include "propagation/model.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {

namespace {

namespace fs = std::filesystem;

std::string row_of(const ModuleId& id) {
  return fmt::format("{} {}", id.string, id.dom);
}

void write_detector(const fs::path& directory, const Detector& detector) {
  std::string geometry, efficiencies, voltages, cables, axes, holes;
  for (const Module& module : detector.modules()) {
    const std::string id = row_of(module.id);
    geometry += fmt::format("module-{} {:012x} {} {} {} {}\n", geometry.size(), 4096 + geometry.size(),
                            module.position.x(), module.position.y(), module.position.z() - origin_depth, id);
    const bool high = module.relative_efficiency > 1.2;
    efficiencies += fmt::format("{} {} {}\n", id, high ? 1.0 : module.relative_efficiency, high ? 1 : 0);
    voltages += id + " 1300\n";
    cables += fmt::format("{} {} 5\n", id, (module.id.string * 37 + module.id.dom) % 360);
    axes += id + " 0 0 1 1\n";
  }
  for (const auto& [string, hole] : detector.strings())
    holes += fmt::format("{} {} {}\n", string, hole.x(), hole.y());
  write_bytes(directory / "geo-f2k", geometry);
  write_bytes(directory / "eff-f2k", efficiencies);
  write_bytes(directory / "hvs-f2k", voltages);
  write_bytes(directory / "dx.dat", cables);
  write_bytes(directory / "cx.dat", axes);
  write_bytes(directory / "str-f2k", holes);
}

void write_acceptance(const fs::path& directory, const ModuleAcceptance& acceptance) {
  std::string angular = fmt::format("{}\n", acceptance.angular.maximum());
  for (const double coefficient : acceptance.angular.coefficients())
    angular += fmt::format("{}\n", coefficient);
  std::string spectrum;
  for (const auto& point : acceptance.spectrum.points())
    spectrum += fmt::format("{} {}\n", point.cumulative, point.wavelength);
  write_bytes(directory / "as.dat", angular);
  write_bytes(directory / "wv.dat", spectrum);
  write_bytes(directory / "wv.rde", "300 1.35\n600 1.35\n");
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::istringstream text(bytes_of(file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

void write_lines(const fs::path& file, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  write_bytes(file, text);
}

}  // namespace

void write_model_directory(const fs::path& directory) {
  fs::create_directories(directory);
  IceTables tables = south_pole_ice();
  tables.bubbles = Bubbles{6, 1350, 1350};
  tables.tilt_lines = TiltLines{{50, 86}, {0, 400}, {1500, 2000, 2500}, {{0, 10}, {0, 20}, {0, 30}}};
  write_ice_tables(tables, directory);
  write_detector(directory, ic86_detector());
  write_acceptance(directory, builtin_acceptance());
}

void replace_line(const fs::path& file, std::size_t number, const std::string& text) {
  auto lines = lines_of(file);
  lines.at(number - 1) = text;
  write_lines(file, lines);
}

void append_line(const fs::path& file, const std::string& text) {
  auto lines = lines_of(file);
  lines.push_back(text);
  write_lines(file, lines);
}

void swap_lines(const fs::path& file, std::size_t first, std::size_t second) {
  auto lines = lines_of(file);
  std::swap(lines.at(first - 1), lines.at(second - 1));
  write_lines(file, lines);
}

void keep_lines(const fs::path& file, std::size_t count) {
  auto lines = lines_of(file);
  lines.resize(std::min(count, lines.size()));
  write_lines(file, lines);
}

}  // namespace floe::test
