#include "reco/direct_fit/average_place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reco/direct_fit/local_frame.h"

namespace floe {
namespace {

LightCentre centre() {
  LightCentre light;
  light.position = {10, -20, 30}, light.time = 500, light.log_light = 12;
  light.direction = Vec3(0, 0.2, -1).normalized();  // near the pole of zenith and azimuth
  return light;
}

// Steps there and back along each of the seven local numbers: their mean is where they began.
TEST(AveragePlace, IsTheMiddleOfStepsThereAndBack) {
  const LocalFrame frame(centre());
  Vector7 step;
  step << 1, 2, 3, 0.1, 0.2, 4, 0.05;
  std::vector<LightCentre> places;
  for (int i = 0; i < 7; ++i)
    for (const double sign : {-1.0, 1.0}) places.push_back(frame.at(sign * step(i) * Vector7::Unit(i)));
  const AveragePlace average = average_of(places);
  EXPECT_LT(frame.of(average.light).norm(), 1e-3);  // the sphere of directions is no plane
  for (int i = 0; i < 7; ++i) {
    const double expected = 2 * step(i) * step(i) / 13;
    EXPECT_NEAR(average.scatter(i, i), expected, 0.01 * expected) << i;
  }
  EXPECT_NEAR(average.scatter(0, 1), 0, 1e-6);
}

TEST(AveragePlace, OfOnePlaceTwiceDoesNotScatter) {
  const AveragePlace average = average_of(std::vector{centre(), centre()});
  EXPECT_LT((average.light.position - centre().position).norm(), 1e-12);
  EXPECT_LT((average.light.direction - centre().direction).norm(), 1e-12);
  EXPECT_LT(average.scatter.norm(), 1e-12);
}

}  // namespace
}  // namespace floe
