#include "response/nonnegative_least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace floe {

namespace {

// The best of all sets of columns, each solved without the constraint: slow and certain.
Eigen::VectorXd best_of_all_sets(const Eigen::MatrixXd& a, const Eigen::VectorXd& y) {
  Eigen::VectorXd best = Eigen::VectorXd::Zero(a.cols());
  double least = y.squaredNorm();
  for (int set = 1; set < 1 << a.cols(); ++set) {
    std::vector<int> columns;
    for (int j = 0; j < a.cols(); ++j)
      if (set >> j & 1) columns.push_back(j);
    const Eigen::MatrixXd part = a(Eigen::all, columns);
    const Eigen::VectorXd x = part.colPivHouseholderQr().solve(y);
    if (x.minCoeff() < 0) continue;
    if (const double left = (part * x - y).squaredNorm(); left < least) {
      least = left;
      best.setZero();
      for (std::size_t k = 0; k < columns.size(); ++k) best(columns[k]) = x(static_cast<Eigen::Index>(k));
    }
  }
  return best;
}

}  // namespace

TEST(NonnegativeLeastSquares, FindsTheBestOfAllSets) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(10, 6, [&] { return normal(random); });
    const Eigen::VectorXd y = Eigen::VectorXd::NullaryExpr(10, [&] { return normal(random); });
    const Eigen::VectorXd x = nonnegative_least_squares(a.sparseView(), y, 1e-10);
    EXPECT_GE(x.minCoeff(), 0);
    EXPECT_LT((x - best_of_all_sets(a, y)).norm(), 1e-7) << "trial " << trial;
  }
}

// Pulses side by side, as in traces: nearly the same columns.
TEST(NonnegativeLeastSquares, KeepsToTheConditionsOfKarushKuhnAndTucker) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform;
  for (int trial = 0; trial < 20; ++trial) {
    constexpr int rows = 120, columns = 220;
    Eigen::MatrixXd a(rows, columns);
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const double z = (i - 0.5 * j) / 3.0;
        a(i, j) = std::abs(z) < 5 ? std::exp(-0.5 * z * z) : 0;
      }
    Eigen::VectorXd truth = Eigen::VectorXd::Zero(columns);
    for (int k = 0; k < 30; ++k) truth(static_cast<int>(columns * uniform(random))) = 10 * uniform(random);
    Eigen::VectorXd y = a * truth;
    for (double& value : y) value = std::round(20 * value) / 20;
    const Eigen::VectorXd x = nonnegative_least_squares(a.sparseView(), y, 1e-3);
    EXPECT_GE(x.minCoeff(), 0);
    const Eigen::VectorXd gradient = a.transpose() * (y - a * x);
    for (int j = 0; j < columns; ++j) {
      EXPECT_LT(gradient(j) / a.col(j).norm(), 1e-3 + 1e-6);
      if (x(j) > 0) {
        EXPECT_NEAR(gradient(j), 0, 1e-4);
      }
    }
  }
}

TEST(NonnegativeLeastSquares, LeavesOutWhatExplainsNothing) {
  Eigen::SparseMatrix<double> a(3, 3);
  a.insert(0, 0) = 1;
  a.insert(1, 1) = 1;  // the third column is empty
  const Eigen::VectorXd y = Eigen::Vector3d(2, -1, 5);
  EXPECT_EQ(nonnegative_least_squares(a, y, 1e-9), Eigen::VectorXd(Eigen::Vector3d(2, 0, 0)));
  EXPECT_EQ(nonnegative_least_squares(a, y, 3), Eigen::VectorXd(Eigen::Vector3d(0, 0, 0)));
  EXPECT_THROW(nonnegative_least_squares(a, Eigen::VectorXd::Zero(2), 1), std::logic_error);
}

}  // namespace floe
