#include "propagation/sources/laser.h"

#include <fmt/format.h>

#include <cmath>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "propagation/engine/directions.h"
#include "propagation/ice/ice_model.h"

namespace floe {

namespace {

void expect_valid(const LaserSettings& settings) {
  if (!(settings.photons >= 0) || !std::isfinite(settings.photons))
    throw UsageError("a source's number of photons must be finite and not negative");
  if (!(settings.wavelength >= 300 && settings.wavelength <= 600))
    throw UsageError(fmt::format("a wavelength must be 300 to 600 nm, found {}", settings.wavelength));
  if (!(settings.opening >= 0 && settings.opening <= pi))
    throw UsageError("a cone's opening must be between 0 and 180 degrees");
  if (!(settings.axis.norm() > 0) || !settings.axis.allFinite())
    throw UsageError("a cone's axis must be a direction");
}

}  // namespace

double cherenkov_angle(double wavelength) {
  return std::acos(1 / phase_index(wavelength));
}

double accepted_share(double wavelength, const WavelengthSpectrum& spectrum) {
  constexpr double fine_structure = 1 / 137.035999;
  const double n = phase_index(wavelength);
  // Frank and Tamm: photons a metre of track and a nanometre of wavelength.
  const double emitted = 2 * pi * fine_structure * (1 - 1 / (n * n)) / (wavelength * wavelength * 1e-9);
  return photons_per_metre * spectrum.density(wavelength) / emitted;
}

LaserSource::LaserSource(const LaserSettings& settings) : settings_(settings) {
  expect_valid(settings);
  settings_.axis.normalize();
  if (settings.pulse) pulse_times_ = pulse_times(*settings.pulse);
}

void LaserSource::emit(RandomStreams& random, EmittedPhotons& photons) const {
  constexpr int N = EmittedPhotons::count;
  const Vec3f place = settings_.position.cast<float>(), axis = settings_.axis.cast<float>();
  const auto time = static_cast<float>(settings_.time), wavelength = static_cast<float>(settings_.wavelength);
  const bool isotropic = settings_.isotropic;
  const auto cone = static_cast<float>(1 - std::cos(settings_.opening));
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float u = random.uniform(i);
    const TurnFunctions<float> turn = turn_functions(random.uniform(i));
    float nx = axis.x(), ny = axis.y(), nz = axis.z();
    deflect(isotropic ? 2 * u : cone, turn.cosine, turn.sine, nx, ny, nz);
    photons.x[i] = place.x();
    photons.y[i] = place.y();
    photons.z[i] = place.z();
    photons.nx[i] = nx;
    photons.ny[i] = ny;
    photons.nz[i] = nz;
    photons.time[i] = time;
    photons.wavelength[i] = wavelength;
  }
  if (!pulse_times_) return;
  const auto times = pulse_times_->view();
#pragma omp simd
  for (int i = 0; i < N; ++i) photons.time[i] += times(random.uniform(i));
}

}  // namespace floe
