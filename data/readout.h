// What is known of an event's record as the modules' electronics took it, or their simulation did: fits need
// it to know where dark noise, afterpulses and gaps are. docs/formats.md has it as tables.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "data/module_id.h"

namespace floe {

// A module of the detector in a whole file of events.
struct RecordingModule {
  ModuleId id;
  bool on = true;
  double noise_rate = 0;  // charge of dark noise that its pulses hold in a second, on average [pe/s]

  bool operator==(const RecordingModule&) const = default;
};
using RecordingModules = std::vector<RecordingModule>;  // by id

// Afterpulses follow light: `share` of its charge, between `begin` and `end` after it [ns], evenly in the
// logarithm of time.
struct ExpectedAfterpulses {
  double share = 0, begin = 300, end = 11000;
  bool operator==(const ExpectedAfterpulses&) const = default;
};

// A share of the charge comes so much later than its light (negative: earlier), evenly between two times
// [ns].
struct ExpectedDelay {
  double share = 0, begin = 0, end = 0;
  bool operator==(const ExpectedDelay&) const = default;
};

// Times at which a module's record is not what the light was.
struct UnusableTimes {
  enum class Reason { saturated, dead };
  ModuleId module;
  double begin = 0, end = 0;  // [ns], begin < end
  Reason reason = Reason::dead;
};
std::string_view name_of(UnusableTimes::Reason reason);

struct Readout {
  double begin = 0, end = 0;  // modules were awake between these [ns]
  ExpectedAfterpulses afterpulses;
  std::vector<UnusableTimes> unusable;
  std::shared_ptr<const RecordingModules> modules;  // the same for all events of a file; never null
  std::vector<ExpectedDelay> delays;  // shares of at most 1 together; the rest comes with its light
};

// Of a photoelectron in the simulation of the electronics.
enum class PhotoelectronOrigin { photon, prepulse, late, afterpulse, noise };
inline constexpr std::string_view photoelectron_origins[] = {"photon", "prepulse", "late", "afterpulse",
                                                             "noise"};
struct Photoelectron {
  double time = 0;   // [ns]
  float charge = 1;  // at the anode, in units of the peak of the single photoelectron's charge
  PhotoelectronOrigin origin = PhotoelectronOrigin::photon;
};

enum class Digitiser { atwd0, atwd1, atwd2, fadc };
inline constexpr std::string_view digitiser_names[] = {"atwd0", "atwd1", "atwd2", "fadc"};
// A trace that was sent to the surface.
struct Waveform {
  Digitiser digitiser = Digitiser::fadc;
  double time = 0;                 // of the first sample [ns]
  double step = 25;                // from sample to sample [ns]
  double millivolt_per_count = 0;  // at the anode
  double baseline = 0;             // [counts]
  std::vector<int> counts;
};

// What stands beside an event's pulses when it was asked for.
struct ModulePhotoelectron : Photoelectron {
  int repeat = 0;
  ModuleId module;
};
struct ModuleWaveform : Waveform {
  int repeat = 0, launch = 0;
  ModuleId module;
};

}  // namespace floe
