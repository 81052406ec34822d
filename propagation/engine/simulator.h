// From a source's photons to detected photons: the one entry point of the propagation.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "data/base/progress.h"
#include "data/weights.h"
#include "propagation/model.h"
#include "propagation/sources/source.h"

namespace floe {

// One detected photon; `module` is an index into Detector::modules().
struct SimulatedHit {
  std::uint32_t module;
  float time;            // [ns]
  float wavelength;      // [nm]
  Vec3f direction;       // in which the photon travels
  Vec3f inward;          // from its landing point to the module's centre, nominal size
  std::uint64_t photon;  // its number in the run; one photon may be seen more than once
  float weight = 1;      // how many photons it stands for, in (0, 1]; 1 unless absorption is stretched
};
Hit to_hit(const SimulatedHit& hit, const Detector& detector);

// Receives hits in the order of the photons, in portions; called from one thread at a time.
using HitSink = std::function<void(std::span<const SimulatedHit>)>;

// Part k of K of a run: together the parts have exactly the photons, and hits, of the whole.
struct Shard {
  std::uint64_t index = 1, count = 1;  // 1 <= index <= count
};

struct SimulationOptions {
  std::uint64_t seed = 1;
  std::uint64_t stream = 0;   // sources with different streams are independent
  int threads = 0;            // 0: all cores
  double scale = 1;           // light of this many repetitions of the source
  bool fixed_number = false;  // propagate the expected number, rounded, instead of a Poisson draw
  Shard shard;
  // k: photons live k absorption lengths on average, and a hit after the optical depth d of absorption counts
  // exp(-d (1 - 1/k)), which keeps every expectation and lowers the variance far from the source
  // (docs/theory/propagation.md). 1 <= k <= 100; 1: every hit counts 1.
  double absorption_stretch = 1;
};

struct SimulationSummary {
  std::uint64_t propagated = 0;  // photons walked
  std::uint64_t hits = 0;
  WeightSums weights;          // over the hits
  std::uint64_t scatters = 0;  // on all paths together
  std::uint64_t queries = 0;   // questions put to the geometry
  double seconds = 0;
};

// The plain engine walks one photon at a time in double precision and is there to be read and to test
// against; the vector engine gives the same hits, many times faster.
enum class EngineKind { vector, plain };

// Propagates N x efficiency x max(as.dat) x (largest relative efficiency) / oversize^2 photons and
// accepts at the module with what is left (physics: arXiv:1309.7010). The same seed gives the same hits
// for any number of threads. Immutable; run() may be called from several threads.
class Simulator {
 public:
  // Throws UsageError unless 1 <= oversize <= 100.
  Simulator(const Model& model, double oversize, EngineKind kind = EngineKind::vector);
  ~Simulator();

  const Model& model() const { return model_; }
  double oversize() const { return oversize_; }
  // Expected number of photons to walk for one repetition of the source.
  double photons_to_propagate(const Source& source) const;

  SimulationSummary run(const Source& source, const SimulationOptions& options, const HitSink& sink,
                        const Progress& progress = {}) const;

 private:
  struct Engine;
  Model model_;
  double oversize_;
  std::unique_ptr<const Engine> engine_;
};

// What users should know of simulations of this model with modules so wide; a sentence each.
std::vector<std::string> simulation_warnings(const Model& model, double oversize);

}  // namespace floe
