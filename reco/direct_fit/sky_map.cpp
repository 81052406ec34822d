#include "reco/direct_fit/sky_map.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "data/base/error.h"
#include "propagation/engine/threads.h"
#include "reco/direct_fit/constrained_score.h"
#include "reco/figures/contours.h"

namespace floe {
namespace {

using Vector2 = Eigen::Vector2d;

constexpr double half_width_in_errors = 4;
constexpr int parts_of_a_cell = 8;  // along each side, when areas are measured

// --- the tangent plane

struct TangentPlane {
  Vec3 centre, azimuth, zenith;  // orthonormal; the origin's direction and how it moves with both angles

  explicit TangentPlane(const SkyMap& map)
      : centre(unit_vector(map.zenith, map.azimuth)),
        azimuth(-std::sin(map.azimuth), std::cos(map.azimuth), 0),
        zenith(unit_vector(map.zenith + pi / 2, map.azimuth)) {}

  // Direction of travel of a cascade that comes from there.
  Vec3 travel(const TangentPoint& point) const {
    const auto& [x, y] = point;
    const double angle = std::hypot(x, y), sinc = angle > 0 ? std::sin(angle) / angle : 1;
    return -(std::cos(angle) * centre + sinc * (x * azimuth + y * zenith));
  }
};

// --- the map's pixels, counted from the middle

struct Pixel {
  int row, column;
};

// Those at this distance from the middle, all around it.
std::vector<Pixel> ring_of(int distance) {
  std::vector<Pixel> pixels;
  for (int row = -distance; row <= distance; ++row)
    for (int column = -distance; column <= distance; column += std::abs(row) == distance ? 1 : 2 * distance)
      pixels.push_back({row, column});
  return pixels;
}

// The neighbour in the next ring inwards.
Pixel inwards(Pixel pixel) {
  const int distance = std::max(std::abs(pixel.row), std::abs(pixel.column));
  const auto nearer = [distance](int i) { return i == distance ? i - 1 : i == -distance ? i + 1 : i; };
  return {nearer(pixel.row), nearer(pixel.column)};
}

// --- the minimum at every pixel

// All cascades that travel in this direction.
Surface surface_of(const Vec3& travel, const ScoreLikelihood& likelihood) {
  LightCentre light = likelihood.frame.origin();
  light.direction = travel;
  const Vector2 wanted = likelihood.frame.of(light).segment<2>(3);
  const Vector2 error = likelihood.covariance.diagonal().segment<2>(3).cwiseSqrt();
  return [wanted, error](const Vector7& p) {
    SurfaceDistance distance;
    distance.value = (p.segment<2>(3) - wanted).cwiseQuotient(error);
    distance.slope.setZero(2, 7);
    distance.slope(0, 3) = 1 / error(0);
    distance.slope(1, 4) = 1 / error(1);
    return distance;
  };
}

class MapMaker {
 public:
  MapMaker(const ScoreLikelihood& likelihood, SkyMap& map)
      : likelihood_(likelihood),
        plane_(map),
        map_(map),
        middle_(map.pixels / 2),
        lowest_(static_cast<std::size_t>(map.pixels * map.pixels)) {}

  // Ring by ring, so that every pixel can begin where its inner neighbour ended.
  void run(int threads) {
    for (int distance = 0; distance <= middle_; ++distance) {
      const std::vector<Pixel> ring = ring_of(distance);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const TangentPoint point{ring[i].column * map_.step, ring[i].row * map_.step};
        lowest_[index(ring[i])] =
            lowest_on(surface_of(plane_.travel(point), likelihood_), start_of(ring[i]), likelihood_);
      }
    }
    for (const std::optional<LowestPoint>& lowest : lowest_)
      map_.delta_neg_llh.push_back(lowest ? lowest->neg_llh : std::numeric_limits<double>::quiet_NaN());
  }

 private:
  std::size_t index(Pixel pixel) const {
    return static_cast<std::size_t>((pixel.row + middle_) * map_.pixels + pixel.column + middle_);
  }

  // The minimum of the next pixel inwards that has one.
  Vector7 start_of(Pixel pixel) const {
    while (pixel.row != 0 || pixel.column != 0) {
      pixel = inwards(pixel);
      if (const std::optional<LowestPoint>& lowest = lowest_[index(pixel)]) return lowest->p;
    }
    return likelihood_.best;
  }

