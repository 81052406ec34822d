#include "reco/direct_fit/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reco/direct_fit/constrained_score.h"

namespace floe {
namespace {

constexpr int azimuth_index = 5;
constexpr double height_tolerance = 0.003;  // of sqrt(2 delta(-ln L))
constexpr double least_bracket = 0.01;      // [errors]
constexpr double longest_leap = 3;          // factor, beyond the values tried so far
constexpr int most_trials = 25;
constexpr double infinity = std::numeric_limits<double>::infinity();

// One of the cascade's seven parameters. They are functions of the local numbers: the vertex depends on
// direction and energy, too.
class Profile {
 public:
  Profile(const ScoreLikelihood& likelihood, CascadeKind kind, int parameter)
      : likelihood_(likelihood), kind_(kind), parameter_(parameter), best_(value_at(likelihood.best)) {
    const Vector7 slope = likelihood.frame.jacobian(likelihood.best, kind).row(parameter);
    error_ = std::sqrt(slope.dot(likelihood.covariance * slope));
  }

  ProfileInterval interval() const { return {edge(-1), edge(+1)}; }

 private:
  double value_at(const Vector7& p) const {
    return to_vector(cascade_of(likelihood_.frame.at(p), kind_))(parameter_);
  }

  // All cascades with this value.
  Surface surface(double value) const {
    return [this, value](const Vector7& p) {
      const double away = value_at(p) - value;
      SurfaceDistance distance;
      distance.value.setConstant(
          1, (parameter_ == azimuth_index ? std::remainder(away, 2 * pi) : away) / error_);
      distance.slope = likelihood_.frame.jacobian(p, kind_).row(parameter_) / error_;
      return distance;
    };
  }

  // The lowest point `errors` away from the solution, sought from `start`.
  std::optional<LowestPoint> lowest(double errors, const Vector7& start) const {
    if (parameter_ == azimuth_index && std::abs(errors) * error_ > pi) return {};
    return lowest_on(surface(best_ + errors * error_), start, likelihood_);
  }

  // Where the profile is 1/2 high. The root of its height is nearly a straight line, so that the first trial
  // is close and secants find the rest.
  double edge(int side) const {
    double inside = 0, inside_height = 0, outside = infinity, outside_height = infinity, trial = 1;
    Vector7 start = likelihood_.best;
    for (int i = 0; i < most_trials && outside - inside > least_bracket; ++i) {
      const std::optional<LowestPoint> found = lowest(side * trial, start);
      const double height = found ? std::sqrt(2 * found->neg_llh) : infinity;
      if (std::abs(height - 1) < height_tolerance) return best_ + side * trial * error_;
      if (height < 1) {
        inside = trial, inside_height = height, start = found->p;
      } else {
        outside = trial, outside_height = height;
      }
      if (std::isfinite(outside_height))
        trial = inside + (1 - inside_height) / (outside_height - inside_height) * (outside - inside);
      else if (std::isfinite(outside))
        trial = 0.5 * (inside + outside);
      else
        trial = inside * std::min(longest_leap, 1 / inside_height);
    }
    // A narrow bracket is an edge where the sums are rough, and none where they end.
    return std::isfinite(outside_height) ? best_ + side * trial * error_
                                         : std::numeric_limits<double>::quiet_NaN();
  }

  const ScoreLikelihood& likelihood_;
  CascadeKind kind_;
  int parameter_;
  double best_, error_ = 0;
};

std::string words(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "?";
}

}  // namespace

ProfileIntervals profile_intervals(const ScoreLikelihood& likelihood, CascadeKind kind) {
  ProfileIntervals intervals;
  for (int i = 0; i < 7; ++i)
    intervals[static_cast<std::size_t>(i)] = Profile(likelihood, kind, i).interval();
  return intervals;
}

std::string describe(const ProfileIntervals& intervals) {
  std::string text = "  68% of the profile likelihood:\n";
  for (std::size_t i = 0; i < 7; ++i) {
    const ShownParameter& shown = shown_parameters[i];
    text += fmt::format("  {:<8} {:>10} to {} {}\n", shown.name,
                        words(intervals[i].low / shown.unit_size, shown.digits),
                        words(intervals[i].high / shown.unit_size, shown.digits), shown.unit);
  }
  return text;
}

}  // namespace floe
