#include "reco/diagnose/displaced_strings.h"

#include <memory>

#include "reco/ice_fit/run_likelihood.h"
#include "reco/ice_fit/smooth_slopes.h"

namespace floe {

namespace {

constexpr double reach = 2.5;  // [m] each way; light changes by about a tenth

Model displaced(const Model& model, int except, const Vec3& offset) {
  std::vector<Module> modules = model.detector->modules();
  for (Module& module : modules)
    if (module.id.string != except) module.position += offset;
  auto holes = model.detector->strings();
  for (auto& [string, hole] : holes)
    if (string != except) hole += offset.head<2>();
  Model moved = model;
  moved.detector =
      std::make_shared<const Detector>(model.detector->name(), std::move(modules), std::move(holes));
  return moved;
}

}  // namespace

DisplacedStrings displaced_strings(const Model& model, const RunRequest& request, const RunBins& bins,
                                   double time_zero, const RunLight& light, double share) {
  DisplacedStrings result;
  RunRequest less = request;
  less.photons *= share;
  RunLight slopes = light;
  slopes.symmetric.assign(3, 0);
  for (LightFold& fold : slopes.folds) {
    fold.slopes = Eigen::MatrixXd::Zero(bins.size(), 3);
    fold.slope_squares = fold.slopes;
  }
  const auto displaced_by = [&](const Vec3& offset) {
    SimulatedRun simulated = simulate_run(displaced(model, request.run.module.string, offset), less);
    delay(simulated, time_zero);
    result.propagated += simulated.propagated;
    return count_light(simulated, bins, less.photons, 0);
  };
  // Relative to a simulation of their own, so that nothing of the run's noise is in the slopes; not to the
  // mean of the displaced: early light of near modules changes so much that it grows on average.
  const RunLight in_place = displaced_by(Vec3::Zero());
  for (int fold = 0; fold < 2; ++fold) slopes.folds[fold].counts = in_place.folds[fold].counts / share;
  for (int axis = 0; axis < 3; ++axis)
    for (const double way : {-1.0, 1.0}) {
      const RunLight counted = displaced_by(way * reach * Vec3::Unit(axis));
      const double factor = way / (2 * reach * share);
      for (int fold = 0; fold < 2; ++fold) {
        slopes.folds[fold].slopes.col(axis) += factor * counted.folds[fold].counts;
        slopes.folds[fold].slope_squares.col(axis) += factor * factor * counted.folds[fold].counts;
      }
    }
  for (int fold = 0; fold < 2; ++fold) {
    LightFold& own = slopes.folds[fold];
    own.dwell = own.counts.replicate(1, 3);
    result.raw[static_cast<std::size_t>(fold)] = own.slopes.array().colwise() / own.counts.array().max(1);
  }
  const SmoothSlopes smooth = smooth_slopes(slopes.folds, slopes.places, slopes.symmetric);
  result.fold = {smooth.fold[0], smooth.fold[1]};
  return result;
}

}  // namespace floe