  const ScoreLikelihood& likelihood_;
  TangentPlane plane_;
  SkyMap& map_;
  int middle_;
  std::vector<std::optional<LowestPoint>> lowest_;
};

double half_width(const ScoreLikelihood& likelihood) {
  const Eigen::Matrix2d covariance = likelihood.covariance.block<2, 2>(3, 3);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance, Eigen::EigenvaluesOnly);
  const Vector2 farthest = likelihood.trusted.segment<2>(3) + likelihood.best.segment<2>(3).cwiseAbs();
  return std::min(half_width_in_errors * std::sqrt(axes.eigenvalues().maxCoeff()), farthest.maxCoeff());
}

}  // namespace

double level_of(double share) {
  return -std::log1p(-share);
}

TangentPoint SkyMap::point_at(int row, int column) const {
  const int middle = pixels / 2;
  return {(column - middle) * step, (row - middle) * step};
}

Origin SkyMap::direction_of(const TangentPoint& point) const {
  return origin_of(TangentPlane(*this).travel(point));
}

TangentPoint SkyMap::point_of(const Origin& origin) const {
  const TangentPlane plane(*this);
  const Vec3 direction = unit_vector(origin.zenith, origin.azimuth);
  const double x = direction.dot(plane.azimuth), y = direction.dot(plane.zenith), sine = std::hypot(x, y);
  const double stretch = sine > 0 ? std::atan2(sine, direction.dot(plane.centre)) / sine : 1;
  return {stretch * x, stretch * y};
}

double SkyMap::area(double share) const {
  const double level = level_of(share), part = 1.0 / parts_of_a_cell;
  double parts = 0;
  for (int row = 0; row + 1 < pixels; ++row)
    for (int column = 0; column + 1 < pixels; ++column) {
      // Between pixels -ln L is taken for bilinear; where one is not known, nothing is counted.
      int inside = 0;
      for (double down = part / 2; down < 1; down += part)
        for (double right = part / 2; right < 1; right += part) {
          const double above = (1 - right) * at(row, column) + right * at(row, column + 1);
          const double below = (1 - right) * at(row + 1, column) + right * at(row + 1, column + 1);
          inside += (1 - down) * above + down * below < level;
        }
      // The plane's area is larger than the sphere's by angle / sin(angle).
      const auto [x, y] = point_at(row, column);
      const double angle = std::hypot(x + step / 2, y + step / 2);
      parts += inside * std::sin(angle) / angle;
    }
  const double side = step / degree * part;
  return parts * side * side;
}

bool SkyMap::is_cut(double share) const {
  const double level = level_of(share);
  const auto known = [this](int row, int column) {
    return row >= 0 && row < pixels && column >= 0 && column < pixels && std::isfinite(at(row, column));
  };
  for (int row = 0; row < pixels; ++row)
    for (int column = 0; column < pixels; ++column)
      if (at(row, column) < level && !(known(row - 1, column) && known(row + 1, column) &&
                                       known(row, column - 1) && known(row, column + 1)))
        return true;
  return false;
}

SkyMap make_sky_map(const ScoreLikelihood& likelihood, int pixels, int threads) {
  if (pixels < 3 || pixels % 2 == 0)
    throw UsageError(
        fmt::format("sky map: found {} pixels a side; expected an odd number from 3 on", pixels));
  const Origin best = origin_of(likelihood.frame.at(likelihood.best).direction);
  SkyMap map;
  map.pixels = pixels;
  map.step = half_width(likelihood) / (pixels / 2);
  map.zenith = best.zenith;
  map.azimuth = best.azimuth;
  MapMaker(likelihood, map).run(thread_count(threads));
  return map;
}

std::vector<std::vector<TangentPoint>> contours(const SkyMap& map, double level) {
  const double middle = map.pixels / 2;
  std::vector<std::vector<TangentPoint>> result;
  for (const auto& line : contour_lines({map.pixels, map.pixels, map.delta_neg_llh}, level)) {
    result.emplace_back();
    for (const auto& [column, row] : line)
      result.back().emplace_back((column - middle) * map.step, (row - middle) * map.step);
  }
  return result;
}

std::string words_of_area(const SkyMap& map, double share) {
  return fmt::format("{:.0f}% in {}{:.3g} deg2", 100 * share, map.is_cut(share) ? "more than " : "",
                     map.area(share));
}

std::string describe(const SkyMap& map) {
  return fmt::format("  direction  {}, {}\n", words_of_area(map, 0.5), words_of_area(map, 0.9));
}

}  // namespace floe
