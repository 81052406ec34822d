// Light from a point, on a cone or into all directions, against its moments.
#include <gtest/gtest.h>

#include <cmath>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "geometry/acceptance.h"
#include "propagation/ice/ice_model.h"
#include "propagation/sources/laser.h"
#include "tests/physics/engine/source_samples.h"

namespace floe {
namespace {

using test::sample;
using test::Sample;

LaserSettings standard_candle() {
  LaserSettings light;
  light.position = {1, 2, -3};
  light.time = 40;
  light.photons = 1e6;
  light.opening = cherenkov_angle(nitrogen_laser_wavelength);
  return light;
}

TEST(LaserSource, ShinesAtTheCherenkovAngle) {
  const LaserSettings light = standard_candle();
  // n(337 nm) = 1.3271 by the dispersion formula: 41.1 degrees.
  EXPECT_NEAR(light.opening / degree, 41.1, 0.05);
  const LaserSource source(light);
  EXPECT_EQ(source.photons(), 1e6);
  const Sample up = sample(source, [](const EmittedPhoton& photon) { return photon.direction.z(); });
  EXPECT_NEAR(up.mean, 1 / phase_index(337), 1e-5);
  EXPECT_LT(up.variance, 1e-9);
  for (const int k : {1, 2, 3}) {  // Fourier components of the azimuth
    const Sample component = sample(source, [k](const EmittedPhoton& photon) {
      return std::cos(k * std::atan2(photon.direction.y(), photon.direction.x()));
    });
    EXPECT_NEAR(component.mean, 0, 4 * component.error()) << k;
  }
  RandomStream random(1, 0, 0);
  const EmittedPhoton photon = source.emit(random);
  EXPECT_EQ(photon.position, Vec3f(1, 2, -3));
  EXPECT_EQ(photon.time, 40);
  EXPECT_EQ(photon.wavelength, 337);
}

TEST(LaserSource, OpensAboutItsAxis) {
  LaserSettings light = standard_candle();
  light.axis = 2 * unit_vector(1.2, 0.7);  // its length does not matter
  light.opening = 0.5;
  const LaserSource source(light);
  for (int i = 0; i < 3; ++i) {
    const Sample component = sample(source, [i](const EmittedPhoton& photon) { return photon.direction[i]; });
    EXPECT_NEAR(component.mean, std::cos(0.5) * unit_vector(1.2, 0.7)[i], 4 * component.error() + 1e-6) << i;
  }
}

TEST(LaserSource, WithoutConeFillsTheSphere) {
  LaserSettings light = standard_candle();
  light.isotropic = true;
  const LaserSource source(light);
  for (int i = 0; i < 3; ++i) {
    const Sample component = sample(source, [i](const EmittedPhoton& photon) { return photon.direction[i]; });
    EXPECT_NEAR(component.mean, 0, 4 * component.error()) << i;
    // <x^4> - <x^2>^2 = 1/5 - 1/9 for a component of an isotropic direction.
    EXPECT_NEAR(component.variance, 1.0 / 3, 4 * std::sqrt((0.2 - 1.0 / 9) / test::draws)) << i;
  }
}

TEST(LaserSource, HasTheMomentsOfItsPulse) {
  LaserSettings light = standard_candle();
  light.pulse = MeasuredCurve({{-4, 0}, {0, 1}, {8, 0}});  // a triangle from a to b with its peak at c
  const LaserSource source(light);
  const Sample time = sample(source, [](const EmittedPhoton& photon) { return photon.time - 40; });
  const double a = -4, c = 0, b = 8, variance = (a * a + b * b + c * c - a * b - a * c - b * c) / 18;
  EXPECT_NEAR(time.mean, (a + b + c) / 3, 4 * time.error());
  // The fourth central moment of any triangle is 2.4 times the variance squared.
  EXPECT_NEAR(time.variance, variance, 4 * variance * std::sqrt(1.4 / test::draws) + 1e-3);
}

TEST(AcceptedShare, GivesBackTheAcceptedLightOfATrack) {
  // Over all wavelengths, the light of a bare track (Frank and Tamm) times the share is what N counts.
  const WavelengthSpectrum spectrum = builtin_acceptance().spectrum;
  double accepted = 0;
  constexpr double step = 0.05;
  for (double w = 300 + step / 2; w < 680; w += step) {
    const double n = phase_index(w);
    const double emitted = 2 * pi / 137.036 * (1 - 1 / (n * n)) / (w * w * 1e-9);
    accepted += step * emitted * accepted_share(w, spectrum);
  }
  EXPECT_NEAR(accepted, photons_per_metre, 1e-3 * photons_per_metre);
  // A module's effective area head-on is 111 cm^2 at 400 nm; averaged over directions a third (the
  // instrument's paper, arXiv:1612.05093), out of a sphere of 856 cm^2 whose angular acceptance N leaves out.
  EXPECT_GT(accepted_share(400, spectrum), 0.05);
  EXPECT_LT(accepted_share(400, spectrum), 0.25);
}

TEST(LaserSource, RefusesWhatIsNotPhysical) {
  for (const auto& spoil :
       {+[](LaserSettings& s) { s.photons = -1; }, +[](LaserSettings& s) { s.wavelength = 200; },
        +[](LaserSettings& s) { s.opening = 4; }, +[](LaserSettings& s) { s.axis.setZero(); }}) {
    LaserSettings light = standard_candle();
    spoil(light);
    EXPECT_THROW(LaserSource{light}, UsageError);
  }
}

}  // namespace
}  // namespace floe
