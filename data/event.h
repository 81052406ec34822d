// What flows through floe: modules are named, photons are detected, events collect them.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "data/base/vec3.h"
#include "data/flasher_run.h"
#include "data/module_id.h"
#include "data/readout.h"

namespace floe {

// One detected photon, or one pulse when only time and charge are known.
struct Hit {
  static constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

  ModuleId module;
  double time = 0;             // [ns]
  float charge = 1;            // [photoelectrons]; in a weighted simulation the photon's weight
  float wavelength = unknown;  // [nm]
  // Direction in which the photon travels, and direction from the point where it met the module to
  // the module's centre (their product is positive); unit vectors, or unknown.
  Vec3f direction = Vec3f::Constant(unknown);
  Vec3f inward = Vec3f::Constant(unknown);
  float width = unknown;  // of a pulse: its light may be spread over so much [ns]

  bool has_direction() const { return direction.x() == direction.x(); }
};

// A particle as f2k text describes it: true for a simulation's input, and stored with its output.
struct Particle {
  std::string name = "e-";  // of known_particle_names() (data/event_rules.h)
  Vec3 position = Vec3::Zero();
  double zenith = 0, azimuth = 0;  // where it comes FROM [rad]
  double length = 0;               // of a muon segment [m]
  double energy = 0;               // [GeV]; for "ph" the number of photons
  double time = 0;                 // [ns]
};

struct Event {
  std::string id;  // unique within its file
  std::vector<Hit> hits;
  std::vector<Particle> truth;             // empty for measured data
  double repeats = 1;                      // the hits are an average over this many repetitions
  std::optional<FlasherRun> flasher = {};  // when the light is that of a flasher run
  std::optional<Readout> readout = {};     // when the hits are pulses of which that is known
};

// When its pulses come, counted from their light (readout.h); nothing for photons.
inline std::vector<ExpectedDelay> pulse_delays(const Event& event) {
  return event.readout ? event.readout->delays : std::vector<ExpectedDelay>();
}

// Where a file came from: enough to make it again.
struct Provenance {
  std::string version;        // of floe
  std::string command;        // the command line
  std::string configuration;  // every setting, as one JSON object
  std::string ice_name, ice_hash;
  std::string detector_name, detector_hash;
  unsigned long long seed = 0;
  double oversize = 1;
  bool weighted = false;  // the hits are weighted photons (docs/formats.md)
  bool pulses = false;    // the hits are pulses, with widths; each event has a readout
};

}  // namespace floe
