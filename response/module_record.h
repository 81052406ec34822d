// One module in one repeat of an event: what its tube gives, and what its digitisers make of it.
#pragma once

#include <vector>

#include "response/response_settings.h"

namespace floe {

// The tube's output, with where it fell behind the light and where it passed the discriminator.
struct TubeOutput {
  std::vector<Photoelectron> photoelectrons;  // in order of time; after saturation
  std::vector<Photoelectron> before;          // the same before saturation, when they were asked for
  std::vector<TimeRange> saturated;
  std::vector<double> crossings;  // [ns]
  double clock_phase = 0;         // [ns]
};

// What was sent of a module, and what that says of the light.
struct ModuleRecord {
  std::vector<ExtractedPulse> pulses;
  std::vector<std::vector<Waveform>> traces;  // of each launch, when they were asked for
  std::vector<UnusableTimes> unusable;        // without the module's name
};

class ModuleElectronics {
 public:
  explicit ModuleElectronics(const ResponseSettings& settings);

  // `photons`: times at which photoelectrons are set free [ns]. Dark noise, whose rates `noise_factor`
  // multiplies, is added between `begin` and `end`.
  TubeOutput tube_output(std::span<const double> photons, double noise_factor, double begin, double end,
                         bool keep_before, RandomStream& stream) const;

  // Pulses of the launches, and what of the times around them cannot be used.
  ModuleRecord record(const TubeOutput& tube, std::span<const Launch> launches, bool keep_traces) const;

  // Charge of the pulses that dark noise makes in a second in a module far from others, on average, in
  // units of the single photoelectron's peak [1/s]. From a simulation of 11000 photoelectrons; good to
  // about 1%.
  double noise_charge() const;

 private:
  void add_light(double photon, RandomStream& stream, std::vector<Photoelectron>& photoelectrons) const;
  void add_dead_times(std::span<const Launch> launches, std::size_t launch, bool whole, double recorded_until,
                      ModuleRecord& record) const;

  ResponseSettings settings_;
  PhotoelectronCharge charge_;
  TransitTime time_;
  Digitisers digitisers_;
};

}  // namespace floe
