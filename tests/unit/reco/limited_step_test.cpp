#include "reco/direct_fit/limited_step.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace floe {
namespace {

// Information of two correlated numbers: their sum is known to 0.01, their difference to 10; the others to
// 0.1.
Matrix7 information() {
  Matrix7 turn = Matrix7::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(pi / 4).toRotationMatrix();
  Vector7 known = Vector7::Constant(100);
  known(0) = 0.01, known(1) = 1e4;
  return turn.transpose() * known.asDiagonal() * turn;
}

Vector7 step_to(double sum, double difference) {
  Vector7 step = Vector7::Constant(0.2);
  step(0) = (sum + difference) / 2, step(1) = (sum - difference) / 2;
  return step;
}

TEST(LimitedStep, IsTheWholeStepInside) {
  const Vector7 inside = step_to(0.3, 1.2);
  const Vector7 step = limited_step(inside, information(), information(), Vector7::Ones());
  EXPECT_LT((step - inside).norm(), 1e-9);
}

// A scaled step would take a tenth of what is known well, too.
TEST(LimitedStep, GoesAllTheWayWhereTheDataTell) {
  const Vector7 outside = step_to(0.3, 20);
  const Vector7 step = limited_step(outside, information(), information(), Vector7::Ones());
  EXPECT_NEAR(step.cwiseAbs().maxCoeff(), 1, 1e-6);
  EXPECT_NEAR(std::abs(step(0) + step(1)), 0.3, 1e-3);
  EXPECT_GT(step(0) - step(1), 1);
  EXPECT_LT(step(0) - step(1), 2);
  for (int i = 2; i < 7; ++i) EXPECT_NEAR(step(i), 0.2, 1e-3) << i;
}

TEST(LimitedStep, ScalesWithoutInformation) {
  const Vector7 outside = step_to(0, 20);
  const Vector7 step = limited_step(outside, Matrix7::Identity(), Matrix7::Zero(), Vector7::Ones());
  EXPECT_LT((step - outside / 10).norm(), 1e-12);
}

}  // namespace
}  // namespace floe
