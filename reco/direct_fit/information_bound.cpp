#include "reco/direct_fit/information_bound.h"

#include <cmath>
#include <memory>

#include "reco/direct_fit/arrival_bins.h"
#include "reco/direct_fit/calibrated_score.h"
#include "reco/direct_fit/calibration_stages.h"
#include "reco/direct_fit/expectation_model.h"

namespace floe {
namespace {

// The first pass only has to find out how wide the second one's steps should be.
constexpr double first_position_error = 1.5, first_direction_error = 3 * degree;
constexpr PhotonNeed rough_training{20, 1e6, 5e6}, rough_narrow{2, 1e6, 3e6};
constexpr PhotonNeed training{60, 2e6, 2.4e7}, narrow{5, 2e6, 1.2e7};

class BoundAt {
 public:
  BoundAt(ExpectationModel& light, const CascadeParameters& truth, const Event& event,
          const FitOptions& options)
      : light_(light),
        truth_(truth),
        options_(options),
        measured_(*light.model().detector, event, options.selection),
        frame_(light_centre(truth, options.kind)),
        ice_(*light.model().ice) {}

  const LocalFrame& frame() const { return frame_; }

  // Of the local numbers, with simulations as far apart as such errors suggest.
  Matrix7 local(double position_error, double direction_error, const PhotonNeed& for_training,
                const PhotonNeed& for_narrow) {
    auto [wide, fine] = calibration_stages(position_error, direction_error,
                                           widest_step(measured_, frame_.origin()), options_.oversize);
    wide.photons = photons(wide.oversize, for_training);
    fine.photons = photons(fine.oversize, for_narrow);
    Samples taught[2], fresh[2];
    for (int fold = 0; fold < 2; ++fold) taught[fold] = simulate(wide), fresh[fold] = simulate(fine);
    std::vector<const LightSample*> all = pointers(fresh[0]);
    for (const LightSample* sample : pointers(fresh[1])) all.push_back(sample);
    const EventData data = measured_.with_edges(arrival_edges(measured_, frame_, all, options_.kind));

    EmulatorSettings settings;
    settings.kind = options_.kind;
    settings.model_error = 0;
    settings.position_step = wide.position_step;
    settings.direction_step = wide.direction_step;
    settings.threads = options_.threads;
    const auto fold = [&](int i) -> ScoreFold {
      return {Emulator(data, ice_, frame_.origin(), pointers(taught[i]), settings), pointers(taught[i]),
              pointers(fresh[i])};
    };
    const ScoreFold folds[2] = {fold(0), fold(1)};
    return cramer_rao_bound(data, folds);
  }

 private:
  using Samples = std::vector<std::unique_ptr<LightSample>>;

  double photons(double oversize, const PhotonNeed& need) {
    return useful_photons(light_, truth_, measured_.repeats(), oversize, options_.effort, need);
  }

  Samples simulate(const Stage& stage) {
    ++draws_;
    Samples samples;
    for (const LightRequest& request :
         design_requests(frame_, stage, options_.kind, options_.seed, draws_, 100 * draws_))
      samples.push_back(std::make_unique<LightSample>(light_.sample(request)));
    return samples;
  }

  static std::vector<const LightSample*> pointers(const Samples& samples) {
    std::vector<const LightSample*> result;
    for (const auto& sample : samples) result.push_back(sample.get());
    return result;
  }

  ExpectationModel& light_;
  const CascadeParameters& truth_;
  const FitOptions& options_;
  EventData measured_;
  LocalFrame frame_;
  MeanIce ice_;
  std::uint64_t draws_ = 0;
};

}  // namespace

Matrix7 cramer_rao_bound(ExpectationModel& light, const CascadeParameters& truth, const Event& event,
                         const FitOptions& options) {
  BoundAt bound(light, truth, event, options);
  const Matrix7 rough =
      bound.local(first_position_error, first_direction_error, rough_training, rough_narrow);
  const auto error = [](double square, double otherwise) {
    return std::isfinite(square) ? std::sqrt(square) : otherwise;
  };
  const Matrix7 local =
      bound.local(error(rough.topLeftCorner<3, 3>().trace(), first_position_error),
                  error(rough.block<2, 2>(3, 3).trace(), first_direction_error), training, narrow);
  const Matrix7 jacobian = bound.frame().jacobian(Vector7::Zero(), options.kind);
  return jacobian * local * jacobian.transpose();
}

}  // namespace floe
