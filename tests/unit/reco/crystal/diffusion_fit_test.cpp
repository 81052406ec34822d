// The 12 numbers from values that the functions themselves gave.
#include "reco/crystal/diffusion_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "data/base/error.h"

namespace floe {
namespace {

enum Curve { sigma_x, sigma_y, mean_x };

std::vector<AngleValue> points_of(const BirefringenceNumbers& numbers, Curve curve, double error,
                                  double noise = 0) {
  std::mt19937_64 generator(4);
  std::normal_distribution<double> gauss;
  std::vector<AngleValue> points;
  for (int angle = 0; angle <= 90; angle += 5) {
    const DiffusionStep step = diffusion_step(numbers, std::cos(angle * degree));
    const double value = curve == sigma_x ? step.sigma_x : curve == sigma_y ? step.sigma_y : step.mean_x;
    points.push_back({angle * degree, value + noise * error * gauss(generator), error});
  }
  return points;
}

double value_of(const DiffusionFunction& f, Curve curve, double angle) {
  BirefringenceNumbers numbers;
  numbers.sigma_x = numbers.mean_x = f;
  const DiffusionStep step = diffusion_step(numbers, std::cos(angle));
  return curve == mean_x ? step.mean_x : step.sigma_x;
}

// The published D of the widths is so small that only B D^C is told: other numbers, the same curve.
TEST(DiffusionFit, FindsThePublishedCurves) {
  const BirefringenceNumbers published = published_birefringence();
  for (const Curve curve : {sigma_x, sigma_y, mean_x}) {
    const auto points = points_of(published, curve, curve == mean_x ? 1e-5 : 1e-4);
    const FunctionFit fit = curve == mean_x ? fit_mean(points) : fit_sigma(points);
    for (const AngleValue& point : points)
      EXPECT_NEAR(value_of(fit.numbers, curve, point.angle), point.value, 2e-6) << curve;
    EXPECT_EQ(fit.D_held, curve != mean_x);
    EXPECT_LT(fit.chi_square, 0.1);
    EXPECT_LT(fit.worst, 1e-3);
  }
  const FunctionFit width = fit_sigma(points_of(published, sigma_x, 1e-4));
  EXPECT_NEAR(width.numbers.A / published.sigma_x.A, 1, 1e-3);
  EXPECT_NEAR(width.numbers.C / published.sigma_x.C, 1, 1e-3);
  EXPECT_EQ(width.errors.D, 0);
  const FunctionFit mean = fit_mean(points_of(published, mean_x, 1e-5));
  EXPECT_NEAR(mean.numbers.C, published.mean_x.C, 0.02);
  EXPECT_NEAR(mean.numbers.D, published.mean_x.D, 0.05);
}

TEST(DiffusionFit, FindsNumbersThatAreTold) {
  BirefringenceNumbers numbers;
  numbers.sigma_x = {0.07, 0.9, 2.2, 3};
  const FunctionFit fit = fit_sigma(points_of(numbers, sigma_x, 1e-4, 1));
  EXPECT_FALSE(fit.D_held);
  EXPECT_NEAR(fit.numbers.A, 0.07, 4 * fit.errors.A);
  EXPECT_NEAR(fit.numbers.B, 0.9, 4 * fit.errors.B);
  EXPECT_NEAR(fit.numbers.C, 2.2, 4 * fit.errors.C);
  EXPECT_NEAR(fit.numbers.D, 3, 4 * fit.errors.D);
  EXPECT_LT(fit.errors.D, 0.5);
  EXPECT_EQ(fit.degrees_of_freedom, 15);
  EXPECT_NEAR(fit.chi_square, 15, 4 * std::sqrt(30.0));
}

// Light that is turned away from the flow.
TEST(DiffusionFit, FindsNegativeDeflections) {
  BirefringenceNumbers numbers;
  numbers.mean_x = {-0.001, 0.2, 1, 2};
  const auto points = points_of(numbers, mean_x, 1e-6);
  const FunctionFit fit = fit_mean(points);
  for (const AngleValue& point : points)
    EXPECT_NEAR(value_of(fit.numbers, mean_x, point.angle), point.value, 1e-6);
}

TEST(DiffusionFit, NeedsPoints) {
  auto points = points_of(published_birefringence(), sigma_x, 1e-4);
  points.resize(4);
  EXPECT_THROW(fit_sigma(points), NoResult);
  points = points_of(published_birefringence(), sigma_x, 0);
  EXPECT_THROW(fit_sigma(points), NoResult);
}

}  // namespace
}  // namespace floe
