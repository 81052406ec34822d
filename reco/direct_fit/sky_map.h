// A map of -ln L over directions.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "data/base/vec3.h"
#include "reco/direct_fit/score_likelihood.h"

namespace floe {

// A point of the plane that touches the sphere of origins at the map's centre (exponential map: distances and
// directions from the centre are those on the sphere) [rad]: along rising azimuth, along rising zenith.
using TangentPoint = std::pair<double, double>;

// Level of delta -ln L whose region holds this share, 0 <= share < 1, of probability: Wilks' theorem for two
// degrees of freedom.
double level_of(double share);

// Square pixels on the tangent plane; columns along rising azimuth, rows along rising zenith. The middle
// pixel is the best direction. Directions are those from which the cascade comes.
struct SkyMap {
  int pixels = 0;                     // in a row and in a column, odd
  double step = 0;                    // from pixel to pixel [rad]
  double zenith = 0, azimuth = 0;     // of the centre [rad]
  std::vector<double> delta_neg_llh;  // pixels x pixels, row by row: the lowest -ln L at each direction,
                                      // whatever the other parameters are, above the best; NaN: not known
  // The fit's errors know of more than this minimum (CascadeFit::errors_beyond_likelihood): the regions of
  // the map are too small.
  bool errors_are_wider = false;

  double at(int row, int column) const {
    return delta_neg_llh[static_cast<std::size_t>(row) * static_cast<std::size_t>(pixels) +
                         static_cast<std::size_t>(column)];
  }
  TangentPoint point_at(int row, int column) const;
  Origin direction_at(int row, int column) const { return direction_of(point_at(row, column)); }

  Origin direction_of(const TangentPoint& point) const;
  TangentPoint point_of(const Origin& origin) const;  // the inverse

  // Of the region that holds this share of probability [square degrees].
  double area(double share) const;
  // Whether that region reaches the end of the map, or of what is known: its area is a lower limit.
  bool is_cut(double share) const;
};

// Map of `pixels` x `pixels` (odd, at least 3; UsageError otherwise) over four standard errors on both sides,
// along the wider axis of the direction's covariance, and not beyond what is trusted. Takes a few evaluations
// of the likelihood a pixel. `threads` 0: all cores; the result does not depend on it.
SkyMap make_sky_map(const ScoreLikelihood& likelihood, int pixels, int threads);

// Lines of this delta -ln L (marching squares): closed ones end in the point in which they begin, others at
// the end of the map or of what is known.
std::vector<std::vector<TangentPoint>> contours(const SkyMap& map, double level);

// "90% in 3.2 deg2", or "90% in more than 3.2 deg2" when the region is cut.
std::string words_of_area(const SkyMap& map, double share);
// A line with the areas that hold 50% and 90%, for people.
std::string describe(const SkyMap& map);

}  // namespace floe
