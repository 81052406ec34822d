// Many photons side by side: structure of arrays, one lane a photon.
#pragma once

#include <cstdint>

#include "propagation/engine/newborns.h"

namespace floe {

struct alignas(64) Lanes {
  // A multiple of every vector width; small enough that all of it stays in the first-level cache.
  static constexpr int count = RandomStreams::count;
  template <typename T>
  using Array = T[count];

  // The photon: place [m], time [ns], direction; inverse speed [ns/m]; optical depth left to absorption, and
  // what it was at birth.
  Array<float> x, y, z, time, nx, ny, nz, slowness, absorption_depth, absorption_budget;
  // Its wavelength [nm] and the wavelength's factors in the layers' coefficients (IceLayer).
  Array<float> wavelength, scattering_power, absorption_dust, absorption_thermal;
  // Its random stream.
  RandomStreams random;

  // The segment under way: optical depth to its scatter, height above the lowest layer's floor at its
  // start [layers], length [m], birefringence strengths along it [m], last layer; the depths before it.
  Array<float> scattering_depth, height, length, diffusion, deflection;
  Array<float> scattering_depth_before, absorption_depth_before;
  Array<std::int32_t> layer;
  Array<std::int32_t> absorbed;

  // Whether the segment may meet a module outside the column of the nearest one.
  Array<std::int32_t> may_meet_others;
  Array<std::uint32_t> nearest_module;

  // Which photon of the batch (no photon: number < 0); how often it has scattered.
  Array<std::int64_t> number;
  Array<std::int32_t> scatters;

  // Puts a newborn photon into a lane.
  void start(int lane, const Newborns& newborns, int which, std::int64_t photon_number) {
    const EmittedPhotons& born = newborns.photons;
    x[lane] = born.x[which];
    y[lane] = born.y[which];
    z[lane] = born.z[which];
    time[lane] = born.time[which];
    nx[lane] = born.nx[which];
    ny[lane] = born.ny[which];
    nz[lane] = born.nz[which];
    wavelength[lane] = born.wavelength[which];
    absorption_depth[lane] = newborns.absorption_depth[which];
    absorption_budget[lane] = newborns.absorption_depth[which];
    scattering_power[lane] = newborns.scattering_power[which];
    absorption_dust[lane] = newborns.absorption_dust[which];
    absorption_thermal[lane] = newborns.absorption_thermal[which];
    slowness[lane] = newborns.slowness[which];
    random.set(lane, newborns.streams[which]);
    number[lane] = photon_number;
    scatters[lane] = 0;
  }
  // Leaves a lane without a photon: numbers that can be computed with.
  void idle(int lane) {
    x[lane] = y[lane] = z[lane] = time[lane] = nx[lane] = ny[lane] = 0;
    nz[lane] = 1;
    absorption_depth[lane] = absorption_budget[lane] = 0;
    wavelength[lane] = 400;
    scattering_power[lane] = absorption_dust[lane] = absorption_thermal[lane] = slowness[lane] = 1;
    random.set(lane, RandomStream(0, 0, static_cast<std::uint64_t>(lane)));
    number[lane] = -1;
    scatters[lane] = 0;
  }
};

}  // namespace floe
