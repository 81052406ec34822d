#include "reco/direct_fit/instrumented_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floe {
namespace {

using Point = Eigen::Vector2d;

// Positive when a, b, c turn to the left.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

// Andrew's monotone chain.
std::vector<Point> convex_hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Point> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const Point& point : points) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  if (hull.empty()) hull.push_back(points.front());
  return hull;
}

double distance_to_side(const Point& a, const Point& b, const Point& p) {
  const Point side = b - a;
  const double length = side.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(side) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * side).norm();
}

}  // namespace

InstrumentedVolume::InstrumentedVolume(const Detector& detector) {
  std::vector<Point> points;
  for (const auto& [string, centre] : detector.strings()) points.push_back(centre);
  hull_ = convex_hull(std::move(points));
  const Detector::Extent extent = detector.extent();
  low_ = extent.low.z();
  high_ = extent.high.z();
}

double InstrumentedVolume::distance_outside(const Vec3& position) const {
  const Point p = position.head<2>();
  bool inside = hull_.size() > 2;
  double across = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull_.size(); ++i) {
    const Point &a = hull_[i], &b = hull_[(i + 1) % hull_.size()];
    if (turn(a, b, p) < 0) inside = false;
    across = std::min(across, distance_to_side(a, b, p));
  }
  const double up = std::max({0.0, low_ - position.z(), position.z() - high_});
  return std::hypot(inside ? 0.0 : across, up);
}

}  // namespace floe
