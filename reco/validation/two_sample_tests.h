// Do two samples come from one distribution?
#pragma once

#include <vector>

namespace floe {

// Probability that a chi-square of `degrees` degrees of freedom exceeds `chi_square`.
double chi_square_probability(double chi_square, double degrees);
// Its logarithm, however small it is.
double ln_chi_square_probability(double chi_square, double degrees);

// Two-sample Kolmogorov-Smirnov test: the largest distance of the cumulative distributions and its
// asymptotic probability (Stephens 1970). Sorts its arguments. Each sample holds at least one value.
struct KolmogorovSmirnov {
  double distance, probability;
};
KolmogorovSmirnov kolmogorov_smirnov(std::vector<double> a, std::vector<double> b);

}  // namespace floe
