// Contours of numbers that are known on a grid.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace floe {

// Numbers at the points of a regular grid, row by row; NaN: not known.
struct NumberGrid {
  int rows = 0, columns = 0;
  std::vector<double> values;  // rows x columns

  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  double at(int row, int column) const { return values[index(row, column)]; }
};

// A place on the grid, in steps from its first point: along the columns, along the rows.
using GridPlace = std::pair<double, double>;

// Lines of this level (marching squares, linear along the sides of cells): closed ones end in the point in
// which they begin, others at the end of the grid or of what is known.
std::vector<std::vector<GridPlace>> contour_lines(const NumberGrid& grid, double level);

// The same surface on `parts` times narrower steps, so that contours of a coarse grid are round: cubic
// between the points (Catmull-Rom), exact for polynomials of second degree up to the grid's ends. Needs 3
// rows and columns and parts >= 1.
NumberGrid refined(const NumberGrid& grid, int parts);

}  // namespace floe
