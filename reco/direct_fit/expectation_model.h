// Where fits get expected light from: an interface, so that the same fit runs over photon propagation
// and, in tests, over light in closed form.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "data/readout.h"
#include "propagation/engine/simulator.h"
#include "reco/direct_fit/cascade_parameters.h"

namespace floe {

struct LightRequest {
  CascadeParameters cascade;
  double photons = 0;        // to propagate: what it costs
  double oversize = 5;       // of the modules
  std::uint64_t stream = 0;  // requests with different streams are independent
};

// Detected photons of one simulated cascade, by module.
struct LightSample {
  CascadeParameters cascade;
  double repeats = 1;  // n_s: the light of so many cascades
  double oversize = 5;
  std::uint64_t propagated = 0;
  std::vector<std::uint32_t> first;  // hits of module m: times[first[m]] to times[first[m + 1] - 1]
  std::vector<float> times;          // rising within a module; after the vertex time [ns]

  std::size_t count(std::uint32_t module) const { return first[module + 1] - first[module]; }
  const float* begin(std::uint32_t module) const { return times.data() + first[module]; }
  const float* end(std::uint32_t module) const { return times.data() + first[module + 1]; }
};
// Sorts (module, time) pairs into a sample with `modules` modules.
void fill(LightSample& sample, std::size_t modules, std::vector<std::pair<std::uint32_t, float>>&& hits);

class ExpectationModel {
 public:
  virtual ~ExpectationModel() = default;
  virtual const Model& model() const = 0;
  // Expected number of photons to propagate for one such cascade.
  virtual double photons_per_cascade(const CascadeParameters& cascade, double oversize) = 0;
  // The same request gives the same sample. repeats = photons / photons_per_cascade.
  virtual LightSample sample(const LightRequest& request) = 0;
};

// Expected light by photon propagation; `delays`: of the tubes that saw it (Readout::delays).
class SimulatedLight : public ExpectationModel {
 public:
  SimulatedLight(Model model, CascadeKind kind, std::uint64_t seed, int threads,
                 std::vector<ExpectedDelay> delays = {});
  const Model& model() const override { return model_; }
  double photons_per_cascade(const CascadeParameters& cascade, double oversize) override;
  LightSample sample(const LightRequest& request) override;

 private:
  const Simulator& simulator(double oversize);

  Model model_;
  CascadeKind kind_;
  std::uint64_t seed_;
  int threads_;
  std::vector<ExpectedDelay> delays_;
  std::map<double, std::unique_ptr<Simulator>> simulators_;  // by oversize
};

}  // namespace floe
