#include "reco/direct_fit/cascade_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "data/base/error.h"
#include "reco/direct_fit/seed.h"
#include "reco/event_data.h"
#include "tests/unit/reco/toy_light.h"

namespace floe {
namespace {

FitOptions quick() {
  FitOptions options;
  options.threads = 2;
  return options;
}

TEST(CascadeFit, FindsToyCascadesFromHitsAlone) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int events = 8;
  Vector7 square = Vector7::Zero();
  for (int i = 0; i < events; ++i) {
    ToyLight light(100 + static_cast<std::uint64_t>(i));
    CascadeParameters truth{{300 * unit(random) - 150, 300 * unit(random) - 150, 500 * unit(random) - 400},
                            2000 * unit(random),
                            std::acos(2 * unit(random) - 1),
                            2 * pi * unit(random),
                            std::pow(10, 3.7 + 0.6 * unit(random))};
    const Event event = light.draw(truth, 77777);
    const EventData data(*light.model().detector, event);
    const CascadeFit fit = fit_cascade(light, data, quick());
    ASSERT_EQ(fit.status, FitStatus::ok) << fit.reason << "\n" << describe(fit);
    EXPECT_LT(distance_between(truth, fit.cascade), 10) << describe(fit);
    EXPECT_LT(angle_between(truth, fit.cascade), 20 * degree) << describe(fit);
    Vector7 gap = to_vector(fit.cascade) - to_vector(truth);
    gap(5) = std::remainder(gap(5), 2 * pi);
    square += gap.cwiseAbs2().cwiseQuotient(fit.covariance.diagonal());
    EXPECT_GT(fit.p_value, 1e-4);
  }
  // Errors are right: 8 squared pulls of one parameter follow chi-square (99.9%: 26.1, 0.1%: 0.86), widened
  // by the noise that simulations leave in the errors themselves, 1.3 in each; the sum of 56 pulls, which are
  // correlated, lies within a third of its expectation times that noise.
  for (int i = 0; i < 7; ++i) EXPECT_LT(square(i), 26.1 * 1.3 * 1.3) << "parameter " << i;
  EXPECT_LT(std::sqrt(square.sum() / 56), 1.35);
  EXPECT_GT(std::sqrt(square.sum() / 56), 0.65);
}

// Seen in the study: 208 photoelectrons from dust, "353 PeV +- 865 PeV" instead of 100 TeV.
// Light seems to come from the same place, at the same depth and zenith angle.
TEST(CascadeFit, TriesTheOppositeWay) {
  const LightCentre light{{10, -20, 30}, 5, Vec3(1, 2, -2) / 3, 7};
  const LightCentre other = turned_round(light, 12);
  EXPECT_TRUE(other.direction.isApprox(Vec3(-1, -2, -2) / 3));
  EXPECT_TRUE((other.position + 12 * other.direction).isApprox(light.position + 12 * light.direction));
  EXPECT_EQ(other.position.z(), light.position.z());
  EXPECT_EQ(other.time, light.time);
  EXPECT_EQ(other.log_light, light.log_light);
  EXPECT_TRUE(turned_round(other, 12).position.isApprox(light.position));
}

TEST(CascadeFit, HasAnEnergyWhenItsErrorIsSmaller) {
  Matrix7 covariance = Matrix7::Identity();
  covariance(6, 6) = 90.0 * 90.0;
  EXPECT_TRUE(determines_energy(covariance, 100));
  EXPECT_FALSE(determines_energy(covariance, 80));
  covariance(6, 6) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(determines_energy(covariance, 80));
}

TEST(CascadeFit, IsTheSameForAnyNumberOfThreads) {
  const CascadeParameters truth{{20, -40, -300}, 100, 1.2, 2.0, 3000};
  CascadeFit fits[2];
  for (int i = 0; i < 2; ++i) {
    ToyLight light(5);
    const Event event = light.draw(truth, 1);
    const EventData data(*light.model().detector, event);
    FitOptions options = quick();
    options.threads = i + 1;
    options.start = truth;
    fits[i] = fit_cascade(light, data, options);
  }
  EXPECT_EQ(to_vector(fits[0].cascade), to_vector(fits[1].cascade));
  EXPECT_EQ(fits[0].neg_llh, fits[1].neg_llh);
}

TEST(CascadeFit, ABadDescriptionHasASmallPValue) {
  ToyLight light(5);
  const CascadeParameters truth{{20, -40, -300}, 100, 1.2, 2.0, 3000};
  Event event = light.draw(truth, 1);
  const Event other = light.draw({{-80, 90, -180}, 400, 0.4, 1.0, 1500}, 2);  // a second cascade on top
  event.hits.insert(event.hits.end(), other.hits.begin(), other.hits.end());
  const EventData data(*light.model().detector, event);
  const CascadeFit fit = fit_cascade(light, data, quick());
  EXPECT_LT(fit.p_value, 1e-6);
}

TEST(CascadeFit, SaysWhenThereIsNotEnoughLight) {
  ToyLight light(5);
  Event event;
  event.id = "dark";
  Hit hit;
  hit.module = {21, 30};
  event.hits = {hit, hit};
  const EventData data(*light.model().detector, event);
  const CascadeFit fit = fit_cascade(light, data, quick());
  EXPECT_EQ(fit.status, FitStatus::not_enough_light);
  EXPECT_NE(fit.reason.find("not enough light"), std::string::npos);
}

TEST(CascadeFit, SaysWhenTheVertexIsOutside) {
  ToyLight light(5, 30);
  const CascadeParameters truth{{0, -60, 640}, 0, 0.8, 2.0, 5000};
  const Event event = light.draw(truth, 1);
  const EventData data(*light.model().detector, event);
  FitOptions options = quick();
  options.start = truth;
  const CascadeFit fit = fit_cascade(light, data, options);
  EXPECT_EQ(fit.status, FitStatus::outside) << fit.reason;
}

TEST(CascadeFit, RefusesOptionsOutOfRange) {
  ToyLight light(5);
  const Event event = light.draw({{20, -40, -300}, 100, 1.2, 2.0, 3000}, 1);
  const EventData data(*light.model().detector, event);
  for (const auto spoil :
       {+[](FitOptions& o) { o.oversize = 0.5; }, +[](FitOptions& o) { o.model_error = -1; },
        +[](FitOptions& o) { o.effort = 0; }, +[](FitOptions& o) { o.sky_map_pixels = 4; }}) {
    FitOptions options = quick();
    spoil(options);
    EXPECT_THROW(fit_cascade(light, data, options), UsageError);
  }
}

TEST(CascadeFit, CallsATrackATrack) {
  ToyLight light(9);
  Event event;
  event.id = "track";
  const Vec3 direction = travel_direction(1.3, 0.4);
  for (int i = 0; i < 40; ++i) {  // light all along a line at the speed of light
    const double l = 15.0 * i - 300;
    const Event piece =
        light.draw({Vec3(0, 0, -150) + l * direction, l / 0.299792458, 1.3, 0.4, 150}, 50u + unsigned(i));
    event.hits.insert(event.hits.end(), piece.hits.begin(), piece.hits.end());
  }
  const EventData data(*light.model().detector, event);
  FitOptions options = quick();
  options.effort = 0.2;
  const CascadeFit fit = fit_cascade(light, data, options);
  EXPECT_TRUE(fit.status == FitStatus::track_like || fit.status == FitStatus::no_convergence) << fit.reason;
  EXPECT_NE(fit.reason.find("looks like a track"), std::string::npos) << fit.reason;
}

}  // namespace
}  // namespace floe
