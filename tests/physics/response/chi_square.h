// Drawn numbers against the distribution they are drawn from.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace floe::test {

// Pearson's chi-square of `drawn` in bins with these edges and beyond them, where `below(x)` is the
// probability of less than x. It is Gaussian around the number of bins less one, of variance twice that: 5
// sigma are allowed.
inline void expect_distribution(const std::vector<double>& drawn, const std::vector<double>& edges,
                                const std::function<double(double)>& below) {
  std::vector<double> counts(edges.size() + 1, 0.0);
  for (const double x : drawn)
    ++counts[static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), x) - edges.begin())];
  double chi_square = 0, before = 0;
  int bins = 0;
  for (std::size_t b = 0; b < counts.size(); ++b) {
    const double until = b < edges.size() ? below(edges[b]) : 1;
    const double expected = static_cast<double>(drawn.size()) * (until - before);
    before = until;
    if (expected < 1e-9) {
      EXPECT_EQ(counts[b], 0) << "bin " << b;
      continue;
    }
    ASSERT_GT(expected, 5) << "bin " << b << " is too narrow for the test";
    chi_square += (counts[b] - expected) * (counts[b] - expected) / expected;
    ++bins;
  }
  const double freedom = bins - 1;
  EXPECT_LT(chi_square, freedom + 5 * std::sqrt(2 * freedom)) << freedom << " degrees of freedom";
}

inline std::vector<double> even_edges(double low, double high, int bins) {
  std::vector<double> edges;
  for (int i = 0; i <= bins; ++i) edges.push_back(low + (high - low) * i / bins);
  return edges;
}

}  // namespace floe::test
