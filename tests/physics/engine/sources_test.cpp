// Sources against the moments of their distributions.
#include <gtest/gtest.h>

#include <cmath>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "propagation/ice/ice_model.h"
#include "propagation/sources/cascade.h"
#include "propagation/sources/flasher.h"
#include "tests/physics/engine/source_samples.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

using test::draws;
using test::sample;
using test::Sample;

Cascade example_cascade(CascadeKind kind, double energy) {
  Cascade cascade;
  cascade.position = {10, -20, -350};
  cascade.time = 500;
  cascade.zenith = 1.1;
  cascade.azimuth = 2.3;
  cascade.energy = energy;
  cascade.kind = kind;
  return cascade;
}

TEST(CascadeSource, HasTheYieldOfItsEnergy) {
  // 5.321 m/GeV at a density of 0.910, in ice of 0.9216 (arXiv:1210.5140): 1 TeV makes 5254 m of track.
  const CascadeSource source(example_cascade(CascadeKind::electron, 1000), test::line_at_400());
  EXPECT_NEAR(source.photons(), 5254.02 * 2450.08, 2e-5 * 1.287e7);
}

TEST(CascadeSource, HadronsMakeLessLightWithFluctuations) {
  // F(1 TeV) = 1 - (1000/0.18791678)^-0.16267529 (1 - 0.30974123), sigma_F = F 0.95899551
  // ln(1000)^-1.35589541.
  const LightYield em = light_yield(CascadeKind::electron, 1000),
                   hadron = light_yield(CascadeKind::hadron, 1000);
  EXPECT_NEAR(hadron.mean / em.mean, 0.829046, 1e-5);
  EXPECT_NEAR(hadron.spread / hadron.mean, 0.0697852, 1e-6);
  double sum = 0, square = 0;
  constexpr int events = 20000;
  for (int i = 0; i < events; ++i) {
    RandomStream random(9, 0, static_cast<std::uint64_t>(i));
    const double light = draw_yield_fluctuation(CascadeKind::hadron, 1000, random);
    sum += light / events;
    square += light * light / events;
  }
  const double spread = std::sqrt(square - sum * sum);
  EXPECT_NEAR(sum, 1, 4 * 0.0698 / std::sqrt(events));
  EXPECT_NEAR(spread, 0.0698, 4 * 0.0698 / std::sqrt(2.0 * events));
}

TEST(CascadeSource, EmitsAlongTheAxisWithTheLongitudinalProfile) {
  for (const CascadeKind kind :
       {CascadeKind::electron, CascadeKind::positron, CascadeKind::gamma, CascadeKind::hadron}) {
    const Cascade cascade = example_cascade(kind, 50e3);
    const CascadeSource source(cascade, test::line_at_400());
    const Vec3 axis = travel_direction(cascade.zenith, cascade.azimuth);
    const auto depth = [&](const EmittedPhoton& photon) {
      return (photon.position.cast<double>() - cascade.position).dot(axis);
    };
    const LongitudinalProfile profile = longitudinal_profile(kind, cascade.energy);
    const Sample depths = sample(source, depth);
    EXPECT_NEAR(depths.mean, profile.shape * profile.scale, 4 * depths.error());
    EXPECT_NEAR(depths.variance, profile.shape * profile.scale * profile.scale, 0.03 * depths.variance);
    RandomStream random(1, 0, 0);
    const EmittedPhoton photon = source.emit(random);
    EXPECT_NEAR(photon.time, cascade.time + depth(photon) / speed_of_light, 1e-3);
  }
}

TEST(CascadeSource, EmitsAroundTheCherenkovCone) {
  const Cascade cascade = example_cascade(CascadeKind::electron, 1000);
  const CascadeSource source(cascade, test::line_at_400());
  const Vec3 axis = travel_direction(cascade.zenith, cascade.azimuth);
  const Sample cosine =
      sample(source, [&](const EmittedPhoton& photon) { return photon.direction.cast<double>().dot(axis); });
  // The azimuths around particle and cone are independent: <cos> = <cos of the particle> cos of the cone.
  // <1 - cos> of the particle: integral of the inverse cumulative, by the midpoint rule.
  const double a = 0.39, b = 2.61, I = 1 - std::exp(-b * std::pow(2, a));
  double loss = 0;
  constexpr int points = 1000000;
  for (int i = 0; i < points; ++i) {
    const double u = (i + 0.5) / points;
    loss += std::min(2.0, std::pow(-std::log(1 - u * I) / b, 1 / a)) / points;
  }
  EXPECT_NEAR(cosine.mean, (1 - loss) / phase_index(400), 4 * cosine.error());
}

