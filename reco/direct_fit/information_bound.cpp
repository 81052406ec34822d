#include "reco/direct_fit/information_bound.h"

#include <algorithm>
#include <memory>

#include "reco/direct_fit/arrival_bins.h"
#include "reco/direct_fit/calibrated_score.h"
#include "reco/direct_fit/design.h"
#include "reco/direct_fit/expectation_model.h"

namespace floe {
namespace {

constexpr double position_step = 5, direction_step = 8 * degree;  // as the fit's
constexpr double narrow_step = 1.5, narrow_turn = 3 * degree;

using Samples = std::vector<std::unique_ptr<LightSample>>;

std::vector<const LightSample*> pointers(const Samples& samples) {
  std::vector<const LightSample*> result;
  for (const auto& sample : samples) result.push_back(sample.get());
  return result;
}

// A draw of the design with such steps; `events` repetitions of the cascade, but not more photons than that.
struct Draw {
  double position_step, direction_step, oversize, events, most_photons;
  std::uint64_t number;
};

Samples simulate(ExpectationModel& light, const LocalFrame& frame, const FitOptions& options,
                 const Draw& draw) {
  const CascadeParameters cascade = cascade_of(frame.origin(), options.kind);
  const double one = light.photons_per_cascade(cascade, draw.oversize);
  const double photons = options.effort * std::clamp(draw.events * one, 1e6, draw.most_photons);
  const auto design = simplex_design(options.seed, draw.number);
  Samples samples;
  for (std::size_t i = 0; i < design.size(); ++i) {
    Vector7 local = Vector7::Zero();
    local.head<3>() = draw.position_step * design[i].head<3>();
    local.segment<2>(3) = draw.direction_step * design[i].tail<2>();
    samples.push_back(std::make_unique<LightSample>(
        light.sample({cascade_of(frame.at(local), options.kind), photons / double(design.size()),
                      draw.oversize, 100 * draw.number + i})));
  }
  return samples;
}

}  // namespace

Matrix7 cramer_rao_bound(ExpectationModel& light, const CascadeParameters& truth, const Event& event,
                         const FitOptions& options) {
  const LightCentre centre = light_centre(truth, options.kind);
  const LocalFrame frame(centre);
  const double wide = training_oversize(options.oversize);
  const Samples training[2] = {
      simulate(light, frame, options, {position_step, direction_step, wide, 40, 6e6, 1}),
      simulate(light, frame, options, {position_step, direction_step, wide, 40, 6e6, 2})};
  const Samples narrow[2] = {
      simulate(light, frame, options, {narrow_step, narrow_turn, options.oversize, 2, 4e6, 3}),
      simulate(light, frame, options, {narrow_step, narrow_turn, options.oversize, 2, 4e6, 4})};
  std::vector<const LightSample*> fresh[2] = {pointers(narrow[0]), pointers(narrow[1])}, all = fresh[0];
  all.insert(all.end(), fresh[1].begin(), fresh[1].end());

  const EventData measured(*light.model().detector, event, options.selection);
  const EventData data = measured.with_edges(arrival_edges(measured, frame, all, options.kind));
  const MeanIce ice(*light.model().ice);
  EmulatorSettings settings;
  settings.kind = options.kind;
  settings.model_error = 0;
  settings.position_step = position_step;
  settings.direction_step = direction_step;
  settings.threads = options.threads;
  const std::vector<const LightSample*> taught[2] = {pointers(training[0]), pointers(training[1])};
  const ScoreFold folds[2] = {{Emulator(data, ice, centre, taught[0], settings), taught[0], fresh[0]},
                              {Emulator(data, ice, centre, taught[1], settings), taught[1], fresh[1]}};
  const Matrix7 jacobian = frame.jacobian(Vector7::Zero(), options.kind);
  return jacobian * cramer_rao_bound(data, folds) * jacobian.transpose();
}

}  // namespace floe
