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
  double neg_llh = 0;                 // of all simulations together
  std::vector<double> leave_one_out;  // with all but one
};
// Error of a value from what it becomes without each of its parts: the jackknife.
double jackknife_error(std::span<const double> leave_one_out);
// `photons` for each of `repeats` simulations; streams begin at `stream`. At least two.
Evaluation evaluate_cascade(ExpectationModel& light, const EventData& data, const CascadeParameters& cascade,
                            double photons, double oversize, int repeats, std::uint64_t stream,
                            double model_error);

struct PseudoLikelihood {
  double mean = 0, spread = 0;
};
// What evaluate_cascade would find for events that are as the cascade simulated in `evaluation`, with the
// log-normal model error in every bin: draws data and simulations, and bins the data by their own Bayesian
// blocks as was done with the measured ones, since bins that follow fluctuations see more of them. Small
// counts are treated as what they are, where chi-square theory fails. `vertex_time` is that of the fit.
PseudoLikelihood draw_pseudo_data(const EventData& data, const Evaluation& evaluation, double vertex_time,
                                  double model_error, std::uint64_t seed, int threads, int draws = 30);

}  // namespace floe
