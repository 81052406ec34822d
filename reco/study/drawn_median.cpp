#include "reco/study/drawn_median.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "reco/study/summary.h"

namespace floe {

DrawnMedian median_of_gaussian_lengths(std::span<const Eigen::MatrixXd> covariances) {
  constexpr int studies = 2000;
  if (covariances.empty())
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  std::vector<Eigen::MatrixXd> roots;
  for (const Eigen::MatrixXd& covariance : covariances) {
    const Eigen::LLT<Eigen::MatrixXd> root(covariance);
    if (root.info() != Eigen::Success)
      return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
    roots.emplace_back(root.matrixL());
  }
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  double sum = 0, squares = 0;
  std::vector<double> lengths(roots.size());
  for (int study = 0; study < studies; ++study) {
    for (std::size_t i = 0; i < roots.size(); ++i) {
      Eigen::VectorXd unit(roots[i].rows());
      for (double& value : unit) value = normal(engine);
      lengths[i] = (roots[i] * unit).norm();
    }
    const double found = median(lengths);
    sum += found, squares += found * found;
  }
  const double mean = sum / studies;
  return {mean, std::sqrt(std::max(0.0, squares / studies - mean * mean))};
}

}  // namespace floe
