// The direct fit's way through parameter space: rounds of simulation, emulation and a local fit.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reco/direct_fit/average_place.h"
#include "reco/direct_fit/calibrated_score.h"
#include "reco/direct_fit/calibration_stages.h"
#include "reco/direct_fit/cascade_fit.h"
#include "reco/direct_fit/expectation_model.h"
#include "reco/direct_fit/goodness_of_fit.h"
#include "reco/direct_fit/local_fit.h"
#include "reco/direct_fit/point_light.h"
#include "reco/direct_fit/seed.h"
#include "reco/event_data.h"

namespace floe {

class Search {
 public:
  // All references must outlive the search. Counts what it costs into `result`.
  Search(ExpectationModel& light, const EventData& data, const MeanIce& ice, const FitOptions& options,
         CascadeFit& result, const Progress& progress);

  // The last step of a search, kept for who wants to know more than its solution.
  struct Calibration {
    EventData data;
    double position_error;
    double excess_scatter;  // of the data's counts beyond Poisson's, in variance: charges, widened modules
    std::vector<ScoreFold> folds;  // two; they refer to `data` and to the search's simulations
    ScoreSolution solution;
  };
  // Errors as far as they are known, how far apart and with how many photons to simulate in the next
  // calibration.
  struct CalibrationNeed {
    PlaceErrors errors;
    double reach = 1, training = 1, judging = 1;  // times the usual
  };
  // Where the search ends. Coarse rounds far apart and with wide modules, fine ones at the wanted oversize;
  // earlier simulations near by are used again. When a fine round has moved no more than its design is
  // wide, the calibrated score (reco/direct_fit/calibrated_score.h) makes the last step.
  struct End {
    LightCentre light;
    Matrix7 covariance;  // of the local numbers around `light`
    // The part of it that the noise of the simulations made, as fresh ones show; none where it is not known.
    std::optional<Matrix7> simulation_covariance = {};
    bool converged = false;
    double pull = std::numeric_limits<double>::infinity();  // largest last step in units of its error
    bool unsolved = false;                                  // the calibrated score has no solution
    std::string trouble;                                    // in words, when it did not converge
    std::vector<std::vector<double>> edges;  // of time bins that follow the light there; see arrival_edges
    std::shared_ptr<const Calibration> calibration;  // of the last step; empty when the score has no solution
    CalibrationNeed need;                            // of a further one
    // When the calibrated score has a solution: the likelihood around it. Search and end must outlive it.
    std::optional<ScoreLikelihood> likelihood() const;
    // See InformationBound; infinite without a calibrated score.
    double weight_loss() const;
  };
  End from_scratch(const PointSeed& point);
  End from(const CascadeParameters& start);

  // Worth simulating for a cascade of this oversize.
  double photons_for(const CascadeParameters& cascade, double oversize, const PhotonNeed& need);

 private:
  struct RoundEnd {
    LightCentre light;
    LocalFit fit;
    Vector7 errors;
    double pull;  // largest step in units of its error
    bool within;  // inside the region that the emulator is trusted with
  };
  // `follow_light`: bins of the expected light, which needs to be roughly right, instead of the data's
  // blocks.
  RoundEnd round(const LightCentre& origin, const Stage& stage, bool follow_light);
  // What simulations are for. The emulators' noise must be independent, of each other and of the narrow
  // simulations that judge them.
  enum class Purpose { first_emulator, second_emulator, first_judge, second_judge };
  void simulate(const LocalFrame& frame, const Stage& stage, Purpose purpose);
  // Those near by, of this oversize and made for this.
  std::vector<const LightSample*> near(const LocalFrame& frame, const Stage& stage, Purpose purpose) const;
  Emulator emulate(const EventData& data, const LightCentre& origin, const Stage& stage,
                   std::span<const LightSample* const> samples) const;
  static bool has_settled(const RoundEnd& end, const Stage& stage);
  RoundEnd settle(LightCentre origin, Stage stage, int most, bool follow_light);
  RoundEnd settle_roughly(const LightCentre& light);
  RoundEnd sharpen(const RoundEnd& rough);
  RoundEnd sharpen_within_minimum(const RoundEnd& rough);
  // Calibrations until one moves no further. Gives up, unconverged, on the way into one of the minima that
  // are known.
  End finish(const RoundEnd& rough, std::span<const End> known = {});
  void calibrate(End& end);
  // What calibrations that found nothing leave: the mean of where they went, or the emulator's minimum.
  void end_without_solution(End& end, std::span<const LightCentre> visited);
  static std::optional<AveragePlace> walked_about(std::span<const LightCentre> visited);
  End refined(const End& end);
  std::vector<const LightSample*> enough(const LocalFrame& frame, Stage stage, double photons,
                                         Purpose purpose);
  // A minimum on the way, measured by fresh simulations.
  struct Minimum {
    RoundEnd end;
    Evaluation value;
  };
  static bool same_minimum(const LightCentre& a, const LightCentre& b);
  Evaluation measure(const LightCentre& light, double oversize, double photons, double model_error);
  static std::vector<Minimum> distinct(std::span<const RoundEnd> ends);
  static std::vector<RoundEnd> ends_of(std::span<const Minimum> minima);
  // Sorts ends by what fresh simulations of so many photons say, with the model error of ends that have not
  // settled, best first; ends that came together count once, and those worse in -ln L by more than its noise
  // and `slack` times the best are left behind, as are all but the first `most`.
  std::vector<Minimum> contest(std::span<const RoundEnd> ends, const PhotonNeed& need, double slack,
                               std::size_t most = 2);
  // Beside these, where the best would be if it went the other way: scattered light tells where its middle is
  // sooner than from which side it came. Leaves no trace but its costs where that leads nowhere.
  std::vector<Minimum> other_way(std::vector<Minimum> minima);
  // Beside these, where the best would be at other azimuths about the only string with light, or mirrored in
  // the plane through the two, if there is one.
  std::vector<Minimum> around_only_string(std::vector<Minimum> minima);
  End from_starts(std::span<const LightCentre> starts);
  End best_of(std::span<const Minimum> minima);
  // By equal simulations of all ends, with the sums of two_cascades.h.
  struct Ranking {
    std::size_t best = 0;
    std::vector<Difference> worse;  // than the best, in -ln L
  };
  Ranking tell_apart(std::span<const End> ends);
  Ranking tell_apart(std::span<const End> ends, const PhotonNeed& need);
  Stage rough_stage(const LightCentre& light);
  void report(double within_round, const std::string& what);

  ExpectationModel& light_;
  const EventData& data_;
  const MeanIce& ice_;
  const FitOptions& options_;
  CascadeFit& result_;
  const Progress& progress_;
  struct Simulation {
    LightSample sample;
    Purpose purpose;
  };
  std::vector<std::unique_ptr<Simulation>> simulations_;
  std::uint64_t stream_ = 0, draws_ = 0, contests_ = 0;
};

}  // namespace floe
