// Drawing a cascade's photons, many at a time: the loop becomes vector code.
#include "data/base/constants.h"
#include "propagation/sources/cascade.h"
#include "propagation/sources/cherenkov.h"

namespace floe {

void CascadeSource::emit(RandomStreams& random, EmittedPhotons& photons) const {
  const auto wavelengths = wavelengths_.view(), cherenkov_angles = cherenkov_angles_.view();
  const auto depths = depths_.view(), particle_angles = particle_angles_.view();
  const float vertex_x = vertex_.x(), vertex_y = vertex_.y(), vertex_z = vertex_.z();
  const float axis_x = axis_.x(), axis_y = axis_.y(), axis_z = axis_.z();
  const auto start = static_cast<float>(cascade_.time);
  constexpr auto slowness = static_cast<float>(1 / speed_of_light);
#pragma omp simd
  for (int i = 0; i < EmittedPhotons::count; ++i) {
    const float colour = random.uniform(i);
    photons.wavelength[i] = wavelengths(colour);
    const float depth = depths(random.uniform(i));
    photons.x[i] = vertex_x + depth * axis_x;
    photons.y[i] = vertex_y + depth * axis_y;
    photons.z[i] = vertex_z + depth * axis_z;
    photons.time[i] = start + depth * slowness;

    float nx = axis_x, ny = axis_y, nz = axis_z;
    const float particle_angle = particle_angles(random.uniform(i));
    turn_to_photon(random, i, particle_angle, cherenkov_angles(colour), nx, ny, nz);
    photons.nx[i] = nx;
    photons.ny[i] = ny;
    photons.nz[i] = nz;
  }
}

}  // namespace floe
