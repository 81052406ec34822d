// How good a fit is: its likelihood against that of data drawn from the fit itself.
#pragma once

#include <span>
#include <vector>

#include "reco/direct_fit/expectation_model.h"
#include "reco/event_data.h"
#include "reco/likelihood/limited_simulation.h"

namespace floe {

struct BinOfData : BinCounts {
  bool saturated = false, left_out = false;
  BinLikelihood likelihood(double model_error) const;
};
// Counts of all bins of `data`, and of the sample in them when the vertex time is `time`. The order is that
// of Emulator::bins(). The data's dark noise adds to the simulation.
std::vector<BinOfData> count_bins(const EventData& data, const LightSample& sample, double time);
double neg_llh(std::span<const BinOfData> bins, double model_error);

// A cascade measured with independent simulations of itself.
struct Evaluation {
  std::vector<LightSample> samples;
  std::vector<std::vector<BinOfData>> parts;  // of each simulation
  std::vector<BinOfData> bins;                // of all simulations together
  double neg_llh = 0;                         // of these
  std::vector<double> leave_one_out;          // with all but one
};
// Error of a value from what it becomes without each of its parts: the jackknife.
double jackknife_error(std::span<const double> leave_one_out);
// `photons` for each of `repeats` simulations; streams begin at `stream`. At least two.
Evaluation evaluate_cascade(ExpectationModel& light, const EventData& data, const CascadeParameters& cascade,
                            double photons, double oversize, int repeats, std::uint64_t stream,
                            double model_error);

// Of -ln L, a - b, for the same data and equal simulations; error: jackknife over the parts.
struct Difference {
  double value = 0, error = 0;
};
Difference difference(const Evaluation& a, const Evaluation& b);

struct PseudoLikelihood {
  double mean = 0, spread = 0;
};
// What -ln L would be if data and simulation had the same expectation in every bin, give or take the
// log-normal model error: the counts of both together are dealt out again at random, in the ratio of their
// events. Given the sum, that distribution is exact for any expectation, bright or dim. Edges of the bins
// must follow neither the data nor this simulation. Saturated bins keep their value. Pulses have charges that
// scatter more than counts do: EventData::charge_dispersion.
PseudoLikelihood draw_pseudo_data(std::span<const BinOfData> bins, double model_error,
                                  double charge_dispersion, std::uint64_t seed, int draws = 60);

}  // namespace floe
