#include "reco/direct_fit/constrained_score.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace floe {
namespace {

constexpr double on_surface = 1e-6;   // distance [errors]
constexpr int most_corrections = 10;  // back to the surface
constexpr int most_steps = 12, most_halvings = 5;
constexpr double least_gain = 1e-4;       // in -ln L, for which another step is worth while
constexpr double least_share = 0.01;      // of a step that stays inside what is trusted
constexpr double before_the_edge = 0.99;  // steps to the edge end a little before it

class Descent {
 public:
  Descent(const Surface& surface, const ScoreLikelihood& likelihood)
      : surface_(surface), likelihood_(likelihood), root_(likelihood.covariance.llt().matrixL()) {}

  std::optional<LowestPoint> from(const Vector7& start) const {
    std::optional<Place> now = place_near(start);
    if (!now) return {};
    for (int i = 0; i < most_steps; ++i) {
      Vector7 step = best_step(*now);
      if (0.5 * (now->sums.slope * step).squaredNorm() < least_gain) break;
      const double share = share_inside(now->p, step);
      if (share < least_share) return {};  // the minimum lies outside
      if (share < 1) step *= before_the_edge * share;
      const std::optional<Place> next = lower_place(*now, step);
      if (!next) break;  // as low as the sums' own roughness allows
      now = next;
    }
    return LowestPoint{now->p, now->neg_llh};
  }

 private:
  struct Place {
    Vector7 p;
    ScoreLikelihood::Point sums;
    double neg_llh;
  };

  // The nearest point of the surface in units of the errors: Newton steps, one where the surface is plane.
  std::optional<Vector7> onto_surface(Vector7 p) const {
    for (int i = 0; i < most_corrections; ++i) {
      const SurfaceDistance distance = surface_(p);
      if (!distance.value.allFinite() || !distance.slope.allFinite()) return {};
      if (distance.value.norm() < on_surface) return p;
      const Eigen::MatrixXd slope = distance.slope * root_;
      p -= root_ * slope.completeOrthogonalDecomposition().solve(distance.value);
    }
    return {};
  }

  std::optional<Place> place_near(const Vector7& wanted) const {
    const std::optional<Vector7> p = onto_surface(wanted);
    if (!p || (p->cwiseAbs().array() > likelihood_.trusted.array()).any()) return {};
    const ScoreLikelihood::Point sums = likelihood_.at(*p);
    if (!sums.gap.allFinite() || !sums.slope.allFinite()) return {};
    return Place{*p, sums, 0.5 * sums.gap.squaredNorm()};
  }

  // The step along the surface to where the linear sums are the smallest.
  Vector7 best_step(const Place& now) const {
    const Eigen::MatrixXd across = (surface_(now.p).slope * root_).transpose();
    const Eigen::MatrixXd basis = Eigen::HouseholderQR<Eigen::MatrixXd>(across).householderQ();
    const Eigen::MatrixXd along = root_ * basis.rightCols(7 - across.cols());
    const Eigen::MatrixXd slope = now.sums.slope * along;
    return -along * slope.completeOrthogonalDecomposition().solve(now.sums.gap);
  }

  double share_inside(const Vector7& p, const Vector7& step) const {
    double share = 1;
    for (int i = 0; i < 7; ++i)
      share =
          std::min(share, (likelihood_.trusted(i) - std::copysign(1.0, step(i)) * p(i)) / std::abs(step(i)));
    return share;
  }

  std::optional<Place> lower_place(const Place& now, Vector7 step) const {
    for (int i = 0; i <= most_halvings; ++i, step *= 0.5) {
      std::optional<Place> next = place_near(now.p + step);
      if (next && next->neg_llh < now.neg_llh) return next;
    }
    return {};
  }

  const Surface& surface_;
  const ScoreLikelihood& likelihood_;
  Matrix7 root_;  // of the covariance: local numbers are root_ times numbers of unit error
};

}  // namespace

std::optional<LowestPoint> lowest_on(const Surface& surface, const Vector7& start,
                                     const ScoreLikelihood& likelihood) {
  return Descent(surface, likelihood).from(start);
}

}  // namespace floe
