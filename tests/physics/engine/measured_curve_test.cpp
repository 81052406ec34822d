// Beams and pulses from tables, against what they are tables of.
#include <gtest/gtest.h>

#include <cmath>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "propagation/sources/flasher.h"
#include "propagation/sources/measured_curve.h"
#include "tests/physics/engine/source_samples.h"
#include "tests/physics/engine/test_scenes.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe {
namespace {

using test::sample;
using test::Sample;

// The LED's own beam, as a table: exp(cos/width^2), up to a factor, in steps of a quarter of a degree.
MeasuredCurve table_of_gaussian_beam(double width) {
  std::vector<MeasuredCurve::Point> points;
  for (int i = 0; i <= 720; ++i) {
    const double angle = i * 0.25 * degree;
    points.push_back({angle, std::exp((std::cos(angle) - 1) / (width * width))});
  }
  return MeasuredCurve(std::move(points));
}

Sample beam_cosine(const FlasherSettings& settings) {
  const Model model = test::make_model(test::uniform_tables({}), {Vec3::Zero()});
  const FlasherSource source(*model.detector, {1, 1}, settings, test::line_at_400());
  const Vec3 led = unit_vector(pi / 2 - settings.elevation, *settings.azimuth);
  return sample(source,
                [&](const EmittedPhoton& photon) { return photon.direction.cast<double>().dot(led); });
}

FlasherSettings one_led() {
  FlasherSettings settings;
  settings.photons = 1;
  settings.azimuth = 0.4;
  settings.elevation = 48.1 * degree;
  return settings;
}

TEST(MeasuredBeam, OfAGaussianIsTheGaussianBeam) {
  const double width = 9.7 * degree;
  FlasherSettings settings = one_led();
  settings.beam = table_of_gaussian_beam(width);
  const Sample cosine = beam_cosine(settings);
  // von Mises-Fisher: <1 - cos> = width^2 and variance width^4, up to exp(-2/width^2); a table of quarter
  // degrees bends the curve by 3e-4 of it.
  EXPECT_NEAR(cosine.mean, 1 - width * width, 4 * cosine.error() + 1e-3 * width * width);
  EXPECT_NEAR(cosine.variance, std::pow(width, 4),
              4 * std::pow(width, 4) * std::sqrt(8.0 / test::draws) + 2e-3 * std::pow(width, 4));
  EXPECT_NEAR(equivalent_beam_width(*settings.beam), width, 1e-3 * width);
}

TEST(MeasuredBeam, OfEvenIntensityFillsItsCone) {
  FlasherSettings settings = one_led();
  settings.beam = MeasuredCurve({{0, 3}, {60 * degree, 3}});
  const Sample cosine = beam_cosine(settings);
  EXPECT_NEAR(cosine.mean, 0.75, 4 * cosine.error());  // cos is uniform between 1/2 and 1
  EXPECT_NEAR(cosine.variance, 0.25 / 12, 4 * 0.25 / 12 * std::sqrt(0.8 / test::draws) + 1e-5);
}

TEST(MeasuredBeam, IsStretchedWithTheFlashersProfile) {
  FlasherSettings settings = one_led();
  settings.beam = MeasuredCurve({{0, 1}, {20 * degree, 1}});
  SourceSettings sources;
  sources.width_factor = 3;
  const Sample cosine = beam_cosine(adjusted(settings, sources));
  EXPECT_NEAR(cosine.mean, (1 + std::cos(60 * degree)) / 2, 4 * cosine.error());
}

TEST(MeasuredPulse, HasTheMomentsOfItsTable) {
  const Model model = test::make_model(test::uniform_tables({}), {Vec3::Zero()});
  FlasherSettings settings;
  settings.photons = 1;
  settings.time = 100;
  settings.pulse = MeasuredCurve({{0, 2}, {10, 2}, {10.001, 6}, {20, 6}});  // a quarter and three quarters
  const FlasherSource source(*model.detector, {1, 1}, settings, test::line_at_400());
  const Sample time = sample(
      source, [](const EmittedPhoton& photon) { return photon.time - 100 - module_radius / speed_of_light; });
  EXPECT_NEAR(time.mean, 0.25 * 5 + 0.75 * 15, 4 * time.error() + 1e-3);
  const double variance = 100.0 / 12 + 0.25 * 0.75 * 100;
  EXPECT_NEAR(time.variance, variance, 4 * variance * std::sqrt(2.0 / test::draws) + 5e-3);
  EXPECT_NEAR(equivalent_pulse_width(*settings.pulse), std::sqrt(12 * variance), 5e-3);
}

void expect_refused(const std::string& text, const std::string& said) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "curve.txt";
  test::write_bytes(file, text);
  try {
    read_beam_profile(file);
    ADD_FAILURE() << "read: " << text;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
  }
}

TEST(MeasuredCurve, IsReadStrictly) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "curve.txt";
  test::write_bytes(file, "# angle intensity\n0 1\n\n90 0.5 # half\n180 0\n");
  const MeasuredCurve beam = read_beam_profile(file);
  EXPECT_NEAR(beam(pi / 4), 0.75, 1e-12);
  EXPECT_EQ(beam(-0.1), 0);
  EXPECT_EQ(read_pulse_shape(file).high(), 180);
  expect_refused("0 1\n90 0.5 3\n", ":2: ");
  expect_refused("0 1\n90 x\n", "found 'x'");
  expect_refused("0 1\n20 1\n10 1\n", ":3: found 10 after 20");
  expect_refused("0 1\n20 -1\n", ":2: found intensity -1");
  expect_refused("0 1\n181 1\n", "181");
  expect_refused("0 1\n", "at least two points");
  expect_refused("0 0\n90 0\n", "an intensity above 0");
}

}  // namespace
}  // namespace floe
