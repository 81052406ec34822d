// Sources draw their photons many at a time: each as if it were alone, from its own stream.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "propagation/sources/cascade.h"
#include "propagation/sources/flasher.h"
#include "propagation/sources/laser.h"
#include "propagation/sources/muon.h"

namespace floe {
namespace {

constexpr int N = EmittedPhotons::count;

RandomStream stream_of(int block, int i) {
  return RandomStream(3, 14, static_cast<std::uint64_t>(N * block + i));
}

struct Block {
  RandomStreams streams;  // as the photons leave them
  EmittedPhotons photons;
};

Block emit_block(const Source& source, int block) {
  Block result;
  for (int i = 0; i < N; ++i) result.streams.set(i, stream_of(block, i));
  source.emit(result.streams, result.photons);
  return result;
}

EmittedPhoton emit_alone(const Source& source, RandomStream stream) {
  return source.emit(stream);
}

// The photons of many streams are those of each stream alone, and `draws` numbers are used up.
void expect_the_same_alone(const Source& source, int draws, int blocks = 20) {
  for (int block = 0; block < blocks; ++block) {
    const auto [streams, many] = emit_block(source, block);
    for (int i = 0; i < N; ++i) {
      RandomStream alone = stream_of(block, i), advanced = alone;
      const EmittedPhoton photon = source.emit(alone);
      ASSERT_EQ(photon.position, Vec3f(many.x[i], many.y[i], many.z[i])) << i;
      ASSERT_EQ(photon.direction, Vec3f(many.nx[i], many.ny[i], many.nz[i])) << i;
      ASSERT_EQ(photon.time, many.time[i]) << i;
      ASSERT_EQ(photon.wavelength, many.wavelength[i]) << i;
      for (int k = 0; k < draws; ++k) advanced.bits();
      ASSERT_EQ(streams[i].state(), advanced.state()) << i;
      ASSERT_EQ(alone.state(), advanced.state()) << i;
      ASSERT_NEAR(photon.direction.cast<double>().norm(), 1, 1e-6);
    }
  }
}

const WavelengthSpectrum& spectrum() {
  static const WavelengthSpectrum broad({{0, 300}, {0.4, 380}, {1, 600}});
  return broad;
}

TEST(Emission, OfCascadesIsTheSameAlone) {
  for (const CascadeKind kind : {CascadeKind::electron, CascadeKind::gamma, CascadeKind::hadron})
    for (const double energy : {0.01, 1.0, 1e3, 1e7}) {
      Cascade cascade;
      cascade.position = {-300, 200, 100};
      cascade.time = 1e4;
      cascade.energy = energy;
      cascade.kind = kind;
      for (const double zenith : {0.0, 1.0, pi}) {
        cascade.zenith = zenith;
        cascade.azimuth = 2 * zenith;
        // Colour, depth, and two angles each for the particle and for the photon around it; the Cherenkov
        // angle follows from the colour.
        expect_the_same_alone(CascadeSource(cascade, spectrum()), 5, 3);
      }
    }
}

TEST(Emission, OfMuonsIsTheSameAlone) {
  MuonSegment muon;
  muon.position = {-300, 200, 100};
  muon.length = 400;
  muon.energy = 500;
  for (const double zenith : {0.0, 1.0, pi}) {
    muon.zenith = zenith;
    // Colour, place, whose light it is, and two angles each for the particle and for the photon around it;
    // the Cherenkov angle follows from the colour.
    expect_the_same_alone(MuonSource(muon, spectrum()), 6, 3);
  }
}

TEST(Emission, OfLasersIsTheSameAlone) {
  LaserSettings light;
  light.photons = 1;
  for (const bool isotropic : {false, true})
    for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0.6, 0, 0.8)}) {
      light.isotropic = isotropic;
      light.axis = axis;
      light.opening = 0.7;
      light.pulse.reset();
      expect_the_same_alone(LaserSource(light), 2, 3);
      light.pulse = MeasuredCurve({{0, 1}, {5, 0}});
      expect_the_same_alone(LaserSource(light), 3, 3);
    }
}

TEST(Emission, OfCascadesIsAlongTheAxisAtTheSpeedOfLight) {
  Cascade cascade;
  cascade.position = {10, -20, 30};
  cascade.time = 50;
  cascade.energy = 1000;
  cascade.zenith = 0.7;
  cascade.azimuth = 4;
  const CascadeSource source(cascade, spectrum());
  const Vec3 axis = travel_direction(cascade.zenith, cascade.azimuth);
  for (int i = 0; i < 1000; ++i) {
    const EmittedPhoton photon = emit_alone(source, stream_of(0, i));
    const Vec3 offset = photon.position.cast<double>() - cascade.position;
    const double depth = offset.dot(axis);
    ASSERT_GE(depth, -1e-4);
    ASSERT_NEAR((offset - depth * axis).norm(), 0, 1e-5);
    ASSERT_NEAR(photon.time, cascade.time + depth / speed_of_light, 1e-4);
    // The first number is the colour's.
    RandomStream again = stream_of(0, i);
    ASSERT_NEAR(photon.wavelength, spectrum().sample(again.uniform()), 0.05);
  }
}

