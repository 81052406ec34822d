// Events that one string saw alone: their axis, copies at other azimuths, and modules that must not be wide.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "propagation/model.h"
#include "reco/direct_fit/alike_places.h"
#include "reco/direct_fit/calibration_stages.h"
#include "reco/direct_fit/one_string.h"

namespace floe {
namespace {

class OnlyString : public testing::Test {
 protected:
  const Model model_ = load_model({});

  Vec3 place(int string, int dom) const {
    return model_.detector->modules()[model_.detector->index_of({string, dom})].position;
  }
  // So many photoelectrons in a module of string 36, and in one of string 45.
  EventData seen(int here, int elsewhere) const {
    Event event;
    event.id = "seen";
    const auto add = [&](ModuleId module, int count) {
      for (int i = 0; i < count; ++i) {
        Hit& hit = event.hits.emplace_back();
        hit.module = module, hit.time = 100.0 + i;
      }
    };
    add({36, 30}, here), add({45, 30}, elsewhere);
    return EventData(*model_.detector, event);
  }
};

TEST_F(OnlyString, HasNearlyAllOfTheLight) {
  const auto axis = axis_of_only_string(seen(86, 14));
  ASSERT_TRUE(axis);
  EXPECT_EQ((*axis - place(36, 30)).head<2>().norm(), 0);
  EXPECT_FALSE(axis_of_only_string(seen(84, 16)));
}

TEST_F(OnlyString, TurnsLightAboutItself) {
  LightCentre light;
  light.position = {12, 5, -300}, light.time = 7, light.log_light = 3;
  light.direction = Vec3(1, 0, -1).normalized();
  const LightCentre turned = turned_about({10, 5, 0}, pi / 2, light);
  EXPECT_LT((turned.position - Vec3(10, 7, -300)).norm(), 1e-12);
  EXPECT_LT((turned.direction - Vec3(0, 1, -1).normalized()).norm(), 1e-12);
  EXPECT_EQ(turned.time, light.time);
  EXPECT_EQ(turned.log_light, light.log_light);
}

TEST_F(OnlyString, MirrorsLightInThePlaneThroughItself) {
  LightCentre light;
  light.position = {12, 5, -300}, light.time = 7, light.log_light = 3;
  light.direction = Vec3(1, 2, -1).normalized();
  const Vec3 axis(10, 5, 0);
  const LightCentre mirrored = mirrored_about(axis, light);
  EXPECT_EQ(mirrored.position, light.position);
  EXPECT_LT((mirrored.direction - Vec3(1, -2, -1).normalized()).norm(), 1e-12);
  EXPECT_EQ(mirrored.time, light.time);
  EXPECT_EQ(mirrored.log_light, light.log_light);
  EXPECT_EQ(mirrored_about(light.position, light).direction, light.direction);  // no plane: nothing to mirror
}

// Places on an arc about the string, drawn with a Gaussian azimuth: their mean square about the middle one is
// what the covariance of that place has to become.
TEST_F(OnlyString, ErrorsFollowTheArcAboutIt) {
  const Vec3 axis(10, 5, 0);
  const double radius = 5, azimuth = 0.7;  // [m], [rad]
  CascadeParameters best;
  best.position = axis + radius * Vec3(std::cos(azimuth), std::sin(azimuth), 0);
  const Eigen::Vector2d along(-std::sin(azimuth), std::cos(azimuth));
  for (const double error : {0.1, 0.5, 1.0, 3.0}) {  // [rad]
    Matrix7 linear = Vector7::Constant(0.04).asDiagonal();
    linear.topLeftCorner<2, 2>() += std::pow(radius * error, 2) * along * along.transpose();
    const Matrix7 covariance = with_arc_about(axis, best, linear);
    const Eigen::Vector2d outward(std::cos(azimuth), std::sin(azimuth));
    double inside = 0;
    constexpr int draws = 100000;
    std::mt19937_64 engine(3);
    std::normal_distribution<double> normal(0, std::hypot(error, 0.2 / radius));
    std::vector<double> squares;
    for (int i = 0; i < draws; ++i) squares.push_back(std::pow(radius * (1 - std::cos(normal(engine))), 2));
    for (const double square : squares) inside += square / draws;
    double scatter = 0;
    for (const double square : squares) scatter += std::pow(square - inside, 2) / draws;
    const double added = outward.dot((covariance - linear).topLeftCorner<2, 2>() * outward);
    EXPECT_NEAR(added, inside, 4 * std::sqrt(scatter / draws)) << error;
    // Nothing else changes.
    Matrix7 rest = covariance - linear;
    rest.topLeftCorner<2, 2>() -= added * outward * outward.transpose();
    EXPECT_LT(rest.cwiseAbs().maxCoeff(), 1e-9) << error;
  }
  const Matrix7 open = Matrix7::Constant(std::numeric_limits<double>::infinity());
  EXPECT_EQ(with_arc_about(axis, best, open), open);
  best.position = axis;
  EXPECT_EQ(with_arc_about(axis, best, Matrix7::Identity()), Matrix7(Matrix7::Identity()));
}

// The best place turned by sixths of a circle about the string, as likely as `worse` says of an angle.
class AlikePlaces : public testing::Test {
 protected:
  static constexpr double radius = 10;  // [m]
  const Vec3 axis_{30, -20, 0};

