// The optical modules: where they are, how they look at light.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data/event.h"

namespace floe {

struct Module {
  ModuleId id;
  Vec3 position = Vec3::Zero();         // of the sphere's centre [m]
  double relative_efficiency = 1;       // > 0; 1 is a nominal module
  bool high_qe_spectrum = false;        // its acceptance follows HighQeRatio over wavelength
  bool on = true;                       // switched off modules never see light
  std::optional<double> cable_azimuth;  // of the main cable seen from the module [rad]; none: no cable
  Vec3 up_axis = Vec3::UnitZ();         // of the module; the photomultiplier looks against it
  double clock_offset = 0;              // of its clock: later than the light, by so much, are its hits [ns]
};

// "module STRING,DOM", as messages name it.
std::string module_name(ModuleId id);

// All in-ice modules, in ascending order of their ids; immutable. A module's index is its place in
// modules().
class Detector {
 public:
  // Throws InputError when empty, when an id occurs twice, when two modules overlap, or when a module is
  // unphysical (position not finite, efficiency not positive, up axis not a unit vector).
  // `drill_holes` holds the centres (x, y) of holes known better than by the mean of their modules.
  Detector(std::string name, std::vector<Module> modules, std::map<int, Eigen::Vector2d> drill_holes = {});

  const std::string& name() const { return name_; }
  const std::vector<Module>& modules() const { return modules_; }
  std::size_t size() const { return modules_.size(); }
  std::optional<std::size_t> find(ModuleId id) const;
  std::size_t index_of(ModuleId id) const;  // throws InputError naming the unknown module

  // Centre of each string's drill hole: given, else the mean of its modules.
  const std::map<int, Eigen::Vector2d>& strings() const { return strings_; }
  double largest_relative_efficiency() const;  // over modules that are on; 0 when none is
  const std::string& hash() const { return hash_; }

  // Horizontal and vertical extent of the modules' centres [m].
  struct Extent {
    Vec3 low, high;
  };
  Extent extent() const;

 private:
  std::string name_, hash_;
  std::vector<Module> modules_;
  std::map<int, Eigen::Vector2d> strings_;
};

// Reads the detector of an ice-model directory: geo-f2k (needed), eff-f2k, hvs-f2k, cx.dat, dx.dat,
// str-f2k (each optional). Strict: InputError with file, line, what was found and expected.
// Modules that are not in the ice (string 1-86 with DOM > 60, string < 1) are left out.
Detector read_detector(const std::filesystem::path& directory);

// Reads a geo-f2k file alone (contract: --detector FILE).
Detector read_detector_geometry(const std::filesystem::path& geo_file);

// The built-in detector, idealised from published facts: 78 strings on a hexagonal grid of 125 m with
// 60 modules every 17.02 m, and 8 DeepCore strings. No file is needed.
Detector ic86_detector();

}  // namespace floe
