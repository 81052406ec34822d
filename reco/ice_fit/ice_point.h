// A model at a point in the space of a fit's parameters, and how the light of runs depends on them there.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "propagation/model.h"
#include "reco/ice_fit/acceptance_slopes.h"
#include "reco/ice_fit/ice_parameter.h"
#include "reco/ice_fit/module_change.h"
#include "reco/ice_fit/run_bins.h"
#include "reco/ice_fit/run_light.h"
#include "reco/ice_fit/score_map.h"

namespace floe {

// Of each simulation of a pair. With half as many, slopes of a flow azimuth that was 12 standard deviations
// off were mostly noise.
inline constexpr double enough_pair_hits = 1.5e4;

// How slopes are found that weights cannot give: from two simulations with the same random numbers.
struct PairPlan {
  double reach = 0.5;     // from the point, each way, in the parameter's scale, as far as its limits allow
  double light = 1;       // of each simulation, in units of the run's own
  double least_hits = 0;  // of each simulation, as far as the light of the run's own goes
  double one_sided = 1;   // times that where a limit leaves one side only: that is where effects set in
  // 0: with the random numbers of the run itself; otherwise added to its stream, so that slopes are
  // independent of the run's counts.
  std::uint64_t stream = 0;

  // Light of each simulation, in units of a run's own that has so many hits.
  double share(double hits) const;
};

// Slopes in the strength of birefringence follow from the turns of light where it is at least so strong, and
// from pairs below: the noise of turns goes with its inverse.
inline constexpr double enough_strength_for_turns = 0.7;

class IcePoint {
 public:
  // `wavelength`: of the runs [nm]. `turns_from`: strength, see above; infinite where pairs have light enough
  // to be better than turns in any case.
  IcePoint(const Model& base, const std::vector<IceParameter>& parameters, std::vector<double> numbers,
           double wavelength, double turns_from = enough_strength_for_turns);

  const Model& model() const { return model_; }
  // The model with one of the numbers changed.
  Model moved(std::size_t parameter, double step) const;
  // By at most so much: the step is halved until it leads to ice that can be. Throws InputError where none
  // does.
  Model moved_towards(std::size_t parameter, double& step) const;

  // Counts and slopes in all parameters of a simulated run of this model, whose hits were moved by
  // `time_zero` [ns].
  struct Light {
    RunLight light;
    std::uint64_t propagated = 0;  // photons, for the pairs
  };
  Light light(const RunRequest& request, const SimulatedRun& simulated, const RunBins& bins, double time_zero,
              const PairPlan& plan = {}) const;

 private:
  struct OfAcceptance {
    std::size_t parameter;
    AcceptanceChange change;
    double step;
  };
  struct OfNoise {
    std::size_t parameter;
    double slope;  // of the rate
  };
  struct OfClocks {
    std::size_t parameter;
    std::vector<double> later;  // by module, as the parameter grows by one [ns]
  };
  void add_clocks(const SimulatedRun& simulated, const RunBins& bins, const OfClocks& slope,
                  RunLight& light) const;
  void add_noise(const RunRequest& request, const RunBins& bins, const OfNoise& slope, RunLight& light) const;
  void add_acceptance(const SimulatedRun& simulated, const RunBins& bins, const OfAcceptance& slope,
                      RunLight& light) const;
  std::uint64_t add_pair(const RunRequest& request, const RunBins& bins, double time_zero,
                         const PairPlan& plan, std::size_t parameter, RunLight& light) const;
  // Light of modules that a parameter does not touch dwells nowhere where it acts.
  void leave_out_untouched(const RunRequest& request, const RunBins& bins, RunLight& light) const;

  const Model& base_;
  const std::vector<IceParameter>& parameters_;
  std::vector<double> numbers_;
  Model model_;
  ScoreMap map_;
  std::vector<OfAcceptance> of_acceptance_;
  std::vector<OfNoise> of_noise_;
  std::vector<OfClocks> of_clocks_;
  // By parameter, where it changes nothing but modules one by one.
  std::vector<std::optional<ModuleChange>> of_modules_;
  std::vector<std::size_t> pairs_;  // all other parameters that weights of paths cannot express
};

}  // namespace floe
