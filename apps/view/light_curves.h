// An event's hits as light curves of its modules, in bins, so that a page can hold a million of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/detector.h"

namespace floe {

struct LightCurve {
  std::size_t module;                 // index into Detector::modules()
  std::uint64_t hits = 0;             // photons or pulses
  double charge = 0;                  // sum [pe]
  double first = 0;                   // time of its first hit [ns]
  std::vector<std::uint32_t> bins;    // that hold light, rising
  std::vector<double> charge_in_bin;  // [pe], one for each of them
};

struct LightCurves {
  double begin = 0;      // of bin 0 [ns], whole
  double bin_width = 1;  // [ns]
  double end = 0;        // time of the last hit [ns]
  std::vector<LightCurve> modules;
  std::uint64_t left_out = 0;  // hits of modules that the detector does not have
};

// In bins of the smallest width, of 1, 2, 5, 10, 20, ... ns, with which at most `most_bins` bins of all
// curves together hold light. Modules are in the detector's order.
LightCurves light_curves(std::span<const Hit> hits, const Detector& detector,
                         std::size_t most_bins = 200'000);

}  // namespace floe
