#include "reco/ice_fit/quadratic_minimum.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace floe {

namespace {

constexpr int coefficients = 6;
constexpr std::size_t fewest_points = 9;
constexpr double first_height = 4;  // in units of the noise: at 1, a little beyond the 95% contour

// Of  c0 + c1 u + c2 v + c3 u^2/2 + c4 u v + c5 v^2/2,  u and v in steps of the grid from the lowest point.
using Coefficients = Eigen::Matrix<double, coefficients, 1>;

struct Surface {
  Coefficients c;
  bool determined = false;

  Eigen::Vector2d slope() const { return {c(1), c(2)}; }
  Eigen::Matrix2d curvature() const { return (Eigen::Matrix2d() << c(3), c(4), c(4), c(5)).finished(); }
};

// Grid points by their number.
struct Places {
  const NumberGrid& grid;
  std::size_t lowest = 0;

  int row(std::size_t i) const { return static_cast<int>(i) / grid.columns; }
  int column(std::size_t i) const { return static_cast<int>(i) % grid.columns; }
  double height(std::size_t i) const { return grid.values[i] - grid.values[lowest]; }
};

std::size_t lowest_of(const std::vector<double>& values) {
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (std::isnan(values[lowest]) || values[i] < values[lowest]) lowest = i;
  return lowest;
}

std::vector<std::size_t> points_below(const Places& places, double height) {
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < places.grid.values.size(); ++i)
    if (places.height(i) <= height) points.push_back(i);
  return points;
}

Surface fit_surface(const Places& places, const std::vector<std::size_t>& points, double noise) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::Matrix<double, Eigen::Dynamic, coefficients> design(n, coefficients);
  Eigen::VectorXd heights(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t i = points[static_cast<std::size_t>(k)];
    const double u = places.column(i) - places.column(places.lowest);
    const double v = places.row(i) - places.row(places.lowest);
    const double height = places.height(i), error = noise + height;
    design.row(k) << 1, u, v, u * u / 2, u * v, v * v / 2;
    design.row(k) /= error;
    heights(k) = height / error;
  }
  const Eigen::ColPivHouseholderQR<decltype(design)> qr(design);
  return {qr.solve(heights), n >= coefficients && qr.rank() == coefficients};
}

// The lowest points that are enough for all coefficients.
Surface fit_lowest(const Places& places, double noise, std::vector<std::size_t>& points) {
  std::size_t known = 0;
  for (const double value : places.grid.values) known += std::isfinite(value);
  for (double height = first_height * noise;; height *= 2) {
    points = points_below(places, height);
    const bool all = points.size() >= known;
    if (points.size() < fewest_points && !all) continue;
    const Surface surface = fit_surface(places, points, noise);
    if (surface.determined || all) return surface;
  }
}

}  // namespace

QuadraticMinimum quadratic_minimum(const std::vector<double>& xs, const std::vector<double>& ys,
                                   const NumberGrid& values, double noise) {
  const Places places{values, lowest_of(values.values)};
  const int row = places.row(places.lowest), column = places.column(places.lowest);
  QuadraticMinimum minimum;
  minimum.x = xs[static_cast<std::size_t>(column)];
  minimum.y = ys[static_cast<std::size_t>(row)];
  minimum.value = values.values[places.lowest];
  minimum.at_edge = row == 0 || row + 1 == values.rows || column == 0 || column + 1 == values.columns;
  if (!std::isfinite(minimum.value)) return minimum;

  const Surface surface = fit_lowest(places, std::max(1.0, noise), minimum.points);
  const Eigen::LLT<Eigen::Matrix2d> cholesky(surface.curvature());
  if (!surface.determined || cholesky.info() != Eigen::Success) return minimum;
  const Eigen::Vector2d place = cholesky.solve(-surface.slope());
  const double u = column + place(0), v = row + place(1);
  if (u < 0 || u > values.columns - 1 || v < 0 || v > values.rows - 1) {
    minimum.at_edge = true;
    return minimum;
  }
  const Eigen::Matrix2d covariance = surface.curvature().inverse();
  const double x_step = xs[1] - xs[0], y_step = ys[1] - ys[0];
  minimum.found = true;
  minimum.x = xs[0] + u * x_step;
  minimum.y = ys[0] + v * y_step;
  minimum.value += surface.c(0) + surface.slope().dot(place) / 2;
  minimum.x_error = x_step * std::sqrt(covariance(0, 0));
  minimum.y_error = y_step * std::sqrt(covariance(1, 1));
  minimum.correlation = covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1));
  return minimum;
}

}  // namespace floe