  CascadeParameters turned(double angle) const {
    return {axis_ + radius * Vec3(std::cos(angle), std::sin(angle), -30), 500, 1.2, 1 + angle, 1e4};
  }
  // Errors of `error` [rad] about the string, and little ones in all else.
  Matrix7 covariance(double error) const {
    Vector7 turn = Vector7::Zero();
    turn(1) = radius * error, turn(5) = error;
    Vector7 errors;
    errors << 0.3, 0.3, 0.3, 1, 0.03, 0.03, 300;
    return Matrix7(errors.cwiseAbs2().asDiagonal()) + turn * turn.transpose();
  }
  Matrix7 added(double error, const std::function<Difference(double angle)>& worse) const {
    std::vector<AlikePlace> places;
    for (int i = 1; i < 6; ++i)
      places.push_back({turned(i * pi / 3), worse(std::remainder(i * pi / 3, 2 * pi))});
    return with_alike_places(covariance(error), turned(0), axis_, places) - covariance(error);
  }
};

TEST_F(AlikePlaces, OfAGaussianAreInItsErrors) {
  const double error = 0.3;
  const Matrix7 change = added(error, [&](double angle) {
    return Difference{angle * angle / (2 * error * error), 0.0};
  });
  EXPECT_LT(change.cwiseAbs().maxCoeff(), 0.1 * covariance(error)(1, 1));
}

TEST_F(AlikePlaces, FarWorseAddNothing) {
  EXPECT_EQ(added(0.1, [](double) { return Difference{30, 5}; }), Matrix7(Matrix7::Zero()));
}

// A flat likelihood: the mean square way between two places on a circle is 2 r^2.
TEST_F(AlikePlaces, FillTheCircleWhereItIsFlat) {
  const Matrix7 change = added(0.2, [](double) { return Difference{0, 0}; });
  EXPECT_NEAR(change(0, 0) + change(1, 1), 2 * radius * radius, 0.02 * 2 * radius * radius);
  EXPECT_GT(change(5, 5), 1);
  EXPECT_EQ(change(2, 2), 0);
}

// Modules of oversize 50 have a radius of 8.3 m: too wide for light 5 m away, not for light at 60 m.
TEST_F(OnlyString, RoughModulesDoNotReachOverTheWay) {
  LightCentre light;
  light.position = place(36, 30) + Vec3(5, 0, 0);
  EXPECT_EQ(rough_oversize(seen(95, 5), light, 10), 10);
  light.position = place(36, 30) + Vec3(0, 0, 60);
  EXPECT_EQ(rough_oversize(seen(100, 0), light, 10), 50);
}

}  // namespace
}  // namespace floe
