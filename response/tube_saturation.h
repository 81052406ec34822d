// A photomultiplier's anode current falls behind the light when it is large: arXiv:1002.2442, section 5:
//   ln I_ideal = ln I + C (I/A)^B / (1 - I/A)^(1/4),
// I below A. (The paper has volts at 50 Ohm; A = 7.5 V is 150 mA.)
#pragma once

#include <vector>

#include "data/readout.h"

namespace floe {

struct TubeSettings {
  double gain = 1e7;
  double impedance = 43;                  // that turns the anode's current to volts [Ohm]
  double largest_current = 150;           // A [mA]
  double exponent = 2.02, factor = 2.98;  // B, C
  double pulse_width = 3.2;               // sigma of the anode's current after one photoelectron [ns]
  double saturated_share = 0.05;          // of charge lost, at which a record is called saturated
};

// I for I_ideal >= 0 [mA].
double compressed_current(const TubeSettings& tube, double ideal);

// Charge of one photoelectron of the peak's charge, over the impedance [mV ns].
double charge_in_millivolt(const TubeSettings& tube);

struct TimeRange {
  double begin, end;  // [ns]
};

// Reduces the charges of one module's photoelectrons, in order of time, by what the tube cannot follow, each
// by the compression at its time. Returns where more than `saturated_share` is lost, in order.
std::vector<TimeRange> saturate(const TubeSettings& tube, std::vector<Photoelectron>& photoelectrons);

}  // namespace floe
