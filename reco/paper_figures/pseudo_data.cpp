#include "reco/paper_figures/pseudo_data.h"

#include <vector>

namespace floe {

FlasherData pseudo_data(const Model& truth, std::span<const Emitter> emitters, double photons,
                        std::uint64_t seed, std::uint64_t first_stream, int threads) {
  std::vector<Event> events;
  FlasherRunNames names;
  for (const Emitter& emitter : emitters) {
    const RunRequest request = ring_flash(emitter, photons, seed, first_stream + events.size(), threads);
    Event event;
    event.id = names.next(emitter.module);
    event.flasher = request.run;
    event.flasher->oversize = request.oversize;
    for (const SimulatedHit& hit : simulate_run(truth, request).hits)
      event.hits.push_back(to_hit(hit, *truth.detector));
    events.push_back(std::move(event));
  }
  return flasher_data(*truth.detector, events);
}

}  // namespace floe
