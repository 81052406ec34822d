// C-axes: the fitted distribution has the eigenvalues, and the draws have the distribution.
#include "propagation/crystal/fabric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "data/base/error.h"

namespace floe {
namespace {

// Largest difference of the draws' second moments from `expected`, in standard errors.
double worst_moment(const Fabric& fabric, const std::array<double, 3>& expected) {
  constexpr int draws = 200000;
  RandomStream stream(1, 2, 3);
  std::array<double, 3> sum{}, squares{};
  for (int i = 0; i < draws; ++i) {
    const Vec3 c = fabric.draw(stream);
    EXPECT_NEAR(c.norm(), 1, 1e-14);
    for (int k = 0; k < 3; ++k) sum[k] += c[k] * c[k], squares[k] += std::pow(c[k], 4);
  }
  double worst = 0;
  for (int k = 0; k < 3; ++k) {
    const double mean = sum[k] / draws, variance = squares[k] / draws - mean * mean;
    worst = std::max(worst, std::abs(mean - expected[k]) / (std::sqrt(variance / draws) + 1e-15));
  }
  return worst;
}

TEST(Fabric, IsotropicAndGirdle) {
  EXPECT_LT(worst_moment(Fabric::isotropic(), {1.0 / 3, 1.0 / 3, 1.0 / 3}), 4);
  EXPECT_LT(worst_moment(Fabric::girdle(), {0, 0.5, 0.5}), 4);
}

class FabricOfEigenvalues : public ::testing::TestWithParam<std::pair<double, double>> {};

TEST_P(FabricOfEigenvalues, HasThem) {
  const auto [first, second] = GetParam();
  const FabricEigenvalues S = fabric_eigenvalues(first, second);
  EXPECT_NEAR(S.S1 + S.S2 + S.S3, 1, 1e-15);
  EXPECT_NEAR(std::log(S.S1 / S.S2), first, 1e-12);
  EXPECT_NEAR(std::log(S.S2 / S.S3), second, 1e-12);
  const Fabric fabric = Fabric::from_eigenvalues(S);
  const auto moments = second_moments({fabric.rates()});
  EXPECT_NEAR(moments[2] / S.S1, 1, 1e-6);
  EXPECT_NEAR(moments[1] / S.S2, 1, 1e-6);
  EXPECT_NEAR(moments[0] / S.S3, 1, 1e-6);
  EXPECT_LT(worst_moment(fabric, {S.S3, S.S2, S.S1}), 4.5);
}

INSTANTIATE_TEST_SUITE_P(Kinds, FabricOfEigenvalues,
                         ::testing::Values(std::pair{0.1, 4.0}, std::pair{0.0, 1.0}, std::pair{1.0, 1.0},
                                           std::pair{4.0, 0.0}, std::pair{0.0, 6.0}, std::pair{6.0, 6.0},
                                           std::pair{0.0, 0.0}, std::pair{0.02, 0.03}));

// exp(-rate c_x^2) around the flow: the density of |c_x| on [0, 1].
TEST(Fabric, DrawsHaveTheDensity) {
  const double rate = 7;
  const Fabric fabric = Fabric::bingham({{rate, 0, 0}});
  constexpr int bins = 20, draws = 200000;
  std::vector<int> found(bins);
  RandomStream stream(5, 0, 0);
  for (int i = 0; i < draws; ++i)
    ++found[std::min(bins - 1, static_cast<int>(std::abs(fabric.draw(stream).x()) * bins))];
  const double whole = std::erf(std::sqrt(rate));
  double chi_square = 0;
  int used = 0;
  for (int i = 0; i < bins; ++i) {
    const double expected =
        draws * (std::erf(std::sqrt(rate) * (i + 1) / bins) - std::erf(std::sqrt(rate) * i / bins)) / whole;
    chi_square += std::pow(found[i] - expected, 2) / expected;
    ++used;
  }
  EXPECT_NEAR(chi_square, used - 1, 4 * std::sqrt(2.0 * (used - 1)));
}

TEST(Fabric, RatiosBeyondTheRangeAreErrors) {
  EXPECT_THROW(fabric_eigenvalues(-0.1, 4), UsageError);
  EXPECT_THROW(fabric_eigenvalues(0, 7), UsageError);
  EXPECT_THROW(fabric_eigenvalues(0, std::nan("")), UsageError);
}

}  // namespace
}  // namespace floe
