#include "propagation/engine/simulator.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "propagation/engine/in_order.h"
#include "propagation/engine/photon_acceptance.h"
#include "propagation/engine/threads.h"
#include "propagation/engine/walker.h"

namespace floe {

namespace {

// The photon id from which the number of photons is drawn: no photon of any source gets that far.
constexpr std::uint64_t id_of_count_draw = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint32_t batch_size = 1u << 15;

std::uint64_t number_to_draw(double expected, const SimulationOptions& options) {
  if (!(expected >= 0 && expected < 1e18))
    throw UsageError(fmt::format("cannot propagate {} photons; at most 1e18 at a time", expected));
  if (options.fixed_number) return static_cast<std::uint64_t>(std::llround(expected));
  RandomStream random(options.seed, options.stream, id_of_count_draw);
  return std::poisson_distribution<std::uint64_t>(expected)(random);
}

void check_stretch(double stretch) {
  if (!(stretch >= 1 && stretch <= 100))
    throw UsageError(
        fmt::format("the stretch of absorption must be at least 1 and at most 100, found {}", stretch));
}

// Weights as small as 1e-38 add nothing to any sum, and lose their digits as floats.
void drop_weightless(std::vector<SimulatedHit>& hits) {
  std::erase_if(hits, [](const SimulatedHit& hit) { return hit.weight < std::numeric_limits<float>::min(); });
}

void count_hits(const std::vector<SimulatedHit>& hits, SimulationSummary& summary) {
  summary.hits += hits.size();
  for (const SimulatedHit& hit : hits) summary.weights.add(hit.weight);
}

struct BatchResult {
  WalkerCounts counts;
  std::vector<SimulatedHit> hits;
};

// The batches of a shard: the parts follow each other, so that their hits do, too.
struct BatchRange {
  std::int64_t first, end;
};
BatchRange batches_of(std::uint64_t photons, const Shard& shard) {
  if (!(shard.index >= 1 && shard.index <= shard.count && shard.count <= 1000000))
    throw UsageError(fmt::format("a shard is k of K with 1 <= k <= K <= 1000000, found {} of {}", shard.index,
                                 shard.count));
  const std::uint64_t batches = (photons + batch_size - 1) / batch_size;
  const std::uint64_t each = batches / shard.count, left = batches % shard.count;
  const auto start = [&](std::uint64_t parts) { return parts * each + std::min(parts, left); };
  return {static_cast<std::int64_t>(start(shard.index - 1)), static_cast<std::int64_t>(start(shard.index))};
}

}  // namespace

Hit to_hit(const SimulatedHit& hit, const Detector& detector) {
  Hit result;
  result.module = detector.modules()[hit.module].id;
  result.time = hit.time;
  result.charge = hit.weight;
  result.wavelength = hit.wavelength;
  result.direction = hit.direction;
  result.inward = hit.inward;
  return result;
}

struct Simulator::Engine {
  std::unique_ptr<PhotonWalker> walker;
  PhotonAcceptance acceptance;
};

Simulator::Simulator(const Model& model, double oversize, EngineKind kind)
    : model_(model), oversize_(oversize) {
  if (!(oversize >= 1 && oversize <= 100))
    throw UsageError(fmt::format("the oversize factor must be between 1 and 100, found {}", oversize));
  auto walker =
      kind == EngineKind::plain ? make_plain_walker(model, oversize) : make_vector_walker(model, oversize);
  engine_.reset(new Engine{std::move(walker), PhotonAcceptance(*model.detector, model.acceptance)});
}

Simulator::~Simulator() = default;

double Simulator::photons_to_propagate(const Source& source) const {
  return source.photons() * engine_->acceptance.largest_share() / (oversize_ * oversize_);
}

SimulationSummary Simulator::run(const Source& source, const SimulationOptions& options, const HitSink& sink,
                                 const Progress& progress) const {
  check_stretch(options.absorption_stretch);
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t photons = number_to_draw(options.scale * photons_to_propagate(source), options);
  const auto [first_batch, end_batch] = batches_of(photons, options.shard);
  const int threads = thread_count(options.threads);
  SimulationSummary summary;
  const auto take = [&, first_batch = first_batch, end_batch = end_batch](std::int64_t b,
                                                                          const BatchResult& result) {
    summary.propagated += result.counts.walked;
    summary.scatters += result.counts.scatters;
    summary.queries += result.counts.queries;
    count_hits(result.hits, summary);
    if (!result.hits.empty()) sink(result.hits);
    if (progress)
      progress(static_cast<double>(b + 1 - first_batch) / static_cast<double>(end_batch - first_batch),
               "propagating photons");
  };
  InOrder<BatchResult, decltype(take)> results(first_batch, 16 * threads, take);
#pragma omp parallel for schedule(monotonic : dynamic) num_threads(threads)
  for (std::int64_t b = first_batch; b < end_batch; ++b)
    results.bring(b, [&] {
      const std::uint64_t first = static_cast<std::uint64_t>(b) * batch_size;
      const auto count = static_cast<std::uint32_t>(std::min<std::uint64_t>(batch_size, photons - first));
      BatchResult result;
      result.counts = engine_->walker->walk(
          source, {options.seed, options.stream, first, count, options.absorption_stretch}, result.hits);
      drop_weightless(result.hits);
      return result;
    });
  results.rethrow();
  summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return summary;
}

std::vector<std::string> simulation_warnings(const Model& model, double oversize) {
  std::vector<std::string> warnings;
  const double column = model.ice->tables().configuration.hole_ice.radius * module_radius;
  if (oversize > 1 && column > 0)
    warnings.push_back(fmt::format(
        "modules widened {:g} times, to a radius of {:.2f} m, do not see what the hole-ice column, "
        "of a radius of {:.2f} m, does to the light that reaches a module; simulate hole ice with "
        "--oversize 1",
        oversize, oversize * module_radius, column));
  return warnings;
}

}  // namespace floe
