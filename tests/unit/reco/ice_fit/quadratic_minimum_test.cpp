#include "reco/ice_fit/quadratic_minimum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace floe {
namespace {

// -ln L of two numbers with these errors.
struct Paraboloid {
  double x = 1.17, y = -0.4, x_error = 0.05, y_error = 0.3, correlation = -0.7, value = 120;

  double at(double x_value, double y_value) const {
    const double u = (x_value - x) / x_error, v = (y_value - y) / y_error;
    return value + (u * u - 2 * correlation * u * v + v * v) / (2 * (1 - correlation * correlation));
  }
};

std::vector<double> spaced(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(low + i * (high - low) / (count - 1));
  return values;
}

template <class Function>
NumberGrid grid_of(const std::vector<double>& xs, const std::vector<double>& ys, const Function& function) {
  NumberGrid grid{static_cast<int>(ys.size()), static_cast<int>(xs.size()), {}};
  for (const double y : ys)
    for (const double x : xs) grid.values.push_back(function(x, y));
  return grid;
}

QuadraticMinimum minimum_of(const Paraboloid& p, const std::vector<double>& xs,
                            const std::vector<double>& ys) {
  return quadratic_minimum(xs, ys, grid_of(xs, ys, [&](double x, double y) { return p.at(x, y); }));
}

void expect_exact(const QuadraticMinimum& minimum, const Paraboloid& p) {
  EXPECT_TRUE(minimum.found);
  EXPECT_NEAR(minimum.x, p.x, 1e-6 * p.x_error);
  EXPECT_NEAR(minimum.y, p.y, 1e-6 * p.y_error);
  EXPECT_NEAR(minimum.value, p.value, 1e-6);
  EXPECT_NEAR(minimum.x_error, p.x_error, 1e-6 * p.x_error);
  EXPECT_NEAR(minimum.y_error, p.y_error, 1e-6 * p.y_error);
  EXPECT_NEAR(minimum.correlation, p.correlation, 1e-6);
}

TEST(QuadraticMinimum, OfAParaboloidIsExact) {
  for (const double correlation : {-0.95, -0.7, 0.0, 0.8}) {
    Paraboloid p;
    p.correlation = correlation;
    const QuadraticMinimum minimum = minimum_of(p, spaced(1.0, 1.3, 13), spaced(-1.6, 1, 14));
    expect_exact(minimum, p);
    EXPECT_FALSE(minimum.at_edge);
    EXPECT_GE(minimum.points.size(), 9U);
    EXPECT_LT(minimum.points.size(), 13U * 14U);
  }
}

TEST(QuadraticMinimum, NeedsNoMoreThanNinePoints) {
  const Paraboloid p;
  const QuadraticMinimum minimum = minimum_of(p, spaced(1.0, 1.4, 3), spaced(-2, 1, 3));
  expect_exact(minimum, p);
  EXPECT_EQ(minimum.points.size(), 9U);
}

TEST(QuadraticMinimum, IsNotDrawnByWhatLiesFarFromIt) {
  // A wall of third order, and a plateau behind it.
  const Paraboloid p;
  const auto function = [&](double x, double y) {
    const double u = (x - p.x) / p.x_error;
    return std::min(p.at(x, y) + 0.02 * std::pow(u, 3) * (u > 0), p.value + 300);
  };
  const auto xs = spaced(0.7, 1.9, 41), ys = spaced(-3, 3, 41);
  const QuadraticMinimum minimum = quadratic_minimum(xs, ys, grid_of(xs, ys, function));
  EXPECT_TRUE(minimum.found);
  EXPECT_NEAR(minimum.x, p.x, 0.2 * p.x_error);
  EXPECT_NEAR(minimum.y, p.y, 0.2 * p.y_error);
  EXPECT_NEAR(minimum.x_error, p.x_error, 0.2 * p.x_error);
}

TEST(QuadraticMinimum, TakesMorePointsWhereThereIsMoreNoise) {
  const Paraboloid p;
  const auto xs = spaced(0.9, 1.4, 21), ys = spaced(-2, 1.2, 21);
  // Noise of about 3, the same in every run of the test.
  int i = 0;
  const auto function = [&](double x, double y) { return p.at(x, y) + 4 * std::sin(12.9898 * ++i); };
  const NumberGrid grid = grid_of(xs, ys, function);
  const QuadraticMinimum few = quadratic_minimum(xs, ys, grid), many = quadratic_minimum(xs, ys, grid, 3);
  EXPECT_GT(many.points.size(), few.points.size());
  EXPECT_TRUE(many.found);
  EXPECT_NEAR(many.x, p.x, 1.5 * p.x_error);
  EXPECT_NEAR(many.y, p.y, 1.5 * p.y_error);
  EXPECT_NEAR(many.x_error, p.x_error, 0.5 * p.x_error);
}

TEST(QuadraticMinimum, SaysWhenItIsAtTheEdge) {
  const Paraboloid p;
  // Beyond the grid: the lowest point is all that is known.
  const QuadraticMinimum beyond = minimum_of(p, spaced(1.2, 1.5, 7), spaced(-1.6, 1, 7));
  EXPECT_TRUE(beyond.at_edge);
  EXPECT_FALSE(beyond.found);
  EXPECT_EQ(beyond.x, 1.2);
  EXPECT_TRUE(std::isnan(beyond.x_error));
  // Within it, but nearest to an outermost point.
  const QuadraticMinimum last = minimum_of(p, spaced(0.8, 1.18, 7), spaced(-1.6, 1, 7));
  EXPECT_TRUE(last.at_edge);
  expect_exact(last, p);
}

TEST(QuadraticMinimum, IsTheLowestPointOfASaddle) {
  const auto xs = spaced(-1, 1, 5), ys = spaced(-1, 1, 5);
  const QuadraticMinimum minimum =
      quadratic_minimum(xs, ys, grid_of(xs, ys, [](double x, double y) { return x * x - y * y + 0.1 * y; }));
  EXPECT_FALSE(minimum.found);
  EXPECT_TRUE(minimum.at_edge);
  EXPECT_EQ(minimum.x, 0);
  EXPECT_EQ(minimum.y, -1);
}

TEST(QuadraticMinimum, IsFoundBesidePointsThatAreNotKnown) {
  const Paraboloid p;
  const auto xs = spaced(1.0, 1.3, 13), ys = spaced(-1.6, 1, 14);
  NumberGrid grid = grid_of(xs, ys, [&](double x, double y) { return p.at(x, y); });
  grid.values[0] = grid.values[grid.index(7, 7)] = std::nan("");
  expect_exact(quadratic_minimum(xs, ys, grid), p);
}

}  // namespace
}  // namespace floe