class FlasherEmission : public ::testing::Test {
 protected:
  FlasherEmission() : detector_("one", {module_at({30, -40, 50})}) {}
  static Module module_at(const Vec3& position) {
    Module module;
    module.id = {1, 1};
    module.position = position;
    return module;
  }
  Detector detector_;
};

TEST_F(FlasherEmission, IsTheSameAloneWithEveryOption) {
  for (const bool isotropic : {false, true})
    for (const std::optional<double> azimuth :
         {std::optional<double>(), std::optional(0.0), std::optional(2.5)})
      for (const double width : {0.0, 1e-3, 9.7 * degree, 60 * degree, 90 * degree})
        for (const double elevation : {-0.2 * degree, 48 * degree, 90 * degree, -90 * degree}) {
          FlasherSettings settings;
          settings.photons = 1000;
          settings.isotropic = isotropic;
          settings.azimuth = azimuth;
          settings.beam_width = width;
          settings.elevation = elevation;
          settings.time = 17;
          // The colour; both angles, or the LED's azimuth where it is not given and two around its beam.
          const int draws = 1 + (isotropic ? 2 : (azimuth ? 0 : 1) + (width > 0 ? 2 : 0));
          expect_the_same_alone(FlasherSource(detector_, {1, 1}, settings, led_line(405)), draws, 3);
        }
}

// A number more for the LED where there are several, and one for the place in the pulse where there is one.
TEST_F(FlasherEmission, IsTheSameAloneWithPatternsAndPulses) {
  for (const bool ring : {false, true})
    for (const int leds : {1, 6})
      for (const double pulse : {0.0, 70.0})
        for (const double width : {0.0, 9.7 * degree}) {
          FlasherSettings settings;
          settings.photons = 1000;
          if (!ring) settings.azimuth = 0.5;
          settings.leds = leds;
          settings.pulse_width = pulse;
          settings.beam_width = width;
          const int draws = 1 + (ring || leds > 1 ? 1 : 0) + (width > 0 ? 2 : 0) + (pulse > 0 ? 1 : 0);
          expect_the_same_alone(FlasherSource(detector_, {1, 1}, settings, led_line(405)), draws, 3);
        }
}

// Measured curves take the numbers that a beam and a pulse take without them.
TEST_F(FlasherEmission, IsTheSameAloneWithMeasuredCurves) {
  FlasherSettings settings;
  settings.photons = 1000;
  settings.azimuth = 0.5;
  settings.beam = MeasuredCurve({{0, 1}, {0.3, 0.5}, {pi, 0}});
  settings.pulse = MeasuredCurve({{-2, 0}, {0, 1}, {9, 0}});
  expect_the_same_alone(FlasherSource(detector_, {1, 1}, settings, led_line(405)), 4, 3);
}

// Each photon of a pulse is the one it would be without, only later.
TEST_F(FlasherEmission, OfAPulseIsOnlyDelayed) {
  FlasherSettings settings;
  settings.photons = 1000;
  const FlasherSource flash(detector_, {1, 1}, settings, led_line(405));
  settings.pulse_width = 70;
  const FlasherSource pulse(detector_, {1, 1}, settings, led_line(405));
  for (int i = 0; i < 1000; ++i) {
    const EmittedPhoton early = emit_alone(flash, stream_of(4, i)), late = emit_alone(pulse, stream_of(4, i));
    ASSERT_EQ(late.position, early.position);
    ASSERT_EQ(late.direction, early.direction);
    ASSERT_EQ(late.wavelength, early.wavelength);
    ASSERT_GE(late.time, early.time);
    ASSERT_LE(late.time, early.time + 70.001F);
  }
}

TEST_F(FlasherEmission, RefusesPatternsAndPulsesThatMakeNoSense) {
  FlasherSettings settings;
  settings.leds = 0;
  EXPECT_THROW(FlasherSource(detector_, {1, 1}, settings, led_line(405)), UsageError);
  settings.leds = 6;
  for (const double width : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    settings.pulse_width = width;
    EXPECT_THROW(FlasherSource(detector_, {1, 1}, settings, led_line(405)), UsageError) << width;
  }
}

