// The birefringent step against its moments (arXiv:2107.08692).
#include "propagation/engine/birefringence.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <random>

#include "data/base/vec3.h"
#include "propagation/engine/ice_view.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

// Axes of the plane across n: x towards the nearer flow direction, y = n cross x.
struct Axes {
  Vec3 x, y;
};
Axes axes_of(const Vec3& n, const Vec3& flow) {
  const Vec3 nearer = flow.dot(n) < 0 ? Vec3(-flow) : flow;
  const Vec3 x = (nearer - nearer.dot(n) * n).normalized();
  return {x, n.cross(x)};
}

class BirefringentStepTest : public ::testing::TestWithParam<Vec3> {};

TEST_P(BirefringentStepTest, HasTheMomentsOfItsEquations) {
  const double sigma_x = 0.004, sigma_y = 0.007, mean_x = 0.003, length = 3;
  const Vec3 flow = unit_vector(pi / 2, 130 * degree), n0 = GetParam().normalized();
  const auto [ax, ay] = axes_of(n0, flow);
  constexpr int draws = 200000;
  std::mt19937_64 generator(11);
  std::normal_distribution<double> gauss;
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  Eigen::Matrix4d square = Eigen::Matrix4d::Zero();
  for (int i = 0; i < draws; ++i) {
    Vec3 n = n0, r = Vec3::Zero();
    const auto frame = flow_frame(flow.x(), flow.y(), n.x(), n.y(), n.z());
    birefringent_deflection(frame, sigma_x, sigma_y, mean_x, gauss(generator), gauss(generator),
                            gauss(generator), gauss(generator), length, n.x(), n.y(), n.z(), r.x(), r.y(),
                            r.z());
    ASSERT_NEAR(n.norm(), 1, 1e-12);
    const Eigen::Vector4d v(n.dot(ax), n.dot(ay), r.dot(ax), r.dot(ay));
    sum += v / draws;
    square += v * v.transpose() / draws;
  }
  const Eigen::Matrix4d covariance = square - sum * sum.transpose();
  // Direction: mean (m, 0), widths sigma. Displacement: mean and covariance L/2 with the direction's own
  // change, and an independent variance sigma^2 L^2/12, sigma^2 L^2/3 in all. The sphere's curvature adds
  // terms of third order, below 1e-7 here.
  const double curvature = 1e-7;
  const Eigen::Vector2d sigma(sigma_x, sigma_y), mean(mean_x, 0);
  for (int i = 0; i < 2; ++i) {
    const double width = sigma[i], variance = width * width, error = 4 / std::sqrt(draws);
    EXPECT_NEAR(sum[i], mean[i], error * width + curvature);
    EXPECT_NEAR(covariance(i, i), variance, error * std::sqrt(2.0) * variance + curvature * width);
    EXPECT_NEAR(sum[i + 2], mean[i] * length / 2, error * width * length + curvature * length);
    EXPECT_NEAR(covariance(i + 2, i + 2), variance * length * length / 3,
                2 * error * variance * length * length);
    EXPECT_NEAR(covariance(i, i + 2), variance * length / 2, 2 * error * variance * length);
    EXPECT_NEAR(covariance(0, 1), 0, error * sigma_x * sigma_y + 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Directions, BirefringentStepTest,
                         ::testing::Values(Vec3(0.2, 0.3, 0.9), Vec3(-0.5, 0.1, -0.7), Vec3(0, 0, 1),
                                           Vec3(0.6, -0.8, 0.01)));

TEST(BirefringentStep, ProjectsStereographically) {
  for (const double p : {1e-4, 0.1, 1.0, 5.0}) {
    const auto point = project_onto_sphere(p, 0.0);
    const double theta = 2 * std::atan(p / 2);
    EXPECT_NEAR(point.x, std::sin(theta), 1e-12);
    EXPECT_NEAR(point.loss, 1 - std::cos(theta), 1e-12);
    EXPECT_EQ(point.y, 0);
  }
}

TEST(BirefringentStep, IsFiniteAlongTheFlow) {
  float n[3] = {1, 0, 0}, r[3] = {0, 0, 0};
  birefringent_deflection(flow_frame(1.0f, 0.0f, n[0], n[1], n[2]), 0.01f, 0.01f, 0.0f, 1.0f, 1.0f, 1.0f,
                          1.0f, 2.0f, n[0], n[1], n[2], r[0], r[1], r[2]);
  EXPECT_NEAR(std::hypot(n[1], n[2]), 0.01 * std::sqrt(2.0), 1e-5);
}

// The engine's tables against the exact functions.
TEST(IceView, TabulatesTheDiffusionFunctions) {
  IceTables tables = test::uniform_tables({});
  tables.configuration.birefringence = south_pole_ice().configuration.birefringence;
  for (IceLayerRow& row : tables.layers) row.effective_scattering = 0.1;
  const Model model = test::make_model(tables, {Vec3::Zero()});
  const IceView view(*model.ice);
  const auto table_at = [&view](IceView::BirefringenceColumn column, double cosine) {
    const double place = cosine * IceView::birefringence_intervals;
    const int index = std::min(static_cast<int>(place), IceView::birefringence_intervals - 1);
    const float* row = view.birefringence[index].values;  // the change is the next column
    return row[column] + (place - index) * row[column + 1];
  };
  double worst = 0;
  for (int i = 1; i < 10000; ++i) {
    const double cosine = i / 10000.0, steep = cosine * std::sqrt(1 - cosine * cosine);
    const DiffusionStep exact = diffusion_step(*tables.configuration.birefringence, cosine);
    worst = std::max({worst, std::abs(table_at(IceView::sigma_x, cosine) / exact.sigma_x - 1),
                      std::abs(table_at(IceView::sigma_y, cosine) / exact.sigma_y - 1)});
    EXPECT_NEAR(table_at(IceView::drift, cosine) * steep, exact.mean_x, 2e-3 * 0.01) << cosine;
  }
  EXPECT_LT(worst, 2e-3);
}

}  // namespace
}  // namespace floe
