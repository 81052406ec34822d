// Slopes of the layers, depth by depth.
#include <gtest/gtest.h>

#include <cmath>

#include "propagation/ice/tilt.h"
#include "reco/ice_fit/ice_parameter.h"

namespace floe {
namespace {

constexpr DepthRange range{1600, 2200, 3};

// Of a place along the direction of the tilt, against the frame's origin [m].
double rise_at(const Model& model, double distance, double depth) {
  const auto shift = [&](double d) {
    const Vec3 at(d * std::cos(tilt_lines_direction), d * std::sin(tilt_lines_direction), 1948.07 - depth);
    return model.ice->tilt().shift(static_cast<float>(at.x()), static_cast<float>(at.y()),
                                   static_cast<float>(at.z()));
  };
  return shift(distance) - shift(0);
}

TEST(TiltParameters, AreSlopesInTheMiddleOfEachGroup) {
  const Model base = load_model({});
  const auto parameters = tilt_parameters(range);
  ASSERT_EQ(parameters.size(), 3u);
  const Model tilted = with_parameters(base, parameters, {10, -20, 40});
  for (const double distance : {-300.0, 200.0}) {
    // Rows of the tilt's table, 10 m apart, cut the corners: by half of that times 60 m/km in 200 m of depth.
    const double corner = 5 * 60e-3 / 200 * std::abs(distance);
    EXPECT_NEAR(rise_at(tilted, distance, 1700), 0.010 * distance, corner);
    EXPECT_NEAR(rise_at(tilted, distance, 1900), -0.020 * distance, corner);
    EXPECT_NEAR(rise_at(tilted, distance, 2100), 0.040 * distance, corner);
    EXPECT_NEAR(rise_at(tilted, distance, 1800), -0.005 * distance, 0.02);  // half-way
    EXPECT_NEAR(rise_at(tilted, distance, 1500), 0.010 * distance, 0.02);   // beyond the outermost
    EXPECT_NEAR(rise_at(tilted, distance, 2400), 0.040 * distance, 0.02);
  }
}

TEST(TiltParameters, ChangeNothingAtZero) {
  const Model base = load_model({});
  EXPECT_EQ(with_parameters(base, tilt_parameters(range), {0, 0, 0}).ice->hash(), base.ice->hash());
}

TEST(TiltParameters, AddToTheTiltThatIsThere) {
  ModelRequest request;
  request.with = {{"tilt", "slope", 15}};
  const Model base = load_model(request);
  const Model more = with_parameters(base, tilt_parameters(range), {5, 5, 5});
  EXPECT_NEAR(rise_at(more, 400, 1850), 0.020 * 400, 0.02);
}

}  // namespace
}  // namespace floe
