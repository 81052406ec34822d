// Reads the files of an ice-model directory that describe the modules.
#include <fmt/format.h>

#include <functional>
#include <set>

#include "data/base/constants.h"
#include "data/base/text.h"
#include "data/event_rules.h"
#include "geometry/detector.h"
#include "geometry/with_file_name.h"

namespace floe {

namespace {

namespace fs = std::filesystem;

constexpr double farthest = 10e3;  // no detector is larger [m]

// Strings 1-86 carry 60 modules in the ice; larger DOM numbers there, and string 0, are at the
// surface. Later strings (> 86) have all their modules in the ice.
bool in_ice(ModuleId id) {
  return id.string > 86 || (id.string >= 1 && id.dom >= 1 && id.dom <= 60);
}

int parse_number_of(const TextLine& line, std::size_t field, std::string_view what) {
  const long number = parse_integer(line, field, what);
  expect_range(line, static_cast<double>(number), -1, 99999, what);
  return static_cast<int>(number);
}

ModuleId parse_module_id(const TextLine& line, std::size_t first_field) {
  const ModuleId id{parse_number_of(line, first_field, "string number"),
                    parse_number_of(line, first_field + 1, "DOM number")};
  // What sees light must have a place in event files.
  if (in_ice(id)) {
    expect_range(line, id.string, 1, largest_string, "string number");
    expect_range(line, id.dom, 1, largest_dom, "DOM number");
  }
  return id;
}

double parse_in_range(const TextLine& line, std::size_t field, double low, double high,
                      std::string_view what) {
  const double value = parse_number(line, field, what);
  expect_range(line, value, low, high, what);
  return value;
}

// Not used, and without an upper limit: a fit that found nothing states thousands of degrees.
void check_uncertainty(const TextLine& line, std::size_t field) {
  parse_in_range(line, field, 0, 1e9, "uncertainty [deg]");
}

// The main board's number is not used, but a row without one has its columns elsewhere.
void check_mainboard(const TextLine& line, const std::string& field) {
  const bool prefixed = field.starts_with("0x") || field.starts_with("0X");
  const std::string digits = prefixed ? field.substr(2) : field;
  if (digits.empty() || digits.size() > 16 ||
      digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
    throw InputError(line.where, fmt::format("mainboard id '{}'", field),
                     "a hexadecimal number, e.g. 0x1b2c3d4e5f60");
}

using ModuleTable = std::map<ModuleId, Module>;

ModuleTable read_geometry(const fs::path& file) {
  ModuleTable modules;
  std::set<ModuleId> seen;
  for (const TextLine& line : read_text_lines(file)) {
    expect_fields(line, 7, 7, "DOM id, mainboard id, x, y, z [m, z from the surface], string, DOM");
    check_mainboard(line, line.fields[1]);
    const double x = parse_in_range(line, 2, -farthest, farthest, "x [m]");
    const double y = parse_in_range(line, 3, -farthest, farthest, "y [m]");
    const double z = parse_in_range(line, 4, -farthest, farthest, "z from the surface [m]");
    const ModuleId id = parse_module_id(line, 5);
    if (!seen.insert(id).second)
      throw InputError(line.where, "a second row for " + module_name(id), "one row a module");
    if (!in_ice(id)) continue;
    if (z > 0)
      throw InputError(line.where, fmt::format("z = {} m for {}", z, module_name(id)),
                       "a module below the surface",
                       "z is measured from the surface, upwards, not in the detector's frame");
    Module& module = modules[id];
    module.id = id;
    module.position = {x, y, z + origin_depth};
  }
  if (modules.empty())
    throw InputError({file.string(), 0}, "no module in the ice", "at least one row of such a module");
  return modules;
}

// Reads the rows of a table keyed by string and DOM in its first two columns and calls
// `apply(line, module)` for those in the ice.
void read_module_rows(const fs::path& file, std::size_t least, std::size_t most, std::string_view layout,
                      ModuleTable& modules, const std::function<void(const TextLine&, Module&)>& apply) {
  std::set<ModuleId> seen;
  for (const TextLine& line : read_text_lines(file)) {
    expect_fields(line, least, most, layout);
    const ModuleId id = parse_module_id(line, 0);
    if (!seen.insert(id).second)
      throw InputError(line.where, "a second row for " + module_name(id), "one row a module");
    if (!in_ice(id)) continue;
    const auto module = modules.find(id);
    if (module == modules.end())
      throw InputError(line.where, "unknown " + module_name(id), "a module that geo-f2k lists");
    apply(line, module->second);
  }
}

void read_efficiencies(const fs::path& file, ModuleTable& modules) {
  read_module_rows(file, 3, 4, "string, DOM, relative efficiency [, type 0 or 1]", modules,
                   [](const TextLine& line, Module& module) {
                     const double efficiency = parse_number(line, 2, "relative efficiency");
                     if (!(efficiency > 0 && efficiency <= 10))
                       throw InputError(line.where, fmt::format("relative efficiency {}", efficiency),
                                        "a number above 0 and up to 10", "switch modules off in hvs-f2k");
                     module.relative_efficiency = efficiency;
                     if (line.fields.size() < 4) return;
                     const long type = parse_integer(line, 3, "type");
                     if (type != 0 && type != 1)
                       throw InputError(line.where, fmt::format("type {}", type),
                                        "0 (nominal) or 1 (high QE)");
                     module.high_qe_spectrum = type == 1;
                   });
}

void read_voltages(const fs::path& file, ModuleTable& modules) {
  for (auto& [id, module] : modules) module.on = false;
  bool any = false;
  read_module_rows(file, 3, 3, "string, DOM, high voltage [V]", modules,
                   [&](const TextLine& line, Module& module) {
                     module.on = parse_in_range(line, 2, -10000, 10000, "high voltage [V]") > 0;
                     any = any || module.on;
                   });
  if (!any)
    throw InputError({file.string(), 0}, "no module with a high voltage above 0", "at least one",
                     "Remove the file when all modules are on");
}

void read_tilts(const fs::path& file, ModuleTable& modules) {
  read_module_rows(file, 6, 6, "string, DOM, up axis nx ny nz, uncertainty [deg]", modules,
                   [](const TextLine& line, Module& module) {
                     Vec3 axis;
                     for (int k = 0; k < 3; ++k)
                       axis[k] = parse_number(line, 2 + k, "component of the up axis");
                     check_uncertainty(line, 5);
                     if (std::abs(axis.norm() - 1) > 1e-3)
                       throw InputError(line.where, fmt::format("an up axis of length {}", axis.norm()),
                                        "a unit vector (to 0.001)");
                     module.up_axis = axis.normalized();
                   });
}

void read_cables(const fs::path& file, ModuleTable& modules) {
  read_module_rows(file, 4, 4, "string, DOM, azimuth of the cable [deg], uncertainty [deg]", modules,
                   [](const TextLine& line, Module& module) {
                     const double azimuth = parse_in_range(line, 2, -360, 360, "azimuth of the cable [deg]");
                     check_uncertainty(line, 3);
                     module.cable_azimuth = (azimuth < 0 ? azimuth + 360 : azimuth) * degree;
                   });
}

std::map<int, Eigen::Vector2d> read_drill_holes(const fs::path& file, const ModuleTable& modules) {
  std::set<int> strings;
  for (const auto& [id, module] : modules) strings.insert(id.string);
  std::map<int, Eigen::Vector2d> holes;
  for (const TextLine& line : read_text_lines(file)) {
    expect_fields(line, 3, 3, "string, x, y [m]");
    const int string = parse_number_of(line, 0, "string number");
    const double x = parse_in_range(line, 1, -farthest, farthest, "x [m]");
    const double y = parse_in_range(line, 2, -farthest, farthest, "y [m]");
    if (string < 1) continue;
    if (!strings.contains(string))
      throw InputError(line.where, fmt::format("unknown string {}", string), "a string that geo-f2k lists");
    if (!holes.emplace(string, Eigen::Vector2d(x, y)).second)
      throw InputError(line.where, fmt::format("a second row for string {}", string), "one row a string");
  }
  return holes;
}

Detector make_detector(const fs::path& named_after, const fs::path& geometry, const ModuleTable& table,
                       std::map<int, Eigen::Vector2d> holes) {
  std::vector<Module> modules;
  modules.reserve(table.size());
  for (const auto& [id, module] : table) modules.push_back(module);
  return with_file_name(geometry, [&] {
    return Detector(named_after.filename().string(), std::move(modules), std::move(holes));
  });
}

// The path without a trailing slash or dot, so that its last part is a name.
fs::path without_trailing_slash(const fs::path& directory) {
  const fs::path whole = fs::absolute(directory).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

}  // namespace

Detector read_detector(const fs::path& directory) {
  ModuleTable modules = read_geometry(directory / "geo-f2k");
  const auto when_present = [&](const char* name, const auto& read) {
    if (fs::exists(directory / name)) read(directory / name);
  };
  when_present("eff-f2k", [&](const fs::path& file) { read_efficiencies(file, modules); });
  when_present("hvs-f2k", [&](const fs::path& file) { read_voltages(file, modules); });
  when_present("cx.dat", [&](const fs::path& file) { read_tilts(file, modules); });
  when_present("dx.dat", [&](const fs::path& file) { read_cables(file, modules); });
  std::map<int, Eigen::Vector2d> holes;
  when_present("str-f2k", [&](const fs::path& file) { holes = read_drill_holes(file, modules); });
  return make_detector(without_trailing_slash(directory), directory / "geo-f2k", modules, std::move(holes));
}

Detector read_detector_geometry(const fs::path& geo_file) {
  return make_detector(geo_file, geo_file, read_geometry(geo_file), {});
}

}  // namespace floe
