// Drawing the photons of LEDs and point sources, many at a time: the loops become vector code.
#include <cmath>
#include <cstdint>

#include "data/base/constants.h"
#include "propagation/engine/directions.h"
#include "propagation/sources/flasher.h"

namespace floe {

namespace {

constexpr int N = EmittedPhotons::count;

void draw_wavelengths(const QuantileTable& table, RandomStreams& random, EmittedPhotons& photons) {
  const auto wavelengths = table.view();
#pragma omp simd
  for (int i = 0; i < N; ++i) photons.wavelength[i] = wavelengths(random.uniform(i));
}

void isotropic_directions(RandomStreams& random, EmittedPhotons& photons) {
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float cosine = 2 * random.uniform(i) - 1;
    const float sine = std::sqrt(1 - cosine * cosine);
    const TurnFunctions<float> turn = turn_functions(random.uniform(i));
    photons.nx[i] = sine * turn.cosine;
    photons.ny[i] = sine * turn.sine;
    photons.nz[i] = cosine;
  }
}

void same_direction(const Vec3f& direction, EmittedPhotons& photons) {
  const float nx = direction.x(), ny = direction.y(), nz = direction.z();
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    photons.nx[i] = nx;
    photons.ny[i] = ny;
    photons.nz[i] = nz;
  }
}

// Turns every direction about the vertical by an angle of its own.
void turn_about_vertical(RandomStreams& random, EmittedPhotons& photons) {
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const TurnFunctions<float> turn = turn_functions(random.uniform(i));
    const float nx = photons.nx[i], ny = photons.ny[i];
    photons.nx[i] = turn.cosine * nx - turn.sine * ny;
    photons.ny[i] = turn.sine * nx + turn.cosine * ny;
  }
}

// von Mises-Fisher about each direction: 1 - cos = -w ln(u + (1 - u) exp(-2/w)), w = width^2 [rad^2].
void widen_beam(float w, RandomStreams& random, EmittedPhotons& photons) {
  const float opposite = std::exp(-2 / w);
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float u = random.uniform(i);
    const float loss = larger(0, smaller(2, -w * natural_log(u + (1 - u) * opposite)));
    const TurnFunctions<float> turn = turn_functions(random.uniform(i));
    deflect(loss, turn.cosine, turn.sine, photons.nx[i], photons.ny[i], photons.nz[i]);
  }
}

// Turns every direction by an angle of a measured beam: 1 - cos = 2 sin^2 of its half.
void widen_beam(const QuantileTable& table, RandomStreams& random, EmittedPhotons& photons) {
  const auto angles = table.view();
  constexpr auto half_turns = static_cast<float>(1 / (4 * pi));
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float half = turn_functions(half_turns * angles(random.uniform(i))).sine;
    const TurnFunctions<float> turn = turn_functions(random.uniform(i));
    deflect(2 * half * half, turn.cosine, turn.sine, photons.nx[i], photons.ny[i], photons.nz[i]);
  }
}

// Gives every photon to one of `leds` LEDs that stand evenly about the vertical, all lit alike.
void turn_to_leds(int leds, RandomStreams& random, EmittedPhotons& photons) {
  const auto count = static_cast<float>(leds), spacing = 1 / count;
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const auto led = static_cast<float>(static_cast<std::int32_t>(count * random.uniform(i)));
    const TurnFunctions<float> turn = turn_functions(spacing * smaller(led, count - 1));
    const float nx = photons.nx[i], ny = photons.ny[i];
    photons.nx[i] = turn.cosine * nx - turn.sine * ny;
    photons.ny[i] = turn.sine * nx + turn.cosine * ny;
  }
}

// Delays every photon by its place in a pulse of even brightness.
void spread_over_pulse(float width, RandomStreams& random, EmittedPhotons& photons) {
#pragma omp simd
  for (int i = 0; i < N; ++i) photons.time[i] += width * random.uniform(i);
}

// Delays every photon by its place in a measured pulse.
void spread_over_pulse(const QuantileTable& table, RandomStreams& random, EmittedPhotons& photons) {
  const auto times = table.view();
#pragma omp simd
  for (int i = 0; i < N; ++i) photons.time[i] += times(random.uniform(i));
}

// `ahead` of a place, along each photon's direction.
void start_ahead(const Vec3f& place, float ahead, float time, EmittedPhotons& photons) {
  const float x = place.x(), y = place.y(), z = place.z();
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    photons.x[i] = x + ahead * photons.nx[i];
    photons.y[i] = y + ahead * photons.ny[i];
    photons.z[i] = z + ahead * photons.nz[i];
    photons.time[i] = time;
  }
}

}  // namespace

void FlasherSource::emit(RandomStreams& random, EmittedPhotons& photons) const {
  draw_wavelengths(wavelengths_, random, photons);
  if (settings_.isotropic) {
    isotropic_directions(random, photons);
  } else {
    same_direction(led_, photons);
    if (!settings_.azimuth) turn_about_vertical(random, photons);
    const auto w = static_cast<float>(settings_.beam_width * settings_.beam_width);
    if (beam_angles_)
      widen_beam(*beam_angles_, random, photons);
    else if (w > 0)
      widen_beam(w, random, photons);
    if (settings_.azimuth && settings_.leds > 1) turn_to_leds(settings_.leds, random, photons);
  }
  const auto left = static_cast<float>(settings_.time + module_radius / speed_of_light);
  start_ahead(centre_, static_cast<float>(module_radius), left, photons);
  // Numbers for the pulse are drawn last, and only for a pulse: without one a seed means the same photons as
  // ever.
  if (pulse_times_)
    spread_over_pulse(*pulse_times_, random, photons);
  else if (settings_.pulse_width > 0)
    spread_over_pulse(static_cast<float>(settings_.pulse_width), random, photons);
}

void PointSource::emit(RandomStreams& random, EmittedPhotons& photons) const {
  draw_wavelengths(wavelengths_, random, photons);
  if (direction_)
    same_direction(direction_->normalized().cast<float>(), photons);
  else
    isotropic_directions(random, photons);
  start_ahead(position_.cast<float>(), 0, static_cast<float>(time_), photons);
}

}  // namespace floe
