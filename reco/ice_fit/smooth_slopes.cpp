#include "reco/ice_fit/smooth_slopes.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "reco/ice_fit/run_light.h"

namespace floe {

namespace {

constexpr double usual_distance = 100;  // [m]
constexpr Eigen::Index directions = 3;  // the first terms: any way, along the flow, across it
constexpr Eigen::Index symmetric_places = 12, number_of_places = 27;
constexpr double ridge = 1e-6;  // keeps terms apart that few bins cannot tell apart

// Of one fold: mean slopes per bin with their noise, as if Gaussian.
struct FoldSlopes {
  Eigen::ArrayXd counts;  // at least 1
  Eigen::MatrixXd mean, variance;
};
FoldSlopes fold_slopes(const LightFold& fold) {
  FoldSlopes slopes;
  slopes.counts = fold.counts.array().max(1);
  slopes.mean = fold.slopes.array().colwise() / slopes.counts;
  const Eigen::ArrayXXd squares = fold.slope_squares.array().colwise() / slopes.counts;
  slopes.variance = (squares - slopes.mean.array().square()).max(0).colwise() / slopes.counts;
  return slopes;
}

// The ice's own symmetric places, and again in proportion to the bins' dwell. What acts on light as a whole
// may have any symmetry: all places.
Eigen::MatrixXd terms_of(const LightFold& fold, const Eigen::ArrayXd& counts,
                         const Eigen::MatrixXd& all_places, Eigen::Index parameter, bool symmetric) {
  if (!symmetric) return all_places;
  const Eigen::MatrixXd places = all_places.leftCols(std::min(symmetric_places, all_places.cols()));
  const Eigen::ArrayXd dwell = fold.dwell.col(parameter).array() / counts;
  const double usual = (dwell * counts).sum() / counts.sum();
  Eigen::MatrixXd terms(places.rows(), places.cols() + directions);
  terms.leftCols(places.cols()) =
      places.array().colwise() * (usual > 0 ? Eigen::ArrayXd(dwell / usual) : dwell);
  terms.rightCols(directions) = places.leftCols(directions);
  return terms;
}

// Least squares with weights.
Eigen::VectorXd fitted(const Eigen::MatrixXd& terms, const Eigen::ArrayXd& weights,
                       const Eigen::VectorXd& y) {
  const Eigen::MatrixXd weighted = terms.array().colwise() * weights;
  Eigen::MatrixXd normal = terms.transpose() * weighted;
  normal.diagonal().array() += ridge * weights.sum();
  return terms * normal.ldlt().solve(weighted.transpose() * y);
}

double product(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::ArrayXd& weights) {
  return (a.array() * b.array() * weights).sum() / weights.sum();
}

}  // namespace

Eigen::MatrixXd bin_places(const RunBins& bins, const Detector& detector, const Vec3& flasher,
                           double flow_azimuth) {
  const Vec3 flow(std::cos(flow_azimuth), std::sin(flow_azimuth), 0);
  Eigen::MatrixXd places(bins.size(), number_of_places);
  for (const RunBins::Receiver& receiver : bins.receivers()) {
    const Vec3 way = detector.modules()[receiver.module].position - flasher;
    const double square = std::max(1.0, way.squaredNorm()), far = std::sqrt(square) / usual_distance - 1;
    const Vec3 unit = way / std::sqrt(square);
    const double with_flow = unit.dot(flow), beside_flow = Vec3::UnitZ().cross(flow).dot(unit);
    const double along = with_flow * with_flow, across = beside_flow * beside_flow;
    Eigen::Matrix<double, 1, 5>
        odd;  // what has another symmetry than ice: its axis, depth, places of modules
    odd << with_flow * beside_flow, unit.z(), unit.z() * unit.z(), with_flow, beside_flow;
    for (int i = 0; i < receiver.bins(); ++i) {
      const double late = (2 * i + 1.0) / receiver.bins() - 1;
      places.row(receiver.first + i) << 1, along, across, far, far * along, far * across, late, late * along,
          late * across, far * far, late * late, far * late, odd, far * odd, late * odd;
    }
  }
  return places;
}

SmoothSlopes smooth_slopes(const LightFold (&folds)[2], const Eigen::MatrixXd& places,
                           const std::vector<char>& symmetric) {
  const FoldSlopes slopes[2] = {fold_slopes(folds[0]), fold_slopes(folds[1])};
  const Eigen::ArrayXd all_weights = slopes[0].counts + slopes[1].counts;
  SmoothSlopes result{{slopes[0].mean, slopes[1].mean}};
  for (Eigen::Index p = 0; p < slopes[0].mean.cols(); ++p) {
    const bool is_symmetric = symmetric[static_cast<std::size_t>(p)] != 0;
    // What acts at some modules only is smooth there: one string is no smooth function of all places.
    const Eigen::ArrayXd acts =
        is_symmetric ? Eigen::ArrayXd::Ones(all_weights.size())
                     : (folds[0].dwell.col(p) + folds[1].dwell.col(p)).array().min(1.0).ceil().eval();
    const Eigen::ArrayXd weights = all_weights * acts;
    if (!(weights.sum() > 0)) {
      for (Eigen::MatrixXd& fold : result.fold) fold.col(p).setZero();
      continue;
    }
    Eigen::VectorXd smooth[2], rest[2];
    for (int fold = 0; fold < 2; ++fold)
      smooth[fold] = fitted(terms_of(folds[fold], slopes[fold].counts, places, p, is_symmetric),
                            slopes[fold].counts * acts, slopes[fold].mean.col(p))
                         .cwiseProduct(acts.matrix());
    const double agreed = product(smooth[0], smooth[1], weights);
    for (int fold = 0; fold < 2; ++fold) {
      const double power = product(smooth[fold], smooth[fold], weights);
      smooth[fold] *= power > 0 ? std::clamp(agreed / power, 0.0, 1.0) : 0.0;
      rest[fold] = slopes[fold].mean.col(p).cwiseProduct(acts.matrix()) - smooth[fold];
    }
    const double power = std::max(0.0, product(rest[0], rest[1], weights));
    for (int fold = 0; fold < 2; ++fold) {
      const Eigen::ArrayXd noise = slopes[fold].variance.col(p);
      result.fold[fold].col(p) =
          smooth[fold].array() + rest[fold].array() * power / (power + noise).max(1e-30);
    }
  }
  return result;
}

}  // namespace floe
