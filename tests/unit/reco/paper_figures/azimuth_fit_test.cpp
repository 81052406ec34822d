#include "reco/paper_figures/azimuth_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "data/base/error.h"
#include "data/base/vec3.h"

namespace floe {
namespace {

// Six neighbours of each flasher, a little off the corners of a hexagon; levels 2, 1, 2/3, ...
std::vector<AzimuthPoint> points_of(double c, double phi, double relative_error, std::size_t flashers = 4) {
  std::vector<AzimuthPoint> points;
  for (std::size_t group = 0; group < flashers; ++group)
    for (int k = 0; k < 6; ++k) {
      const double azimuth = (60 * k + 7.0 * static_cast<double>(group) + (k % 3)) * degree;
      const double level = 2 / (1 + static_cast<double>(group));
      points.push_back({group, azimuth, level * (1 + c * std::cos(2 * (azimuth - phi))), relative_error});
    }
  return points;
}

TEST(AzimuthFit, OfExactPointsIsExact) {
  const AzimuthFit fit = fit_azimuth(points_of(0.3, 130 * degree, 0.05));
  EXPECT_NEAR(fit.amplitude(), 0.3, 1e-9);
  EXPECT_NEAR(fit.phase(), 130 * degree, 1e-9);
  EXPECT_NEAR(fit.max_over_min(), 1.3 / 0.7, 1e-8);
  EXPECT_NEAR(fit.along(130 * degree), 0.3, 1e-9);
  EXPECT_NEAR(fit.along(85 * degree), 0, 1e-9);
  EXPECT_NEAR(fit.chi2, 0, 1e-9);
  EXPECT_EQ(fit.ndof, 24 - 4 - 2);
  ASSERT_EQ(fit.levels.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(fit.levels[i], 2 / (1.0 + double(i)), 1e-9);
  EXPECT_NEAR(fit.value(130 * degree), 1.3, 1e-9);
  EXPECT_NEAR(fit.value(40 * degree), 0.7, 1e-9);
}

TEST(AzimuthFit, ErrorsAreThoseOfManyRegularPoints) {
  // n points all around, of relative error s: the modulation's errors are s sqrt(2/n), for small c.
  const AzimuthFit fit = fit_azimuth(points_of(0.01, 1, 0.05, 50));
  const double expected = 0.05 * std::sqrt(2.0 / 300);
  EXPECT_NEAR(fit.amplitude_error() / expected, 1, 0.02);
  EXPECT_NEAR(fit.phase_error() * 2 * fit.amplitude() / expected, 1, 0.02);
  EXPECT_NEAR(fit.max_over_min_error() / (2 * expected), 1, 0.05);
}

// 400 fits to scattered points: the mean pull is 0 within 1/20, its width 1 within 1/28.
TEST(AzimuthFit, PullsHaveWidthOne) {
  std::mt19937_64 random(12);
  std::normal_distribution<double> gauss;
  const double phi = 40 * degree, s = 0.06;
  double sum = 0, squares = 0, phases = 0;
  int isotropic_small = 0;
  constexpr int fits = 400;
  for (int i = 0; i < fits; ++i) {
    std::vector<AzimuthPoint> points = points_of(0.25, phi, s), flat = points_of(0, 0, s);
    for (AzimuthPoint& point : points) point.ratio *= 1 + s * gauss(random);
    for (AzimuthPoint& point : flat) point.ratio *= 1 + s * gauss(random);
    const AzimuthFit fit = fit_azimuth(points);
    const double pull = (fit.along(phi) - 0.25) / fit.along_error(phi);
    sum += pull;
    squares += pull * pull;
    phases += std::pow((fit.phase() - phi) / fit.phase_error(), 2);
    isotropic_small += fit_azimuth(flat).isotropy_p_value() < 0.1;
  }
  EXPECT_NEAR(sum / fits, 0, 4 / 20.0);
  EXPECT_NEAR(std::sqrt(squares / fits), 1, 4 / 28.0);
  EXPECT_NEAR(std::sqrt(phases / fits), 1, 4 / 28.0);
  EXPECT_NEAR(isotropic_small / double(fits), 0.1, 4 * 0.015);
}

TEST(AzimuthFit, NeedsPointsAllAround) {
  std::vector<AzimuthPoint> points = points_of(0.1, 1, 0.1, 1);
  points.resize(2);
  EXPECT_THROW(fit_azimuth(points), NoResult);
  for (AzimuthPoint& point : points) point.azimuth = 1;
  points.push_back(points.front());
  EXPECT_THROW(fit_azimuth(points), NoResult);
  points = points_of(0.1, 1, 0.1, 1);
  for (AzimuthPoint& point : points) point.group = 1;  // group 0 has none
  EXPECT_THROW(fit_azimuth(points), NoResult);
}

}  // namespace
}  // namespace floe
