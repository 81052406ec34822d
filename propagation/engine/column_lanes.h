// Lanes whose segments meet hole-ice columns: few, and looked after one at a time around what all lanes do
// together.
#pragma once

#include <vector>

#include "propagation/engine/hole_ice.h"
#include "propagation/engine/lane_steps.h"

namespace floe {

// The columns' part of one walk's steps, in this order: draw_depths, cut, advance, scatter, and `ended` for
// every lane whose photon has ended. Of a lane that is cut at a column's surface the next step goes on with
// the depth to its scatter that is left; a lane inside a column scatters as the column does.
class ColumnLanes {
 public:
  ColumnLanes(const HoleIceColumns& columns, const IceView& ice);

  // Draws the optical depths to the next scatter of all lanes but those that go on.
  void draw_depths(Lanes& lanes);
  // Cuts the segments at the surfaces of columns.
  void cut(Lanes& lanes);
  void advance(Lanes& lanes);
  void scatter(Lanes& lanes);
  void ended(int lane);

  // Of the step under way: lanes that neither scatter nor end.
  int going_on() const { return static_cast<int>(going_on_.size()); }
  // The optical depth of absorption that a lane has left `distance` metres along its piece.
  float absorption_depth_at(const Lanes& lanes, int lane, float distance) const;

 private:
  struct CutLane {
    int lane;
    bool in_column, at_limit;
  };

  void cut_lane(Lanes& lanes, int lane);

  const HoleIceColumns& columns_;
  const IceView& ice_;
  ScatteringFunction<float> scattering_;
  std::vector<CutLane> cuts_;
  std::vector<int> going_on_;
};

}  // namespace floe
