// How far a photon may walk before the geometry matters again.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/module_columns.h"

namespace floe {

// What a photon at a point may meet: it can walk `free` metres, in any direction and through any number
// of scatters, before it can meet any widened module, and `free_of_others` before it can meet one that is not
// in the column of `nearest` (an index into Detector::modules()). Both are lower bounds, at least 0.
struct ModuleClearance {
  float free, free_of_others;
  std::uint32_t nearest;
};

// The clearance of any point, tabulated. A widened module of oversize X is met within X module radii of its
// centre.
//
// A horizontal grid knows for each cell the nearest column of modules, how far it is at least, and how far
// the second nearest is; a table along the nearest column knows its nearest module and how far above or below
// that is.
class ClearanceMap {
 public:
  // Throws UsageError unless 1 <= oversize <= 100.
  ClearanceMap(const Detector& detector, double oversize);
  ClearanceMap(const ClearanceMap&) = delete;  // the view points into the tables
  ClearanceMap& operator=(const ClearanceMap&) = delete;

  // Branch-free, so that a loop over points becomes vector code.
  ModuleClearance at(float x, float y, float z) const { return view_.at(x, y, z); }
  float operator()(const Vec3f& position) const { return at(position.x(), position.y(), position.z()).free; }

  // The tables on plain pointers, valid as long as the map.
  class View {
   public:
    ModuleClearance at(float x, float y, float z) const {
      const Distances found = distances(x, y, z);
      return {larger(0, std::sqrt(found.square) - reach_), larger(0, std::sqrt(found.others_square) - reach_),
              found.nearest};
    }

    // Squared distances to the nearest module's centre and to that of the nearest module in another column:
    // a photon that walks L metres may meet one if (L + reach())^2 is at least as much.
    struct Distances {
      float square, others_square;
      std::uint32_t nearest;
    };
    Distances distances(float x, float y, float z) const {
      const float beyond = outside(z, low_z, high_z);
      const float west = outside(x, low_x, high_x), south = outside(y, low_y, high_y);
      const float column = (x - x0) * per_cell, row = (y - y0) * per_cell;
      const float aside_grid = larger(larger(-column, column - last_column), larger(-row, row - last_row));
      const auto in_columns = static_cast<std::int32_t>(inside(column, last_column));
      const auto in_rows = static_cast<std::int32_t>(inside(row, last_row));
      const std::uint32_t cell = cells[in_rows * columns + in_columns];
      const float to_first = step * static_cast<float>(static_cast<std::int32_t>(cell & 255));
      const float to_second = step * static_cast<float>(static_cast<std::int32_t>((cell >> 8) & 255));
      const auto place = static_cast<std::int32_t>(inside((z - low_z) * per_slice, last_slice));
      const std::uint32_t slice_entry = slices[static_cast<std::int32_t>(cell >> 16) * slice_count + place];
      const float gap = beyond + step * static_cast<float>(static_cast<std::int32_t>(slice_entry & 255));
      const float others = to_second * to_second + beyond * beyond;
      const float near = smaller(to_first * to_first + gap * gap, others);
      // Outside the grid no module is nearer than the box that holds them all.
      const float box = west * west + south * south + beyond * beyond;
      return {aside_grid > 0 ? box : near, aside_grid > 0 ? box : others, slice_entry >> 8};
    }
    float reach() const { return reach_; }

   private:
    friend class ClearanceMap;
    static float larger(float a, float b) { return a < b ? b : a; }
    static float smaller(float a, float b) { return a < b ? a : b; }
    static float inside(float a, float last) { return smaller(larger(a, 0), last); }
    static float outside(float a, float low, float high) { return larger(larger(low - a, a - high), 0); }

    const std::uint32_t* cells;   // by row: distances of the nearest and the second nearest column from
                                  // the cell's nearest point [steps, rounded down], nearest column << 16
    const std::uint32_t* slices;  // by column: distance up or down to the nearest module from the slice's
                                  // nearest point [steps, rounded down], that module << 8
    std::int32_t columns, slice_count;
    float x0, y0, per_cell, last_column, last_row, per_slice, last_slice;
    float low_x, low_y, low_z, high_x, high_y, high_z;  // extent of the modules' centres
    float reach_;                                       // of a widened module, and what rounding may cost [m]
  };
  const View& view() const { return view_; }

 private:
  static constexpr float step = 0.25F;       // of the tabulated distances [m]
  static constexpr float farthest = 63.75F;  // tabulated [m]
  static constexpr float slice = 1;          // of the tables along columns [m]

  void lay_out_grid();
  void enter_column(std::uint32_t index, const ModuleColumn& column);
  void enter_slices(const std::vector<ModuleColumn>& columns);

  std::vector<std::uint32_t> cells_, slices_;
  float cell_ = 0;
  View view_{};
};

}  // namespace floe
