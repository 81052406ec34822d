#include "reco/direct_fit/other_minimum.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace floe {
namespace {

constexpr double competing_errors = 1;  // more, where the difference is not known better
// An end that is about an error off its minimum in each of seven numbers has lost half a chi-square of seven,
// known to its square root.
constexpr double lost_by_unsolved = 3.5;

}  // namespace

bool competes(const OtherMinimum& other) {
  return other.delta_neg_llh < competing_neg_llh + competing_errors * other.delta_neg_llh_error;
}

std::optional<OtherMinimum> competing_minimum(std::span<const OtherEnd> ends) {
  std::optional<OtherMinimum> nearest;
  for (const OtherEnd& end : ends) {
    const double lost = end.unsolved ? lost_by_unsolved : 0;
    const double value = std::max(0.0, end.worse - lost), error = std::hypot(end.error, std::sqrt(lost));
    const OtherMinimum other{end.cascade, value, error};
    if (competes(other) && (!nearest || value < nearest->delta_neg_llh)) nearest = other;
  }
  return nearest;
}

double share_of(const OtherMinimum& other) {
  const double variance = other.delta_neg_llh_error * other.delta_neg_llh_error;
  return 1 / (1 + std::exp(other.delta_neg_llh / std::sqrt(1 + pi / 8 * variance)));
}

Matrix7 with_other_minimum(const Matrix7& covariance, const CascadeParameters& best,
                           const OtherMinimum& other) {
  const Vector7 way = displacement(best, other.cascade);
  return covariance + share_of(other) * way * way.transpose();
}

std::string describe(const OtherMinimum& other) {
  char text[240];
  const CascadeParameters& c = other.cascade;
  std::snprintf(
      text, sizeof text,
      "  another minimum is hardly worse: -ln L larger by %.1f +- %.1f at x %.1f y %.1f z %.1f m, zenith "
      "%.0f azimuth %.0f deg, %.3g GeV\n",
      other.delta_neg_llh, other.delta_neg_llh_error, c.position.x(), c.position.y(), c.position.z(),
      c.zenith / degree, c.azimuth / degree, c.energy);
  return text;
}

}  // namespace floe
