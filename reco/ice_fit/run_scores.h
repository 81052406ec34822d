// Runs of flasher data as the estimating equations of an ice fit: each simulated in the ice where the fit
// stands, with its brightness and time zero as they are known so far.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "propagation/model.h"
#include "reco/ice_fit/ice_fit.h"
#include "reco/ice_fit/ice_point.h"
#include "reco/ice_fit/receiver_efficiencies.h"
#include "reco/ice_fit/run_bins.h"
#include "reco/ice_fit/run_data.h"
#include "reco/ice_fit/run_light.h"
#include "reco/ice_fit/score_system.h"

namespace floe {

class RunScores {
 public:
  // Keeps a reference to the options.
  RunScores(FlasherData data, const IceFitOptions& options);

  std::size_t count() const { return data_.runs.size(); }
  const std::string& name(std::size_t run) const { return data_.runs[run].name; }
  // What look_first() has left out of the data, a sentence each.
  const std::vector<std::string>& left_out() const { return data_.left_out; }
  double wavelength() const { return data_.runs.front().run.wavelength; }  // all have the same [nm]
  std::uint64_t propagated() const { return propagated_; }                 // photons so far

  // How much light of each run is seen, and which receivers cannot be right. Runs that no receiver is left of
  // are left out, unless runs must keep their numbers. Throws NoResult when no run is left.
  void look_first(const Model& model, bool runs_keep_numbers);
  // Every round has random numbers of its own. The first may be far from the data; from the second one on,
  // bins stay and slopes gather.
  void begin_round(const Model& model);
  // Efficiencies of the receivers of this round's bins, behind `first` other columns; none where they are
  // known.
  EfficiencyColumns efficiency_columns(int first) const;
  // Adds a run. Columns of the system: the point's parameters, brightness and time zero of each run,
  // efficiencies.
  void add(const IcePoint& point, std::size_t run, std::size_t parameters,
           const EfficiencyColumns& efficiencies, ScoreSystem& system);
  // Whether light changes in proportion to such a step of brightness and time zero.
  bool is_short(const Eigen::VectorXd& step, std::size_t parameters) const;
  // By a solution of the system's.
  void step_nuisances(const Eigen::VectorXd& step, std::size_t parameters);
  // With random numbers of its own, as rounds have them.
  void begin_judging() { ++round_; }
  // How well the model fits a run.
  RunResult judge(const Model& model, std::size_t run);

 private:
  // What is known of a run between rounds.
  struct State {
    double hits_per_photon = 0;  // simulated, of used receivers
    double brightness = 0;       // N of all flashes together; 0: not yet known
    double time_zero = 0;        // [ns]
    RunBins bins;
    RunLight seen;  // of the rounds from the second on, in these bins
  };

  RunRequest request(std::size_t run, std::uint64_t purpose, double photons) const;
  double photons_of(std::size_t run) const;
  RunBins bins_of(const Model& model, std::size_t run);

  FlasherData data_;
  const IceFitOptions& options_;
  std::vector<State> states_;
  int round_ = 0;
  std::uint64_t propagated_ = 0;
};

}  // namespace floe