TEST(FlasherSource, HasTheBeamOfItsLed) {
  const Model model = test::make_model(test::uniform_tables({}), {Vec3(1, 2, -3)});
  FlasherSettings settings;
  settings.photons = 1e6;
  settings.azimuth = 30 * degree;
  settings.elevation = 48.1 * degree;
  const FlasherSource source(*model.detector, {1, 1}, settings, test::line_at_400());
  const Vec3 led = unit_vector(pi / 2 - settings.elevation, *settings.azimuth);
  const Sample cosine =
      sample(source, [&](const EmittedPhoton& photon) { return photon.direction.cast<double>().dot(led); });
  const double concentration = 1 / (settings.beam_width * settings.beam_width);
  // von Mises-Fisher: <cos> = coth(k) - 1/k; coth is 1 here to 30 digits.
  EXPECT_NEAR(cosine.mean, 1 - 1 / concentration, 4 * cosine.error());
  const Sample radius = sample(source, [](const EmittedPhoton& photon) {
    return (photon.position.cast<double>() - Vec3(1, 2, -3)).norm();
  });
  EXPECT_NEAR(radius.mean, module_radius, 1e-5);
}

TEST(FlasherSource, IsSymmetricInAzimuthByDefault) {
  const Model model = test::make_model(test::uniform_tables({}), {Vec3::Zero()});
  FlasherSettings settings;
  settings.photons = 1;
  const FlasherSource source(*model.detector, {1, 1}, settings, reference_led_line());
  for (const int k : {1, 2, 3}) {  // Fourier components of the azimuth
    const Sample component = sample(source, [k](const EmittedPhoton& photon) {
      return std::cos(k * std::atan2(photon.direction.y(), photon.direction.x()));
    });
    EXPECT_NEAR(component.mean, 0, 4 * component.error());
  }
  const Sample elevation = sample(source, [](const EmittedPhoton& photon) { return photon.direction.z(); });
  EXPECT_NEAR(elevation.mean, std::sin(settings.elevation) * (1 - std::pow(settings.beam_width, 2)),
              4 * elevation.error());
  const Sample wavelength = sample(source, [](const EmittedPhoton& photon) { return photon.wavelength; });
  EXPECT_NEAR(wavelength.mean, 404, 4 * wavelength.error());
}

FlasherSettings run_settings(const LedPattern& leds) {
  FlasherRun run;
  run.module = {1, 1};
  run.leds = leds;
  run.orientation = 20 * degree;
  run.photons = 1;
  return flasher_settings(run);
}

// A Fourier component of the azimuth, taken from the azimuth of LED 1 and LED 7.
Sample azimuth_component(const FlasherSource& source, int k) {
  return sample(source, [k](const EmittedPhoton& photon) {
    return std::cos(k * (std::atan2(photon.direction.y(), photon.direction.x()) - 20 * degree));
  });
}

// The mean direction of a von Mises-Fisher beam is its axis times coth(k) - 1/k, which is 1 - 1/k here to 30
// digits.
TEST(FlasherSource, SingleLedsPointWhereTheBoardHasThem) {
  const Model model = test::make_model(test::uniform_tables({}), {Vec3::Zero()});
  for (const int number : {1, 4, 7, 12}) {
    const FlasherSettings settings = run_settings({LedPattern::Kind::single, number});
    const FlasherSource source(*model.detector, {1, 1}, settings, test::line_at_400());
    const double elevation = number <= 6 ? 48.1 : -0.2, azimuth = 20 + (number - 1) % 6 * 60;
    const Vec3 led = unit_vector((90 - elevation) * degree, azimuth * degree);
    for (int axis = 0; axis < 3; ++axis) {
      const Sample component =
          sample(source, [axis](const EmittedPhoton& photon) { return photon.direction[axis]; });
      EXPECT_NEAR(component.mean, led[axis] * (1 - std::pow(settings.beam_width, 2)), 4 * component.error())
          << "LED " << number << ", axis " << axis;
    }
  }
}

