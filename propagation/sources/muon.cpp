#include "propagation/sources/muon.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "propagation/sources/cherenkov.h"

namespace floe {

double small_losses(double energy) {
  return std::max(0.0, 0.1880 + 0.0206 * std::log(energy)) * density_ratio;
}

MuonSource::MuonSource(const MuonSegment& muon, const WavelengthSpectrum& spectrum)
    : muon_(muon),
      start_(muon.position.cast<float>()),
      axis_(travel_direction(muon.zenith, muon.azimuth).cast<float>()),
      wavelengths_(QuantileTable::of_quantile([&](double u) { return spectrum.sample(u); })),
      cherenkov_angles_(cherenkov_angles(spectrum)),
      particle_angles_(shower_particle_angles()),
      bare_share_(static_cast<float>(1 / (1 + small_losses(muon.energy)))) {
  if (!(muon.energy > 0) || !std::isfinite(muon.energy))
    throw UsageError(fmt::format("a muon's energy must be positive, found {} GeV", muon.energy));
  if (!(muon.length >= 0) || !std::isfinite(muon.length))
    throw UsageError(fmt::format("a muon's length must not be negative, found {} m", muon.length));
}

double MuonSource::photons() const {
  return photons_per_metre * muon_.length * (1 + small_losses(muon_.energy));
}

void MuonSource::emit(RandomStreams& random, EmittedPhotons& photons) const {
  const auto wavelengths = wavelengths_.view(), cherenkov = cherenkov_angles_.view(),
             particle_angles = particle_angles_.view();
  const float start_x = start_.x(), start_y = start_.y(), start_z = start_.z();
  const float axis_x = axis_.x(), axis_y = axis_.y(), axis_z = axis_.z();
  const auto length = static_cast<float>(muon_.length), start = static_cast<float>(muon_.time);
  const float bare_share = bare_share_;
  constexpr auto slowness = static_cast<float>(1 / speed_of_light);
#pragma omp simd
  for (int i = 0; i < EmittedPhotons::count; ++i) {
    const float colour = random.uniform(i);
    photons.wavelength[i] = wavelengths(colour);
    const float way = length * random.uniform(i);
    photons.x[i] = start_x + way * axis_x;
    photons.y[i] = start_y + way * axis_y;
    photons.z[i] = start_z + way * axis_z;
    photons.time[i] = start + way * slowness;

    float nx = axis_x, ny = axis_y, nz = axis_z;
    const float choice = random.uniform(i), shower_angle = particle_angles(random.uniform(i));
    turn_to_photon(random, i, choice < bare_share ? 0.0f : shower_angle, cherenkov(colour), nx, ny, nz);
    photons.nx[i] = nx;
    photons.ny[i] = ny;
    photons.nz[i] = nz;
  }
}

}  // namespace floe
