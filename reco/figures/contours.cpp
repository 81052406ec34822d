#include "reco/figures/contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace floe {

namespace {

// Where a contour crosses the side of a cell, named by the side: 2 x point for the side to the next column,
// 2 x point + 1 for that to the next row.
using Crossing = int;

class ContourFinder {
 public:
  ContourFinder(const NumberGrid& grid, double level) : grid_(grid), level_(level) {
    for (int row = 0; row + 1 < grid.rows; ++row)
      for (int column = 0; column + 1 < grid.columns; ++column) cross_cell(row, column);
  }

  std::vector<std::vector<GridPlace>> lines() {
    std::vector<std::vector<GridPlace>> result;
    // First those with ends: what is left then are rings.
    std::vector<Crossing> ends, all;
    for (const auto& [crossing, next] : links_) {
      all.push_back(crossing);
      if (next.size() == 1) ends.push_back(crossing);
    }
    for (const std::vector<Crossing>& beginnings : {ends, all})
      for (const Crossing crossing : beginnings)
        if (!links_[crossing].empty()) result.push_back(line_from(crossing));
    return result;
  }

 private:
  bool inside(double value) const { return value < level_; }

  void cross_cell(int row, int column) {
    const std::array<double, 4> corners{grid_.at(row, column), grid_.at(row, column + 1),
                                        grid_.at(row + 1, column + 1), grid_.at(row + 1, column)};
    const int first = row * grid_.columns + column, below = first + grid_.columns;
    const std::array<Crossing, 4> sides{2 * first, 2 * (first + 1) + 1, 2 * below, 2 * first + 1};
    double sum = 0;
    std::vector<Crossing> crossed;
    for (std::size_t i = 0; i < 4; ++i) {
      sum += corners[i];
      if (inside(corners[i]) != inside(corners[(i + 1) % 4])) crossed.push_back(sides[i]);
    }
    if (!std::isfinite(sum)) return;
    if (crossed.size() == 2) link(crossed[0], crossed[1]);
    if (crossed.size() < 4) return;
    // A saddle: the middle belongs to the first corner and the one across, or to the other two.
    const bool with_first = inside(sum / 4) == inside(corners[0]);
    link(crossed[0], crossed[with_first ? 1 : 3]);
    link(crossed[2], crossed[with_first ? 3 : 1]);
  }

  void link(Crossing a, Crossing b) {
    links_[a].push_back(b);
    links_[b].push_back(a);
  }

  void unlink(Crossing from, Crossing to) {
    std::vector<Crossing>& next = links_[from];
    next.erase(std::find(next.begin(), next.end(), to));
  }

  // Follows the links until there are none, and takes them away.
  std::vector<GridPlace> line_from(Crossing crossing) {
    std::vector<GridPlace> line{place_of(crossing)};
    while (!links_[crossing].empty()) {
      const Crossing next = links_[crossing].front();
      unlink(crossing, next);
      unlink(next, crossing);
      crossing = next;
      line.push_back(place_of(crossing));
    }
    return line;
  }

  GridPlace place_of(Crossing crossing) const {
    const int point = crossing / 2, row = point / grid_.columns, column = point % grid_.columns;
    const int down = crossing % 2, right = 1 - down;
    const double here = grid_.at(row, column), there = grid_.at(row + down, column + right);
    const double share = (level_ - here) / (there - here);
    return {column + right * share, row + down * share};
  }

  const NumberGrid& grid_;
  double level_;
  std::map<Crossing, std::vector<Crossing>> links_;  // of every crossing to those of the same cells
};

// A line of numbers on narrower steps. Beyond its ends it goes on as the parabola through the last three.
std::vector<double> refined_line(const std::vector<double>& line, int parts) {
  const std::size_t n = line.size();
  std::vector<double> padded{3 * line[0] - 3 * line[1] + line[2]};
  padded.insert(padded.end(), line.begin(), line.end());
  padded.push_back(3 * line[n - 1] - 3 * line[n - 2] + line[n - 3]);
  std::vector<double> result;
  for (std::size_t i = 1; i < n; ++i)
    for (int part = 0; part < parts; ++part) {
      const double a = padded[i - 1], b = padded[i], c = padded[i + 1], d = padded[i + 2];
      const double t = static_cast<double>(part) / parts;
      result.push_back(b + t / 2 * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a))));
    }
  result.push_back(line.back());
  return result;
}

std::vector<double> row_of(const NumberGrid& grid, int row) {
  const auto begin = grid.values.begin() + static_cast<std::ptrdiff_t>(grid.index(row, 0));
  return {begin, begin + grid.columns};
}

NumberGrid turned(const NumberGrid& grid) {
  NumberGrid result{grid.columns, grid.rows, {}};
  for (int column = 0; column < grid.columns; ++column)
    for (int row = 0; row < grid.rows; ++row) result.values.push_back(grid.at(row, column));
  return result;
}

NumberGrid with_refined_rows(const NumberGrid& grid, int parts) {
  NumberGrid result{grid.rows, (grid.columns - 1) * parts + 1, {}};
  for (int row = 0; row < grid.rows; ++row) {
    const std::vector<double> line = refined_line(row_of(grid, row), parts);
    result.values.insert(result.values.end(), line.begin(), line.end());
  }
  return result;
}

}  // namespace

std::vector<std::vector<GridPlace>> contour_lines(const NumberGrid& grid, double level) {
  return ContourFinder(grid, level).lines();
}

NumberGrid refined(const NumberGrid& grid, int parts) {
  return turned(with_refined_rows(turned(with_refined_rows(grid, parts)), parts));
}

}  // namespace floe
