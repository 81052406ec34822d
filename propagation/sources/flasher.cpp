#include "propagation/sources/flasher.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/base/constants.h"
#include "data/base/error.h"

namespace floe {

namespace {

// A smooth step 3x^2 - 2x^3 of half-width 10 nm about `nominal`, of which [low, high] is kept.
WavelengthSpectrum smooth_step_line(double nominal, double low, double high) {
  constexpr double half_width = 10;
  const auto cumulative = [&](double wavelength) {
    const double x = std::clamp((wavelength - nominal + half_width) / (2 * half_width), 0.0, 1.0);
    return x * x * (3 - 2 * x);
  };
  constexpr int intervals = 40;
  const double before = cumulative(low), all = cumulative(high) - before;
  std::vector<WavelengthSpectrum::Point> points;
  for (int i = 0; i <= intervals; ++i) {
    const double wavelength = low + (high - low) * i / intervals;
    points.push_back({i == intervals ? 1.0 : (cumulative(wavelength) - before) / all, wavelength});
  }
  return WavelengthSpectrum(std::move(points));
}

}  // namespace

WavelengthSpectrum led_line(double nominal_wavelength) {
  return smooth_step_line(nominal_wavelength, nominal_wavelength - 10, nominal_wavelength + 10);
}

WavelengthSpectrum reference_led_line() {
  return smooth_step_line(404, 399, 409);
}

FlasherSettings flasher_settings(const FlasherRun& run) {
  if (std::isnan(run.photons))
    throw UsageError("a flasher run without its number of photons cannot be simulated");
  FlasherSettings settings;
  settings.photons = run.photons;
  settings.beam_width = run.beam_width;
  settings.elevation = run.leds.elevation();
  settings.pulse_width = run.pulse_width;
  if (run.leds.kind == LedPattern::Kind::ring) return settings;
  if (std::isnan(run.orientation))
    throw UsageError(
        fmt::format("LEDs {} of a module of unknown orientation cannot be simulated", name_of(run.leds)));
  settings.azimuth = run.orientation + run.leds.azimuth();
  settings.leds = run.leds.count();
  return settings;
}

FlasherSettings adjusted(FlasherSettings nominal, const SourceSettings& sources) {
  nominal.photons *= sources.brightness_factor;
  nominal.beam_width *= sources.width_factor;
  // Factors of 0 make pencils, which no curve can be: that beam is as narrow as makes no difference.
  if (nominal.beam && sources.width_factor != 1)
    nominal.beam = nominal.beam->stretched(std::max(sources.width_factor, 1e-6));
  nominal.time += sources.time_offset;
  return nominal;
}

FlasherSource::FlasherSource(const Detector& detector, ModuleId module, const FlasherSettings& settings,
                             const WavelengthSpectrum& spectrum)
    : settings_(settings),
      wavelengths_(QuantileTable::of_quantile([&](double u) { return spectrum.sample(u); })),
      module_(detector.index_of(module)),
      centre_(detector.modules()[module_].position.cast<float>()),
      led_(unit_vector(pi / 2 - settings.elevation, settings.azimuth.value_or(0)).cast<float>()) {
  if (!(settings.photons >= 0) || !std::isfinite(settings.photons))
    throw UsageError("a flasher's number of photons must be finite and not negative");
  if (!(settings.beam_width >= 0 && settings.beam_width <= 90 * degree))
    throw UsageError("a flasher's beam width must be between 0 and 90 degrees");
  if (settings.leds < 1) throw UsageError("a flasher's number of LEDs must be at least 1");
  if (!(settings.pulse_width >= 0) || !std::isfinite(settings.pulse_width))
    throw UsageError("a flasher's pulse width must be finite and not negative");
  if (settings.beam) beam_angles_ = beam_angles(*settings.beam);
  if (settings.pulse) pulse_times_ = pulse_times(*settings.pulse);
}

PointSource::PointSource(const Vec3& position, double time, double photons,
                         const WavelengthSpectrum& spectrum, std::optional<Vec3> direction)
    : position_(position),
      time_(time),
      photons_(photons),
      wavelengths_(QuantileTable::of_quantile([&](double u) { return spectrum.sample(u); })),
      direction_(std::move(direction)) {
  if (!(photons >= 0) || !std::isfinite(photons))
    throw UsageError("a source's number of photons must be finite and not negative");
}

}  // namespace floe
