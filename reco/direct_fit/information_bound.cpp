#include "reco/direct_fit/information_bound.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <memory>

#include "reco/direct_fit/arrival_bins.h"
#include "reco/direct_fit/calibrated_score.h"
#include "reco/direct_fit/calibration_stages.h"
#include "reco/direct_fit/expectation_model.h"

namespace floe {
namespace {

constexpr PlaceErrors first_errors{1.5, 3 * degree};  // only to find out how wide steps should be
constexpr PhotonNeed first_training{60, 1e6, 5e6}, training{200, 2e6, 2e7}, narrow{5, 2e6, 6e6};
constexpr int most_passes = 5;
constexpr double acceptable_loss = 1.25;  // what is left is taken out

class BoundSimulations {
 public:
  BoundSimulations(ExpectationModel& light, const CascadeParameters& truth, const EventData& data,
                   const FitOptions& options, CascadeFit* count_into)
      : light_(light),
        truth_(truth),
        options_(options),
        count_into_(count_into),
        measured_(data),
        frame_(light_centre(truth, options.kind)),
        ice_(*light.model().ice) {}

  const LocalFrame& frame() const { return frame_; }

  // Of the local numbers, with more simulations as far apart as such errors suggest.
  InformationBound improve(const PlaceErrors& errors, const PhotonNeed& for_training) {
    auto [wide, fine] = calibration_stages(measured_, frame_.origin(), errors, 1, options_.oversize);
    wide.photons = photons(wide.oversize, for_training);
    fine.photons = photons(fine.oversize, narrow);
    std::vector<const LightSample*> all;
    for (int fold = 0; fold < 2; ++fold) {
      simulate(wide, taught_[fold]);
      simulate(fine, fresh_[fold]);
      all.insert(all.end(), fresh_[fold].begin(), fresh_[fold].end());
    }
    const EventData data = measured_.with_edges(arrival_edges(measured_, frame_, all, options_.kind));

    EmulatorSettings settings;
    settings.kind = options_.kind;
    settings.model_error = 0;
    settings.position_step = wide.position_step;
    settings.direction_step = wide.direction_step;
    settings.threads = options_.threads;
    const auto fold = [&](int i) -> ScoreFold {
      return {Emulator(data, ice_, frame_.origin(), taught_[i], settings), taught_[i], fresh_[i]};
    };
    const ScoreFold folds[2] = {fold(0), fold(1)};
    return cramer_rao_bound(data, folds);
  }

 private:
  double photons(double oversize, const PhotonNeed& need) {
    return useful_photons(light_, truth_, measured_, oversize, options_.effort, need);
  }

  void simulate(const Stage& stage, std::vector<const LightSample*>& samples) {
    ++draws_;
    for (const LightRequest& request :
         design_requests(frame_, stage, options_.kind, options_.seed, draws_, 100 * draws_)) {
      samples_.push_back(std::make_unique<LightSample>(light_.sample(request)));
      samples.push_back(samples_.back().get());
      if (count_into_) count_into_->count_simulation(samples_.back()->propagated);
    }
  }

  ExpectationModel& light_;
  const CascadeParameters& truth_;
  const FitOptions& options_;
  CascadeFit* count_into_;
  const EventData& measured_;
  LocalFrame frame_;
  MeanIce ice_;
  std::vector<std::unique_ptr<LightSample>> samples_;
  std::vector<const LightSample*> taught_[2], fresh_[2];  // of the two folds
  std::uint64_t draws_ = 0;
};

}  // namespace

Matrix7 cramer_rao_bound(ExpectationModel& light, const CascadeParameters& truth, const EventData& data,
                         const FitOptions& options, CascadeFit* count_into) {
  BoundSimulations bound(light, truth, data, options, count_into);
  InformationBound found = bound.improve(first_errors, first_training);
  for (int pass = 1; pass < most_passes && (pass == 1 || found.weight_loss > acceptable_loss); ++pass) {
    const InformationBound now =
        bound.improve(found.covariance.allFinite() ? place_errors(found.covariance) : first_errors, training);
    // Steps that follow the errors of weights that are mostly noise only make them worse.
    if (pass == 1 || now.weight_loss < found.weight_loss) found = now;
  }
  const Matrix7 jacobian = bound.frame().jacobian(Vector7::Zero(), options.kind);
  return jacobian * found.covariance * jacobian.transpose();
}

Matrix7 no_less_than(const Matrix7& bound, const Matrix7& covariance) {
  if (!bound.allFinite() || !covariance.allFinite()) return covariance;
  const Eigen::LLT<Matrix7> root(bound);
  if (root.info() != Eigen::Success) return covariance;
  // Where the bound is 1 in all directions, variances below 1 are raised.
  const Matrix7 half = root.matrixL().solve(covariance);
  const Eigen::SelfAdjointEigenSolver<Matrix7> parts(root.matrixL().solve(half.transpose()));
  const Vector7 raised = parts.eigenvalues().cwiseMax(1.0);
  const Matrix7 directions = root.matrixL() * parts.eigenvectors();
  return directions * raised.asDiagonal() * directions.transpose();
}

}  // namespace floe