TEST(FlasherSettings, AreThoseOfTheRun) {
  FlasherRun run;
  run.module = {1, 1};
  EXPECT_THROW(flasher_settings(run), UsageError);  // how bright?
  run.photons = 1e9;
  run.pulse_width = 70;
  run.beam_width = 5 * degree;
  FlasherSettings settings = flasher_settings(run);
  EXPECT_EQ(settings.photons, 1e9);
  EXPECT_EQ(settings.pulse_width, 70);
  EXPECT_EQ(settings.beam_width, 5 * degree);
  EXPECT_EQ(settings.elevation, -0.2 * degree);
  EXPECT_FALSE(settings.azimuth);
  run.leds = {LedPattern::Kind::single, 3};
  EXPECT_THROW(flasher_settings(run), UsageError);  // where is it?
  run.orientation = 10 * degree;
  settings = flasher_settings(run);
  EXPECT_NEAR(settings.azimuth.value(), 130 * degree, 1e-12);
  EXPECT_EQ(settings.elevation, 48.1 * degree);
  EXPECT_EQ(settings.leds, 1);
  run.leds = {LedPattern::Kind::horizontal, 0};
  settings = flasher_settings(run);
  EXPECT_NEAR(settings.azimuth.value(), 10 * degree, 1e-12);
  EXPECT_EQ(settings.leds, 6);
}

TEST_F(FlasherEmission, StartsOnTheModulesSurface) {
  for (const bool isotropic : {false, true}) {
    FlasherSettings settings;
    settings.photons = 1000;
    settings.isotropic = isotropic;
    settings.time = 17;
    const FlasherSource source(detector_, {1, 1}, settings, led_line(405));
    EXPECT_EQ(source.emitting_module(), 0U);
    for (int i = 0; i < 1000; ++i) {
      const EmittedPhoton photon = emit_alone(source, stream_of(1, i));
      const Vec3 place = detector_.modules()[0].position + module_radius * photon.direction.cast<double>();
      ASSERT_NEAR((photon.position.cast<double>() - place).norm(), 0, 1e-5);
      ASSERT_NEAR(photon.time, 17 + module_radius / speed_of_light, 1e-5);
      ASSERT_NEAR(photon.wavelength, 405, 10.001);
    }
  }
}

// A pencil beam points where its LED points; around the vertical it keeps its elevation.
TEST_F(FlasherEmission, OfAPencilKeepsItsElevation) {
  FlasherSettings settings;
  settings.photons = 1000;
  settings.beam_width = 0;
  settings.elevation = 48 * degree;
  for (const bool turned : {false, true}) {
    settings.azimuth = turned ? std::optional<double>() : std::optional(-1.0);
    const FlasherSource source(detector_, {1, 1}, settings, led_line(405));
    for (int i = 0; i < 1000; ++i) {
      const EmittedPhoton photon = emit_alone(source, stream_of(2, i));
      ASSERT_NEAR(photon.direction.z(), std::sin(48 * degree), 1e-6);
      if (!turned) {
        ASSERT_NEAR(std::atan2(photon.direction.y(), photon.direction.x()), -1, 1e-6);
      }
    }
  }
}

TEST(Emission, OfPointSourcesIsTheSameAlone) {
  expect_the_same_alone(PointSource(Vec3(1, 2, 3), 4, 1000, spectrum()), 3);
  const Vec3 along(1, -2, 2);
  const PointSource beam(Vec3(1, 2, 3), 4, 1000, spectrum(), along);
  expect_the_same_alone(beam, 1);
  const EmittedPhoton photon = emit_alone(beam, stream_of(0, 0));
  EXPECT_EQ(photon.position, Vec3f(1, 2, 3));
  EXPECT_EQ(photon.time, 4);
  EXPECT_NEAR((photon.direction.cast<double>() - along / 3).norm(), 0, 1e-6);
}

// Draws a number of numbers that differs from photon to photon, which blocks of photons must not mix up.
class Unsteady : public OneByOneSource {
 public:
  double photons() const override { return 1; }

 protected:
  EmittedPhoton emit_one(RandomStream& random) const override {
    const std::uint32_t draws = random.bits() % 5;
    float sum = 0;
    for (std::uint32_t k = 0; k < draws; ++k) sum += random.uniform();
    return {{sum, static_cast<float>(draws), 3}, 4 + sum, {0.6F, 0, -0.8F}, 400 + sum};
  }
};

TEST(Emission, OfOneByOneSourcesIsTheSameAlone) {
  const Unsteady source;
  for (int block = 0; block < 20; ++block) {
    const auto [streams, many] = emit_block(source, block);
    for (int i = 0; i < N; ++i) {
      RandomStream alone = stream_of(block, i), by_hand = alone;
      const EmittedPhoton photon = source.emit(alone);
      const std::uint32_t draws = by_hand.bits() % 5;
      float sum = 0;
      for (std::uint32_t k = 0; k < draws; ++k) sum += by_hand.uniform();
      EXPECT_EQ(photon.position, Vec3f(sum, static_cast<float>(draws), 3));
      EXPECT_EQ(Vec3f(many.x[i], many.y[i], many.z[i]), photon.position);
      EXPECT_EQ(Vec3f(many.nx[i], many.ny[i], many.nz[i]), Vec3f(0.6F, 0, -0.8F));
      EXPECT_EQ(many.time[i], 4 + sum);
      EXPECT_EQ(many.wavelength[i], 400 + sum);
      EXPECT_EQ(streams[i].state(), by_hand.state());
      EXPECT_EQ(alone.state(), by_hand.state());
    }
  }
}

}  // namespace
}  // namespace floe
