#include "response/nonnegative_least_squares.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

namespace floe {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

class Solver {
 public:
  Solver(const Sparse& a, const Eigen::VectorXd& y)
      : a_(a),
        y_(y),
        normal_(a.transpose() * a),
        aty_(a.transpose() * y),
        x_(Eigen::VectorXd::Zero(a.cols())) {}

  Eigen::VectorXd solve(double tolerance) {
    // Each round lets one column in; more rounds than this mean that rounding drives it in circles.
    for (Eigen::Index round = 0; round < 3 * a_.cols() + 10; ++round) {
      const Eigen::Index column = steepest(tolerance);
      if (column < 0) break;
      passive_.insert(std::upper_bound(passive_.begin(), passive_.end(), column), column);
      if (!settle(column)) refused_.push_back(column);
    }
    return x_;
  }

 private:
  // The column outside the passive set along which the residual falls most; -1: none falls enough.
  Eigen::Index steepest(double tolerance) const {
    const Eigen::VectorXd gradient = aty_ - normal_ * x_;
    Eigen::Index best = -1;
    for (Eigen::Index j = 0; j < a_.cols(); ++j) {
      const double square = normal_.coeff(j, j);
      if (square <= 0 || std::binary_search(passive_.begin(), passive_.end(), j) ||
          std::find(refused_.begin(), refused_.end(), j) != refused_.end())
        continue;
      const double steep = gradient(j) / std::sqrt(square);
      if (steep > tolerance) {
        tolerance = steep;
        best = j;
      }
    }
    return best;
  }

  // Least squares over the passive set.
  Eigen::VectorXd unconstrained() const {
    const auto size = static_cast<Eigen::Index>(passive_.size());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const Eigen::Index column = passive_[static_cast<std::size_t>(i)];
      right(i) = aty_(column);
      for (Sparse::InnerIterator entry(normal_, column); entry; ++entry) {
        const auto place = std::lower_bound(passive_.begin(), passive_.end(), entry.row());
        if (place != passive_.end() && *place == entry.row())
          entries.emplace_back(static_cast<int>(place - passive_.begin()), static_cast<int>(i),
                               entry.value());
      }
    }
    Sparse matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    // Columns lie in order of time, so that the matrix is a band, and stays one.
    Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> factors(matrix);
    return factors.solve(right);
  }

  // Walks towards the unconstrained solution and drops what would fall below 0 on the way. False when the
  // column that came in last leaves at once, as only rounding makes it.
  bool settle(Eigen::Index newest) {
    for (;;) {
      const Eigen::VectorXd wanted = unconstrained();
      double way = 1;
      for (std::size_t i = 0; i < passive_.size(); ++i) {
        const double have = x_(passive_[i]), want = wanted(static_cast<Eigen::Index>(i));
        if (want <= 0) way = std::min(way, have / std::max(have - want, std::numeric_limits<double>::min()));
      }
      for (std::size_t i = 0; i < passive_.size(); ++i)
        x_(passive_[i]) += way * (wanted(static_cast<Eigen::Index>(i)) - x_(passive_[i]));
      if (way >= 1) return true;
      const double least = 1e-12 * x_.maxCoeff();
      std::erase_if(passive_, [&](Eigen::Index column) {
        if (x_(column) > least) return false;
        x_(column) = 0;
        return true;
      });
      if (!std::binary_search(passive_.begin(), passive_.end(), newest)) return false;
    }
  }

  const Sparse& a_;
  const Eigen::VectorXd& y_;
  Sparse normal_;
  Eigen::VectorXd aty_, x_;
  std::vector<Eigen::Index> passive_;  // columns above 0, in order
  std::vector<Eigen::Index> refused_;
};

}  // namespace

Eigen::VectorXd nonnegative_least_squares(const Sparse& a, const Eigen::VectorXd& y, double tolerance) {
  if (a.rows() != y.size())
    throw std::logic_error("nonnegative_least_squares: rows and values differ in number");
  return Solver(a, y).solve(tolerance);
}

}  // namespace floe
