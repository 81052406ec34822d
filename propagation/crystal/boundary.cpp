#include "propagation/crystal/boundary.h"

#include <Eigen/Dense>
#include <cmath>

namespace floe {

namespace {

using Complex = std::complex<double>;

// Energy that the wave of amplitude 1 carries along the normal.
double normal_flux(const Fields& wave, const Vec3& normal) {
  const ComplexVec3 H = wave.H.conjugate();
  const ComplexVec3 flux(wave.E[1] * H[2] - wave.E[2] * H[1], wave.E[2] * H[0] - wave.E[0] * H[2],
                         wave.E[0] * H[1] - wave.E[1] * H[0]);
  return flux.real().dot(normal);
}

// The components of E and H along the boundary.
Eigen::Vector4cd tangential(const Fields& wave, const Vec3& first, const Vec3& second) {
  const auto along = [](const ComplexVec3& field, const Vec3& tangent) {
    return field[0] * tangent[0] + field[1] * tangent[1] + field[2] * tangent[2];
  };
  return {along(wave.E, first), along(wave.E, second), along(wave.H, first), along(wave.H, second)};
}

bool is_evanescent(const OutgoingWave& wave) {
  return wave.k.imag().squaredNorm() > 0;
}

}  // namespace

CrystalRay ray_along(const Vec3& direction, const Vec3& axis, Polarisation polarisation,
                     const CrystalIndices& indices) {
  return {axis, wave_vector_of(direction, axis, polarisation, indices), direction, polarisation};
}

std::array<OutgoingWave, 4> outgoing_waves(const CrystalRay& incident, const Vec3& normal,
                                           const Vec3& axis_behind, const CrystalIndices& indices) {
  const Vec3 across = incident.k - incident.k.dot(normal) * normal;
  const Vec3 first = normal.unitOrthogonal(), second = normal.cross(first);
  std::array<OutgoingWave, 4> waves;
  std::array<Fields, 4> fields;
  Eigen::Matrix4cd sides;  // refracted waves minus reflected ones are the incident wave
  for (int i = 0; i < 4; ++i) {
    const bool reflected = i < 2;
    const Vec3& axis = reflected ? incident.axis : axis_behind;
    const auto polarisation = i % 2 == 0 ? Polarisation::ordinary : Polarisation::extraordinary;
    const Complex along = normal_component(across, normal, reflected ? -1 : 1, axis, polarisation, indices);
    const ComplexVec3 k = across.cast<Complex>() + along * normal.cast<Complex>();
    waves[i] = {reflected, polarisation, k, 0, 0};
    fields[i] = fields_of(k, axis, polarisation, indices);
    sides.col(i) = (reflected ? -1 : 1) * tangential(fields[i], first, second);
  }
  const Fields coming = fields_of(incident.k.cast<Complex>(), incident.axis, incident.polarisation, indices);
  const Eigen::Vector4cd amplitudes = sides.partialPivLu().solve(tangential(coming, first, second));
  for (int i = 0; i < 4; ++i) {
    waves[i].amplitude = amplitudes[i];
    if (!is_evanescent(waves[i]))
      waves[i].share =
          std::norm(amplitudes[i]) * std::abs(normal_flux(fields[i], normal)) / normal_flux(coming, normal);
  }
  return waves;
}

CrystalRay cross_boundary(const CrystalRay& incident, const Vec3& normal, const Vec3& axis_behind,
                          double uniform, const CrystalIndices& indices) {
  const std::array<OutgoingWave, 4> waves = outgoing_waves(incident, normal, axis_behind, indices);
  int chosen = 0;
  for (double left = uniform - waves[0].share; left >= 0 && chosen < 3; left -= waves[chosen].share) ++chosen;
  const OutgoingWave& wave = waves[chosen];
  const Vec3 axis = wave.reflected ? incident.axis : axis_behind, k = wave.k.real();
  return {axis, k, energy_direction(k, axis, wave.polarisation, indices), wave.polarisation};
}

}  // namespace floe
