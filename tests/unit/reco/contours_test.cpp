#include "reco/figures/contours.h"

#include <gtest/gtest.h>

#include <cmath>

namespace floe {
namespace {

// Heights of a tilted bowl about a place between the points.
double bowl(double x, double y) {
  const double u = x - 3.3, v = y - 2.2;
  return 0.6 * u * u + 0.5 * u * v + 0.9 * v * v;
}

NumberGrid bowl_grid(int rows, int columns) {
  NumberGrid grid{rows, columns, {}};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) grid.values.push_back(bowl(column, row));
  return grid;
}

TEST(RefinedGrid, IsExactForABowlUpToItsEnds) {
  const NumberGrid fine = refined(bowl_grid(5, 8), 4);
  ASSERT_EQ(fine.rows, 17);
  ASSERT_EQ(fine.columns, 29);
  for (int row = 0; row < fine.rows; ++row)
    for (int column = 0; column < fine.columns; ++column)
      EXPECT_NEAR(fine.at(row, column), bowl(column / 4.0, row / 4.0), 1e-12);
}

TEST(ContourLines, OfARefinedBowlAreClosedAndAtTheirLevel) {
  constexpr int parts = 8;
  const auto lines = contour_lines(refined(bowl_grid(5, 8), parts), 1.15);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  // A chord lies above the parabola by curvature x (step / 2)^2 / 2 at most.
  for (const auto& [x, y] : lines[0])
    EXPECT_NEAR(bowl(x / parts, y / parts), 1.15, 1.8 / (8 * parts * parts));
}

TEST(ContourLines, EndWhereTheGridEndsAndWhereItIsNotKnown) {
  const auto cut = contour_lines(bowl_grid(5, 8), 4);
  ASSERT_FALSE(cut.empty());
  for (const auto& line : cut) EXPECT_NE(line.front(), line.back());
  NumberGrid grid = bowl_grid(5, 8);
  grid.values[grid.index(2, 2)] = std::nan("");
  for (const auto& line : contour_lines(grid, 1.15)) EXPECT_NE(line.front(), line.back());
  EXPECT_TRUE(contour_lines(grid, -1).empty());
}

}  // namespace
}  // namespace floe
