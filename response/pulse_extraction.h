// From the traces of a launch back to light: pulses of single photoelectrons, unfolded by non-negative least
// squares (arXiv:1311.4767, section 2.2).
#pragma once

#include <span>
#include <vector>

#include "response/digitisers.h"
#include "response/tube_saturation.h"

namespace floe {

struct ExtractionSettings {
  double atwd_spacing = 5.0 / 6;  // between the pulses that are tried where there is an ATWD trace [ns]
  double fadc_spacing = 6.25;     // elsewhere [ns]
  double tolerance = 1.5;         // what may be left unexplained [counts, along a pulse]
  double least_charge = 0.05;     // of a pulse that is kept, in units of the single photoelectron's peak
};

struct ExtractedPulse {
  double time = 0, charge = 0;  // [ns], in units of the single photoelectron's peak
  // Over which its light may be spread [ns]: the distance of the pulses that were tried, or that of its
  // neighbours.
  double width = 0;
};

struct Extraction {
  std::vector<ExtractedPulse> pulses;  // in order of time
  std::vector<TimeRange> clipped;      // where no digitiser could follow
};

// `traces`: of one launch, as Digitisers::digitise gives them.
Extraction extract_pulses(const ExtractionSettings& settings, const Digitisers& digitisers,
                          std::span<const Waveform> traces);

}  // namespace floe
