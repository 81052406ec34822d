// A small ice-model directory of our own making, to be spoiled in one place by a test.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "geometry/detector.h"

namespace floe::test {

namespace fs = std::filesystem;

class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string name = (fs::temp_directory_path() / "floe-ice-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary directory");
    path_ = name;
  }
  ~TemporaryDirectory() { fs::remove_all(path_); }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  const fs::path& path() const { return path_; }
  void write(const std::string& file, const std::string& text) const { std::ofstream(path_ / file) << text; }
  void remove(const std::string& file) const { fs::remove(path_ / file); }

 private:
  fs::path path_;
};

inline const std::string layers_text =
    "# depth be a dT k1 k2 A B\n"
    "1300 0.12 0.03 -7.5 0 0 1.5 1.0\n"
    "1310 0.05 0.008 -7.4 0.02 -0.04 2 0.9\n"
    "1320 0.04 0.007 -7.25 0 0 0 1\n";
inline const std::string wavelength_text = "0.9 0.03\n1.08 0.01\n6954 973\n6618 71\n";
inline const std::string configuration_text =
    "5\n1.015 # efficiency\n0.35\n0.9\n\n130\n-0.1\n0.05\n"  // modules, scattering, flow
    "0 # none\n0.03\n100\n0.35\n0.9\n0.6\n-0.3\n-0.3\n0\n"   // hole ice, absorption
    "0.076795\n544284.545\n2.229494\n0.002624\n"             // sigma_x
    "0.077381\n1547618.884\n2.449589\n0.002505\n"            // sigma_y
    "0.000995\n0.248264\n2.354436\n1.680717\n";              // m_x
inline const std::string tilt_par_text = "50 -500.5\n86 0\n14 480\n";
inline const std::string tilt_dat_text = "1200 -1 0 5\n1210 -2.5 0 6\n1220 -3 0 6.5\n";
// Axes of 3 and 3 points with one corner cut off each: 7 points.
inline const std::string tilt_set_text = "9.3 -100 100 3 2\n129.3 -110 105 3 2\n";
inline const std::string tilt_map_text = "1200 1 2 3 4 5 6 7\n1210 2 4 6 8 10 12 14\n";

// Holds every file that read_ice_tables knows.
class IceDirectory : public TemporaryDirectory {
 public:
  IceDirectory() {
    write("icemodel.dat", layers_text);
    write("icemodel.par", wavelength_text);
    write("icemodel.bbl", "11.7 1350 1400\n");
    write("cfg.txt", configuration_text);
    write("tilt.par", tilt_par_text);
    write("tilt.dat", tilt_dat_text);
    write("tilt.set", tilt_set_text);
    write("tilt.map", tilt_map_text);
    write("version", "10\n");
  }
};

// One string, number 86 as the tilts of published models expect, of two modules.
inline Detector small_detector(double x = 10, double y = -20) {
  std::vector<Module> modules(2);
  modules[0].id = {86, 1}, modules[0].position = {x, y, 100};
  modules[1].id = {86, 2}, modules[1].position = {x, y, 80};
  return Detector("small", modules);
}

// The public models, where the machine has them.
inline fs::path public_ice(const std::string& name) {
  return fs::path(FLOE_SHARED_DIR) / "ice" / name;
}

}  // namespace floe::test

#define FLOE_NEEDS_PUBLIC_ICE(name)                           \
  if (!std::filesystem::exists(floe::test::public_ice(name))) \
  GTEST_SKIP() << "no " << floe::test::public_ice(name)
