#include "reco/direct_fit/alike_places.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "reco/direct_fit/one_string.h"
#include "reco/direct_fit/two_cascades.h"

namespace floe {
namespace {

constexpr int turns = 6;
constexpr int parts = 4;                                        // independent simulations of each place
constexpr std::uint64_t first_stream = std::uint64_t{1} << 42;  // beyond those of the search
constexpr double same_direction = 30 * degree;

}  // namespace

std::vector<AlikePlace> alike_places(ExpectationModel& light, const EventData& data, const Vec3& axis,
                                     const FitOptions& options, double photons, CascadeFit& fit) {
  const auto measure = [&](const CascadeParameters& cascade) {
    Evaluation value = evaluate_cascade(light, data, cascade, photons, options.oversize, parts, first_stream,
                                        options.model_error);
    for (const LightSample& sample : value.samples) fit.count_simulation(sample.propagated);
    value.samples.clear();
    return value;
  };
  const double radius = (fit.cascade.position - axis).head<2>().norm();
  const auto is_known = [&](const CascadeParameters& cascade) {
    return fit.other_minimum && distance_between(cascade, fit.other_minimum->cascade) < radius &&
           angle_between(cascade, fit.other_minimum->cascade) < same_direction;
  };
  const Evaluation at_best = measure(fit.cascade);
  const LightCentre best = light_centre(fit.cascade, options.kind);
  std::vector<AlikePlace> places;
  const auto add = [&](const LightCentre& place) {
    const CascadeParameters cascade = cascade_of(place, options.kind);
    if (is_known(cascade)) return;
    places.push_back(
        {cascade, worse_by(measure(cascade), at_best, options.model_error, data.charge_dispersion())});
  };
  for (int i = 0; i < turns; ++i) {
    const LightCentre turned = turned_about(axis, 2 * pi * i / turns, best);
    if (i > 0) add(turned);
    add(mirrored_about(axis, turned));
  }
  return places;
}

Matrix7 with_alike_places(const Matrix7& covariance, const CascadeParameters& best, const Vec3& axis,
                          const std::vector<AlikePlace>& places) {
  const Eigen::Vector2d outward = (best.position - axis).head<2>();
  const double radius = outward.norm();
  if (radius == 0 || !covariance.allFinite()) return covariance;
  const Eigen::Vector2d along(-outward.y() / radius, outward.x() / radius);
  const double error = std::sqrt(along.dot(covariance.topLeftCorner<2, 2>() * along)) / radius;  // [rad]
  // Each has the errors of the best, unless these are wider than a sixth of a circle.
  const double size = std::min(1.0, 2 * pi / turns / (std::sqrt(2 * pi) * error));
  const auto gaussian = covariance.ldlt();
  Matrix7 squares = Matrix7::Zero();
  double all = 1;
  for (const AlikePlace& place : places) {
    const OtherMinimum other{place.cascade, std::max(0.0, place.worse.value), place.worse.error};
    if (!competes(other)) continue;
    const Vector7 way = displacement(best, place.cascade);
    const double share = share_of(other), known = std::exp(-0.5 * way.dot(gaussian.solve(way)));
    const double odds = size * std::max(0.0, share / (1 - share) - known);
    all += odds;
    squares += odds * way * way.transpose();
  }
  return covariance + squares / all;
}

}  // namespace floe
