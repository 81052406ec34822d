// Light of a muon's segment against the moments of its distributions.
#include <gtest/gtest.h>

#include <cmath>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "propagation/ice/ice_model.h"
#include "propagation/sources/muon.h"
#include "tests/physics/engine/source_samples.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

using test::sample;
using test::Sample;

MuonSegment example_muon() {
  MuonSegment muon;
  muon.position = {10, -20, -350};
  muon.time = 500;
  muon.zenith = 1.1;
  muon.azimuth = 2.3;
  muon.length = 250;
  muon.energy = 1000;
  return muon;
}

TEST(MuonSource, HasTheLightOfItsTrackAndOfSmallLosses) {
  // At 1 TeV (0.1880 + 0.0206 ln 1000) 0.910/0.9216 = 0.3261423 of the bare track's light.
  EXPECT_NEAR(small_losses(1000), 0.3261423, 1e-6);
  const MuonSource source(example_muon(), test::line_at_400());
  EXPECT_NEAR(source.photons(), 2450.08 * 250 * 1.3261423, 1e-6 * source.photons());
  EXPECT_EQ(small_losses(1e-5), 0);  // the formula is negative there
}

TEST(MuonSource, ShinesEvenlyAlongItsWay) {
  const MuonSegment muon = example_muon();
  const MuonSource source(muon, test::line_at_400());
  const Vec3 axis = travel_direction(muon.zenith, muon.azimuth);
  const auto way = [&](const EmittedPhoton& photon) {
    return (photon.position.cast<double>() - muon.position).dot(axis);
  };
  const Sample ways = sample(source, way);
  EXPECT_NEAR(ways.mean, muon.length / 2, 4 * ways.error());
  // A box of length L: variance L^2/12, fourth central moment L^4/80.
  const double variance = muon.length * muon.length / 12, fourth = std::pow(muon.length, 4) / 80;
  EXPECT_NEAR(ways.variance, variance, 4 * std::sqrt((fourth - variance * variance) / test::draws));
  for (std::uint64_t i = 0; i < 100; ++i) {
    RandomStream random(1, 0, i);
    const EmittedPhoton photon = source.emit(random);
    EXPECT_NEAR(photon.time, muon.time + way(photon) / speed_of_light, 1e-3);
    EXPECT_NEAR((photon.position.cast<double>() - muon.position - way(photon) * axis).norm(), 0, 1e-3);
  }
}

TEST(MuonSource, BareTrackLiesOnTheConeAndSmallLossesAroundIt) {
  const MuonSegment muon = example_muon();
  const MuonSource source(muon, test::line_at_400());
  const Vec3 axis = travel_direction(muon.zenith, muon.azimuth);
  const double cone = 1 / phase_index(400), losses = small_losses(muon.energy);
  const auto cosine = [&](const EmittedPhoton& photon) { return photon.direction.cast<double>().dot(axis); };
  // Of all photons 1/(1 + losses) are on the cone, besides the few that showers send there (particles
  // within 1e-4 of the axis: u I = 1 - exp(-b (1 - cos)^a), below 0.15% at 5e-9).
  const Sample on_cone = sample(source, [&](const EmittedPhoton& photon) {
    return std::abs(cosine(photon) - cone) < 1e-5 ? 1.0 : 0.0;
  });
  EXPECT_NEAR(on_cone.mean, 1 / (1 + losses), 4 * on_cone.error() + 0.02 * losses / (1 + losses));
  // <cos> = (1 - <1 - cos of the particle>) cos of the cone, for the share of the small losses.
  const double a = 0.39, b = 2.61, I = 1 - std::exp(-b * std::pow(2, a));
  double particle = 0;
  constexpr int points = 1000000;
  for (int i = 0; i < points; ++i)
    particle += std::min(2.0, std::pow(-std::log(1 - (i + 0.5) / points * I) / b, 1 / a)) / points;
  const Sample all = sample(source, cosine);
  EXPECT_NEAR(all.mean, cone * (1 - particle * losses / (1 + losses)), 4 * all.error());
}

TEST(MuonSource, RefusesWhatIsNotPhysical) {
  MuonSegment muon = example_muon();
  muon.energy = 0;
  EXPECT_THROW(MuonSource(muon, test::line_at_400()), UsageError);
  muon = example_muon();
  muon.length = -1;
  EXPECT_THROW(MuonSource(muon, test::line_at_400()), UsageError);
}

}  // namespace
}  // namespace floe
