#include "propagation/sources/flasher.h"

#include <algorithm>
#include <cmath>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "propagation/engine/directions.h"

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

Vec3f isotropic_direction(RandomStream& random) {
  const float cosine = 2 * random.uniform() - 1;
  const float sine = std::sqrt(1 - cosine * cosine);
  const auto turn = turn_functions(random.uniform());
  return {sine * turn.cosine, sine * turn.sine, cosine};
}

// von Mises-Fisher about `axis`: 1 - cos = -w ln(u + (1 - u) exp(-2/w)), w = width^2 [rad^2].
Vec3f beam_direction(const Vec3f& axis, float w, RandomStream& random) {
  if (w == 0) return axis;
  const float u = random.uniform();
  const float one_minus_cos = -w * std::log(u + (1 - u) * std::exp(-2 / w));
  return deflect(axis, std::clamp(one_minus_cos, 0.0f, 2.0f), random.uniform());
}

}  // namespace

WavelengthSpectrum led_line(double nominal_wavelength) {
  return smooth_step_line(nominal_wavelength, nominal_wavelength - 10, nominal_wavelength + 10);
}

WavelengthSpectrum reference_led_line() {
  return smooth_step_line(404, 399, 409);
}

FlasherSource::FlasherSource(const Detector& detector, ModuleId module, const FlasherSettings& settings,
                             WavelengthSpectrum spectrum)
    : settings_(settings),
      spectrum_(std::move(spectrum)),
      module_(detector.index_of(module)),
      centre_(detector.modules()[module_].position.cast<float>()),
      led_(unit_vector(pi / 2 - settings.elevation, settings.azimuth.value_or(0)).cast<float>()) {
  if (!(settings.photons >= 0) || !std::isfinite(settings.photons))
    throw UsageError("a flasher's number of photons must be finite and not negative");
  if (!(settings.beam_width >= 0 && settings.beam_width <= 90 * degree))
    throw UsageError("a flasher's beam width must be between 0 and 90 degrees");
}

EmittedPhoton FlasherSource::emit(RandomStream& random) const {
  EmittedPhoton photon;
  photon.wavelength = static_cast<float>(spectrum_.sample(random.uniform()));
  if (settings_.isotropic) {
    photon.direction = isotropic_direction(random);
  } else {
    Vec3f led = led_;
    if (!settings_.azimuth) {
      const auto turn = turn_functions(random.uniform());
      led = {led_.x() * turn.cosine, led_.x() * turn.sine, led_.z()};
    }
    photon.direction =
        beam_direction(led, static_cast<float>(settings_.beam_width * settings_.beam_width), random);
  }
  photon.position = centre_ + static_cast<float>(module_radius) * photon.direction;
  photon.time = static_cast<float>(settings_.time + module_radius / speed_of_light);
  return photon;
}

PointSource::PointSource(const Vec3& position, double time, double photons, WavelengthSpectrum spectrum,
                         std::optional<Vec3> direction)
    : position_(position),
      time_(time),
      photons_(photons),
      spectrum_(std::move(spectrum)),
      direction_(std::move(direction)) {
  if (!(photons >= 0) || !std::isfinite(photons))
    throw UsageError("a source's number of photons must be finite and not negative");
}

EmittedPhoton PointSource::emit(RandomStream& random) const {
  EmittedPhoton photon;
  photon.wavelength = static_cast<float>(spectrum_.sample(random.uniform()));
  photon.position = position_.cast<float>();
  photon.time = static_cast<float>(time_);
  photon.direction = direction_ ? Vec3f(direction_->normalized().cast<float>()) : isotropic_direction(random);
  return photon;
}

}  // namespace floe
