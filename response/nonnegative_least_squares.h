// min |A x - y| over x >= 0 (Lawson and Hanson, "Solving Least Squares Problems", 1974, chapter 23), for
// matrices whose columns are short: each is not 0 in a few rows only.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace floe {

// Columns come in while the gradient along a column of length 1 is above `tolerance`: what is left
// unexplained is less. Columns without entries stay 0. Throws std::logic_error when sizes do not fit.
Eigen::VectorXd nonnegative_least_squares(const Eigen::SparseMatrix<double>& a, const Eigen::VectorXd& y,
                                          double tolerance);

}  // namespace floe
