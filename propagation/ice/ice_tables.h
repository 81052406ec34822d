// An ice model as its directory holds it (the format users already have), read strictly and written
// back. IceModel (ice_model.h) makes the physics out of it.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace floe {

// One row of icemodel.dat.
struct IceLayerRow {
  double depth = 0;                   // of the layer's centre, below the surface [m]
  double effective_scattering = 0;    // b_e at 400 nm [1/m], >= 0
  double dust_absorption = 0;         // a_dust at 400 nm [1/m], >= 0
  double temperature_difference = 0;  // delta-tau [K]
  std::optional<double> k1, k2;       // scattering anisotropy (natural logs); override the directory's
  double birefringence_strength = 1;  // A: deflection and diffusion, >= 0
  double deflection_strength = 1;     // B: deflection only, >= 0
};

// icemodel.par: wavelength dependence (arXiv:1301.5361). D and E in models before 2013.
struct WavelengthDependence {
  double alpha = 0, kappa = 0, A = 0, B = 0;
  std::optional<double> D, E;
  std::array<double, 6> uncertainty{};
};

// icemodel.bbl: add b (1 - d/d1)(1 - d/d2) [1/m] to b_e at depths d < d1, d2 [m].
struct Bubbles {
  double b = 0, d1 = 0, d2 = 0;
};

struct HoleIce {      // a vertical cylinder around each string
  double radius = 0;  // [module radii]; 0: none
  double effective_scattering_length = 0.03, absorption_length = 100;  // [m]
  double simplified_liu_fraction = 0.35, mean_cosine = 0.9;
};

// The seed paper's 12 numbers (arXiv:2107.08692), per metre at strength 1:
//   sigma_x, sigma_y = A exp(-B [atan(D sin eta)]^C)
//   m_x = A atan(D sin eta cos eta) exp(-B sin eta + C cos eta)
struct DiffusionFunction {
  double A = 0, B = 0, C = 0, D = 0;
};
struct BirefringenceNumbers {
  DiffusionFunction sigma_x, sigma_y, mean_x;
  // Each part can be switched off alone: an experiment on the step, which leaves the subtraction of the
  // birefringent share from scattering as it is. A directory cannot hold these switches.
  bool diffusion = true, deflection = true, displacement = true;
  bool operator==(const BirefringenceNumbers&) const = default;
};

struct TiltLines {                // tilt.par, tilt.dat: 1D
  std::vector<int> strings;       // the string that each column's distance belongs to
  std::vector<double> distances;  // of the columns along 225 deg, rising [m]; 0 marks the origin's string
  std::vector<double> depths;     // rising, uniform [m]
  std::vector<std::vector<double>> shifts;  // [depth][column] [m]
};

struct TiltMap {  // tilt.set, tilt.map: 2D
  struct Axis {
    double direction_deg, start, step;
    int count, cut;
  };
  Axis first, second;
  std::vector<double> depths;               // rising, uniform [m]
  std::vector<std::vector<double>> shifts;  // [depth][kept grid point: second axis outer, first inner]
};

// cfg.txt, in the file's order; optional blocks as optionals.
struct IceConfiguration {
  double oversize = 5;
  double module_efficiency = 1;
  double simplified_liu_fraction = 0, mean_cosine = 0.9;  // f_SL, g
  double flow_azimuth_deg = 0, k1 = 0, k2 = 0;            // scattering anisotropy (natural logs)
  HoleIce hole_ice;
  struct AbsorptionAnisotropy {
    double k1 = 0, k2 = 0, kz = 0;
  };
  std::optional<AbsorptionAnisotropy> absorption_anisotropy;  // natural logs
  double old_absorption_scaling = 1;
  std::optional<BirefringenceNumbers> birefringence;
};

struct IceTables {
  std::string name;                 // the directory's name
  int version = 0;                  // 0, 10 or 20
  std::vector<IceLayerRow> layers;  // top first, uniform step
  WavelengthDependence wavelength;
  std::optional<Bubbles> bubbles;
  IceConfiguration configuration;
  std::optional<TiltLines> tilt_lines;
  std::optional<TiltMap> tilt_map;
};

// Reads icemodel.dat, icemodel.par, icemodel.bbl, cfg.txt, tilt.*, version. `version` overrides the
// file's (UsageError unless 0, 10 or 20). Throws InputError with file, line, what was found and expected.
IceTables read_ice_tables(const std::filesystem::path& directory, std::optional<int> version = {});

// Writes the files that read_ice_tables reads into an existing directory (numbers round-trip exactly), and
// removes those of them that the tables have no content for; other files stay. Throws OutputError, and what
// expect_writable() throws.
void write_ice_tables(const IceTables& tables, const std::filesystem::path& directory);
// To be known before the work that leads to such tables: UsageError when a part of birefringence is switched
// off alone, which no file of a directory can say.
void expect_writable(const IceTables& tables);

// The 12 numbers of SpiceBFR v2, all parts on (arXiv:2107.08692).
BirefringenceNumbers published_birefringence();

// The built-in ice "south-pole", idealised: dust layers at their published depths, published numbers
// for anisotropy and birefringence, no tilt. Sources stand beside the numbers.
IceTables south_pole_ice();

}  // namespace floe
