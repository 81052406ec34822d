// Many photons side by side: structure of arrays, one lane a photon.
#pragma once

#include <cstdint>

#include "propagation/engine/random.h"

namespace floe {

struct alignas(64) Lanes {
  // A multiple of every vector width; small enough that all of it stays in the first-level cache.
  static constexpr int count = 64;
  template <typename T>
  using Array = T[count];

  // The photon: place [m], time [ns], direction; inverse speed [ns/m]; optical depth left to absorption.
  Array<float> x, y, z, time, nx, ny, nz, slowness, absorption_depth;
  // Its wavelength [nm] and the wavelength's factors in the layers' coefficients (IceLayer).
  Array<float> wavelength, scattering_power, absorption_dust, absorption_thermal;
  // Its random stream.
  Array<std::uint32_t> random0, random1, random2, random3;

  // The segment under way: optical depth to its scatter, height above the lowest layer's floor at its
  // start [layers], length [m], birefringence strengths along it [m], last layer.
  Array<float> scattering_depth, height, length, diffusion, deflection;
  Array<std::int32_t> layer;
  Array<std::int32_t> absorbed;

  // Whether the segment may meet a module outside the column of the nearest one.
  Array<std::int32_t> may_meet_others;
  Array<std::uint32_t> nearest_module;

  // Which photon of the batch; whether it left the emitting module yet; no photon: number < 0.
  Array<std::int64_t> number;
  Array<std::int32_t> scatters;

  void set_stream(int lane, const RandomStream& stream) {
    const auto& state = stream.state();
    random0[lane] = state[0];
    random1[lane] = state[1];
    random2[lane] = state[2];
    random3[lane] = state[3];
  }
  RandomStream stream(int lane) const {
    return RandomStream({random0[lane], random1[lane], random2[lane], random3[lane]});
  }
};

}  // namespace floe
