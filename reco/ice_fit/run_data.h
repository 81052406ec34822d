// Measured light of flasher runs, screened: what is left out is said in words.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "data/event.h"
#include "data/readout.h"
#include "geometry/detector.h"
#include "reco/ice_fit/run_bins.h"

namespace floe {

struct RunData {
  struct Pulse {
    std::uint32_t module;
    double time, width, charge;  // its light may be spread over the width; charge of all flashes together
  };
  std::string name;
  FlasherRun run;
  double repeats = 1;
  std::vector<Pulse> pulses;
  std::vector<char> used;  // by module: looked at in this run
  double charge = 0;       // of used modules
  // Of the electronics' record, where there is one; else from the first to the last pulse, without any.
  double first = 0, last = 0;  // when modules were awake [ns]
  double noise_rate = 0;       // of dark noise, charge a module and second [pe/s]
  ExpectedAfterpulses afterpulses = {.share = 0};
  std::vector<ExpectedDelay> delays;  // of the pulses of light
  double charge_dispersion = 1;       // variance of the charge over that of the number of photoelectrons

  Eigen::VectorXd counts(const RunBins& bins) const;
};

struct FlasherData {
  std::vector<RunData> runs;
  std::vector<std::string> left_out;  // a sentence each
};

// Of the run's flasher, below the surface [m].
double flasher_depth(const RunData& run, const Detector& detector);
struct FlasherDepths {
  double shallowest, deepest;
};
FlasherDepths flasher_depths(const FlasherData& data, const Detector& detector);

// The flasher runs among the events. Left out, with a sentence: events that are no flasher run, runs without
// any light, runs at another wavelength than most. Modules that are off and the flashing module itself are
// left out without a word. Throws InputError for modules that the detector does not have, and NoResult when
// no run is left.
FlasherData flasher_data(const Detector& detector, std::span<const Event> events);

// Leaves out receivers of measured runs (oversize 1) that saw more than `saturation` photoelectrons in a
// flash.
void leave_out_bright_receivers(const Detector& detector, double saturation, FlasherData& data);

// Leaves out receivers that cannot be right by any ice: dark in every run where `expected` light (per run and
// module, as counts of the data) is plenty, and those of measured runs that should have seen more than
// `saturation` photoelectrons in a flash.
void leave_out_bad_receivers(const Detector& detector, const std::vector<std::vector<double>>& expected,
                             double saturation, FlasherData& data);

}  // namespace floe