TEST(FlasherSource, SixLedsShareTheLightEvenly) {
  const Model model = test::make_model(test::uniform_tables({}), {Vec3::Zero()});
  for (const auto kind : {LedPattern::Kind::horizontal, LedPattern::Kind::tilted}) {
    FlasherSettings settings = run_settings({kind, 0});
    settings.beam_width = 0;  // pencils: each photon names its LED
    const FlasherSource source(*model.detector, {1, 1}, settings, test::line_at_400());
    int photons_of[6] = {};
    for (int i = 0; i < draws; ++i) {
      RandomStream random(1, 0, static_cast<std::uint64_t>(i));
      const EmittedPhoton photon = source.emit(random);
      const double turn = std::atan2(photon.direction.y(), photon.direction.x()) / degree - 20;
      const double led = (turn < -30 ? turn + 360 : turn) / 60;
      ASSERT_NEAR(led, std::round(led), 1e-5);
      ASSERT_NEAR(photon.direction.z(), std::sin(settings.elevation), 1e-6);
      ++photons_of[static_cast<int>(std::lround(led)) % 6];
    }
    // Chi-square with 5 degrees of freedom: 30 and more has a probability of 1.5e-5.
    double chi_square = 0;
    for (const int photons : photons_of) chi_square += std::pow(photons - draws / 6.0, 2) / (draws / 6.0);
    EXPECT_LT(chi_square, 30);
  }
}

// Sixfold about the vertical: of the azimuth's Fourier components only every sixth is left, and that one is a
// single LED's.
TEST(FlasherSource, SixLedsAreSixfoldInAzimuth) {
  const Model model = test::make_model(test::uniform_tables({}), {Vec3::Zero()});
  const FlasherSettings settings = run_settings({LedPattern::Kind::tilted, 0});
  const FlasherSource six(*model.detector, {1, 1}, settings, test::line_at_400());
  for (const int k : {1, 2, 3, 4, 5}) {
    const Sample component = azimuth_component(six, k);
    EXPECT_NEAR(component.mean, 0, 4 * component.error()) << k;
  }
  const FlasherSource one(*model.detector, {1, 1}, run_settings({LedPattern::Kind::single, 1}),
                          test::line_at_400());
  const Sample of_six = azimuth_component(six, 6), of_one = azimuth_component(one, 6);
  EXPECT_GT(of_one.mean, 0.2);
  EXPECT_NEAR(of_six.mean, of_one.mean, 4 * std::hypot(of_six.error(), of_one.error()));
  const Sample elevation = sample(six, [](const EmittedPhoton& photon) { return photon.direction.z(); });
  EXPECT_NEAR(elevation.mean, std::sin(48.1 * degree) * (1 - std::pow(settings.beam_width, 2)),
              4 * elevation.error());
}

// A box of width W: mean W/2, variance W^2/12, fourth central moment W^4/80.
TEST(FlasherSource, PulsesAreEvenlyBright) {
  const Model model = test::make_model(test::uniform_tables({}), {Vec3::Zero()});
  FlasherSettings settings;
  settings.photons = 1;
  settings.time = 100;
  constexpr double width = 70;
  settings.pulse_width = width;
  const FlasherSource source(*model.detector, {1, 1}, settings, test::line_at_400());
  const Sample time = sample(
      source, [](const EmittedPhoton& photon) { return photon.time - 100 - module_radius / speed_of_light; });
  EXPECT_NEAR(time.mean, width / 2, 4 * time.error());
  const double fourth = std::pow(width, 4) / 80, variance = width * width / 12;
  EXPECT_NEAR(time.variance, variance, 4 * std::sqrt((fourth - variance * variance) / draws));
}

TEST(FlasherSource, IsotropicLightFillsTheSphere) {
  const Model model = test::make_model(test::uniform_tables({}), {Vec3::Zero()});
  FlasherSettings settings;
  settings.isotropic = true;
  const FlasherSource source(*model.detector, {1, 1}, settings, test::line_at_400());
  const Sample z = sample(source, [](const EmittedPhoton& photon) { return photon.direction.z(); });
  EXPECT_NEAR(z.mean, 0, 4 * z.error());
  EXPECT_NEAR(z.variance, 1.0 / 3, 0.005);
}

TEST(Sources, RefuseWhatIsNotPhysical) {
  Cascade cascade;
  cascade.energy = -1;
  EXPECT_THROW(CascadeSource(cascade, test::line_at_400()), UsageError);
  EXPECT_THROW(PointSource(Vec3::Zero(), 0, -1, test::line_at_400()), UsageError);
  EXPECT_THROW(cascade_kind_of("muon"), UsageError);
}

}  // namespace
}  // namespace floe
