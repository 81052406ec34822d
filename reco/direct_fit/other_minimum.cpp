#include "reco/direct_fit/other_minimum.h"

#include <cmath>
#include <cstdio>

namespace floe {

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
