#include "propagation/engine/noise_hits.h"

#include <limits>
#include <random>

#include "data/base/constants.h"
#include "propagation/engine/random.h"

namespace floe {

std::vector<SimulatedHit> noise_hits(const Model& model, const NoiseWindow& window,
                                     std::optional<std::size_t> emitter, std::uint64_t seed,
                                     std::uint64_t stream) {
  std::vector<std::uint32_t> modules;
  for (std::size_t m = 0; m < model.detector->size(); ++m)
    if (model.detector->modules()[m].on && emitter != m) modules.push_back(static_cast<std::uint32_t>(m));
  const double expected = (model.noise_rate + window.known_rate) * seconds_per_nanosecond *
                          (window.to - window.from) * window.readouts * static_cast<double>(modules.size());
  std::vector<SimulatedHit> hits;
  if (!(expected > 0)) return hits;
  RandomStream random(seed, stream, first_noise_hit);
  const auto count = std::poisson_distribution<std::uint64_t>(expected)(random);
  constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
  const Vec3f nowhere = Vec3f::Constant(nothing);
  std::uniform_int_distribution<std::size_t> any(0, modules.size() - 1);
  std::uniform_real_distribution<double> when(window.from, window.to);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint32_t module = modules[any(random)];
    hits.push_back(
        {module, static_cast<float>(when(random)), nothing, nowhere, nowhere, first_noise_hit + i});
  }
  return hits;
}

}  // namespace floe
