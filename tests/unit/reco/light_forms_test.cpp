// Closed forms and coordinates that the fit leans on.
#include <gtest/gtest.h>

#include <cmath>

#include "reco/direct_fit/arrival_profile.h"
#include "reco/direct_fit/instrumented_volume.h"
#include "reco/direct_fit/local_frame.h"
#include "reco/direct_fit/point_light.h"

namespace floe {
namespace {

TEST(PointLight, IsInverseSquareNearAndDiffusiveFar) {
  const IceLengths ice{30, 120};
  EXPECT_NEAR(point_light(0.05, ice).slope * 0.05, -2, 0.01);
  const double lp = std::sqrt(30.0 * 120 / 3);
  EXPECT_NEAR(point_light(400, ice).slope, -1 / lp - 1.0 / 400, 1e-6);
  for (const double r : {2.0, 20.0, 90.0, 300.0}) {
    const double h = 1e-4 * r;
    EXPECT_NEAR((point_light(r + h, ice).log_light - point_light(r - h, ice).log_light) / (2 * h),
                point_light(r, ice).slope, 1e-6);
  }
}

TEST(MeanIce, AveragesInverseLengths) {
  const Detector detector = ic86_detector();
  const IceModel ice(south_pole_ice(), detector);
  const MeanIce mean(ice);
  const int layer = static_cast<int>(ice.layers().size()) / 2;
  const double low = ice.z_bottom() + layer * ice.layer_step();
  const IceLengths one = mean.between(low + 0.1 * ice.layer_step(), low + 0.9 * ice.layer_step());
  EXPECT_NEAR(one.scattering, 1 / ice.effective_scattering(layer, 400), 1e-9 * one.scattering);
  const IceLengths two = mean.between(low + 2 * ice.layer_step(), low);
  EXPECT_NEAR(2 / two.absorption, ice.absorption(layer, 400) + ice.absorption(layer + 1, 400), 1e-9);
}

TEST(ArrivalProfile, DensityIsTheSlopeOfTheCumulativeCurve) {
  ArrivalProfile profile(-20, 100, 5);
  for (int i = 0; i < 50; ++i) profile.add(0.03 * i * i - 5, 1);
  profile.add(1e6, 2);  // beyond the end: in the last cell
  profile.close();
  EXPECT_NEAR(profile.total(), 52, 1e-9);
  EXPECT_EQ(profile.cumulative(-1e9), 0);
  EXPECT_NEAR(profile.cumulative(std::numeric_limits<double>::infinity()), 52, 1e-9);
  for (double t = -30; t < 120; t += 0.7)
    EXPECT_NEAR((profile.cumulative(t + 1e-5) - profile.cumulative(t - 1e-5)) / 2e-5, profile.density(t),
                1e-4);
}

TEST(LightCentre, ThereAndBackAgain) {
  for (const CascadeKind kind : {CascadeKind::electron, CascadeKind::hadron}) {
    const CascadeParameters truth{{10, -20, -300}, 55, 1.1, 4.0, 3e4};
    const CascadeParameters back = cascade_of(light_centre(truth, kind), kind);
    EXPECT_LT(distance_between(truth, back), 1e-6);
    EXPECT_LT(angle_between(truth, back), 1e-9);
    EXPECT_NEAR(back.time, 55, 1e-6);
    EXPECT_NEAR(back.energy, 3e4, 1e-3);
  }
}

TEST(LocalFrame, IsAChartOfDirections) {
  LightCentre origin{{1, 2, 3}, 10, Vec3(0.1, -0.2, -1).normalized(), 8};
  const LocalFrame frame(origin);
  const Vector7 local = (Vector7() << 1, -2, 3, 0.4, -0.9, 5, 0.3).finished();
  EXPECT_LT((frame.of(frame.at(local)) - local).norm(), 1e-12);
  EXPECT_NEAR(std::acos(frame.at(local).direction.dot(origin.direction)), std::hypot(0.4, 0.9), 1e-12);
}

TEST(LocalFrame, JacobianOfPlaceAndTimeIsExact) {
  const LocalFrame frame({{1, 2, 3}, 10, Vec3(0.6, 0, 0.8), 8});
  const Matrix7 jacobian = frame.jacobian(Vector7::Zero(), CascadeKind::electron);
  EXPECT_NEAR((jacobian.topLeftCorner<3, 3>() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-9);
  EXPECT_NEAR(jacobian(3, 5), 1, 1e-9);
  // Zenith and azimuth: an angle on the sphere is d zenith and sin(zenith) d azimuth together.
  const double sine = 0.6;
  for (const int i : {3, 4}) EXPECT_NEAR(std::hypot(jacobian(4, i), sine * jacobian(5, i)), 1, 1e-6);
  // EM light is proportional to energy.
  const double energy = cascade_of(frame.origin(), CascadeKind::electron).energy;
  EXPECT_NEAR(jacobian(6, 6) / energy, 1, 1e-5);
}

TEST(InstrumentedVolume, KnowsInsideFromOutside) {
  const InstrumentedVolume volume(ic86_detector());
  EXPECT_EQ(volume.distance_outside({0, 0, -100}), 0);
  EXPECT_NEAR(volume.distance_outside({0, 0, 900}), 400, 20);
  EXPECT_GT(volume.distance_outside({900, 0, 0}), 300);
}

}  // namespace
}  // namespace floe
