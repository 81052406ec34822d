#include "reco/direct_fit/common_shape.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "reco/direct_fit/point_light.h"

namespace floe {
namespace {

const ShapeTerms prior_weight =  // 1 / variance
    ShapeTerms(1.0, 0.5, 0.25, 0.15, 0.7).cwiseAbs2().cwiseInverse();
using ShapeMatrix = Eigen::Matrix<double, shape_terms, shape_terms>;

// Minus the logarithm of the posterior; with its derivatives when asked for.
double cost(std::span<const ShapeUnit> units, const ShapeTerms& expected, const ShapeTerms& shape,
            ShapeTerms* gradient, ShapeMatrix* hessian) {
  const ShapeTerms gap = shape - expected;
  double value = 0.5 * gap.dot(prior_weight.cwiseProduct(gap));
  if (gradient) {
    *gradient = prior_weight.cwiseProduct(gap);
    *hessian = prior_weight.asDiagonal();
  }
  for (const ShapeUnit& unit : units) {
    double total = 0, weights = 0, data = 0;
    ShapeTerms mean = ShapeTerms::Zero(), counted = ShapeTerms::Zero();
    ShapeMatrix square = ShapeMatrix::Zero();
    for (std::size_t k = 0; k < unit.counts.size(); ++k) {
      const double exponent = unit.offsets[k] + shape.dot(unit.terms[k]);
      const double weight = std::exp(exponent);
      total += unit.counts[k];
      weights += weight;
      data += unit.counts[k] * exponent;
      if (!gradient) continue;
      mean += weight * unit.terms[k];
      counted += unit.counts[k] * unit.terms[k];
      square += weight * unit.terms[k] * unit.terms[k].transpose();
    }
    value += total * std::log(weights) - data;
    if (!gradient) continue;
    mean /= weights;
    *gradient += total * mean - counted;
    *hessian += total * (square / weights - mean * mean.transpose());
  }
  return value;
}

}  // namespace

Sight sight(const Vec3& centre, const Vec3& direction, const Vec3& module) {
  const Vec3 way = module - centre;
  Sight result;
  result.distance = soft_distance(way);
  const Vec3 unit = way / result.distance;
  result.cosine = direction.dot(unit);
  result.distance_by_place = -unit;
  result.cosine_by_place = (result.cosine * unit - direction) / result.distance;
  result.cosine_by_direction = unit;
  return result;
}

ShapeTerms terms_of(const Sight& s) {
  const double x = s.cosine, x2 = x * x;
  return {x, 1.5 * x2 - 0.5, x * (2.5 * x2 - 1.5), (35 * x2 * x2 - 30 * x2 + 3) / 8,
          s.distance / shape_length};
}

ShapeTerms terms_by_cosine(const Sight& s) {
  const double x = s.cosine, x2 = x * x;
  return {1, 3 * x, 7.5 * x2 - 1.5, x * (17.5 * x2 - 7.5), 0};
}

ShapeTerms fit_shape(std::span<const ShapeUnit> units, const ShapeTerms& expected) {
  ShapeTerms shape = expected, gradient;
  ShapeMatrix hessian;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const double now = cost(units, expected, shape, &gradient, &hessian);
    ShapeTerms step = -hessian.llt().solve(gradient);
    if (-gradient.dot(step) < 1e-6) break;
    for (int i = 0; i < 20 && !(cost(units, expected, shape + step, nullptr, nullptr) <= now); ++i)
      step *= 0.5;
    shape += step;
  }
  return shape;
}

}  // namespace floe
