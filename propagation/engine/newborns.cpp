// Compiled as the lanes' steps are: loops become vector code.
#include "propagation/engine/newborns.h"

#include <algorithm>

#include "propagation/engine/vector_math.h"

namespace floe {

namespace {

constexpr int N = Newborns::count;

// The streams of photons first .. first + N - 1; as RandomStream's constructor.
void start_streams(const PhotonBatch& batch, std::uint64_t first, RandomStreams& streams) {
  const std::uint64_t seed = batch.seed, stream = batch.stream;
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const PhiloxWords drawn = philox(seed, stream, first + static_cast<std::uint64_t>(i));
    streams.state0[i] = drawn.word0;
    streams.state1[i] = drawn.word1;
    streams.state2[i] = drawn.word2;
    streams.state3[i] = drawn.word3;
  }
}

// By each photon's wavelength: its factors, and its chance to be walked.
void look_up(const WavelengthTable& wavelengths, Newborns& newborns, float* chance) {
  constexpr auto shortest = static_cast<float>(WavelengthTable::shortest);
  constexpr auto range = static_cast<float>(WavelengthTable::longest) - shortest;
  alignas(64) std::int32_t index[N];
  alignas(64) float share[N], low[8][N], high[8][N];
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const float place = smaller(larger(newborns.photons.wavelength[i] - shortest, 0), range - 0.001f);
    index[i] = static_cast<std::int32_t>(place);
    share[i] = place - static_cast<float>(index[i]);
  }
  fetch_rows(wavelengths.rows.data(), index, low);
  fetch_rows(wavelengths.rows.data() + 1, index, high);
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    const auto between = [&](WavelengthTable::Column column) {
      return low[column][i] + share[i] * (high[column][i] - low[column][i]);
    };
    newborns.scattering_power[i] = between(WavelengthTable::scattering_power);
    newborns.absorption_dust[i] = between(WavelengthTable::absorption_dust);
    newborns.absorption_thermal[i] = between(WavelengthTable::absorption_thermal);
    newborns.slowness[i] = between(WavelengthTable::slowness);
    chance[i] = between(WavelengthTable::walked_share);
  }
}

}  // namespace

void bear_photons(const Source& source, const PhotonBatch& batch, const WavelengthTable& wavelengths,
                  std::uint64_t first, Newborns& newborns) {
  newborns.first = first;
  start_streams(batch, first, newborns.streams);
  source.emit(newborns.streams, newborns.photons);
  const auto stretch = static_cast<float>(batch.absorption_stretch);
  alignas(64) float chance[N], drawn[N];
  look_up(wavelengths, newborns, chance);
#pragma omp simd
  for (int i = 0; i < N; ++i) {
    drawn[i] = newborns.streams.uniform(i);
    newborns.absorption_depth[i] = -stretch * natural_log(newborns.streams.uniform(i));
  }
  const auto left = static_cast<int>(std::min<std::uint64_t>(N, batch.first + batch.count - first));
  newborns.walked = 0;
  for (int i = 0; i < left; ++i) newborns.walked |= std::uint64_t{drawn[i] < chance[i]} << i;
}

}  // namespace floe
