// Walks many photons at once: the lanes step together (lane_steps.h), each lane asks for modules on its
// own and only when one can be in reach, and a lane whose photon has ended gets the next one.
#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/clearance_map.h"
#include "geometry/column_finder.h"
#include "geometry/module_scene.h"
#include "propagation/engine/column_lanes.h"
#include "propagation/engine/hole_ice.h"
#include "propagation/engine/lane_steps.h"
#include "propagation/engine/meeting_modules.h"
#include "propagation/engine/newborns.h"
#include "propagation/engine/photon_acceptance.h"
#include "propagation/engine/walker.h"

namespace floe {

namespace {

template <typename Action>
void for_each_lane(std::uint64_t set, Action action) {
  for (; set != 0; set &= set - 1) action(std::countr_zero(set));
}

class VectorWalker : public PhotonWalker {
 public:
  VectorWalker(const Model& model, double oversize)
      : model_(model),
        tilt_(model.ice->tilt()),
        ice_(*model.ice),
        oversize_(static_cast<float>(oversize)),
        finder_(make_embree_finder(*model.detector, oversize)),
        column_finder_(*model.detector, oversize),
        clearance_(*model.detector, oversize),
        columns_(model),
        acceptance_(*model.detector, model.acceptance),
        wavelengths_(*model.ice, acceptance_) {}

  WalkerCounts walk(const Source& source, const PhotonBatch& batch,
                    std::vector<SimulatedHit>& hits) const override {
    Batch work{source, batch, source.emitting_module(), batch.first, {}, ColumnLanes(columns_, ice_), {}, {},
               {},     {}};
    int alive = 0;
    for (int lane = 0; lane < Lanes::count; ++lane) alive += next_photon(work, lane);
    while (alive > 0) {
      const LaneSets sets = find_pieces(work);
      std::uint64_t ended = sets.absorbed;
      for_each_lane(sets.may_meet, [&](int lane) {
        if (work.lanes.number[lane] >= 0 && meet_modules(work, lane)) ended |= std::uint64_t{1} << lane;
      });
      go_on(work);
      work.counts.scatters += static_cast<std::uint64_t>(alive);
      for_each_lane(ended, [&](int lane) {
        if (work.lanes.number[lane] < 0) return;
        work.column_lanes.ended(lane);
        --work.counts.scatters;
        alive -= !next_photon(work, lane);
      });
      work.counts.scatters -= static_cast<std::uint64_t>(work.column_lanes.going_on());
    }
    hand_over(work, hits);
    return work.counts;
  }

 private:
  struct Batch {
    const Source& source;
    const PhotonBatch& batch;
    std::optional<std::size_t> emitter;  // the module whose own light this is
    std::uint64_t next;                  // photon to be born
    Newborns newborns;                   // of them, those still in newborns.walked wait for a lane
    ColumnLanes column_lanes;
    Lanes lanes;
    WalkerCounts counts;
    std::vector<SimulatedHit> hits;
    std::vector<ModuleCrossing> crossings;
  };

  // Gives the lane the batch's next photon; without one, a lane that steps along and is never looked at.
  bool next_photon(Batch& work, int lane) const {
    Newborns& newborns = work.newborns;
    while (newborns.walked == 0 && work.next < work.batch.first + work.batch.count) {
      bear_photons(work.source, work.batch, wavelengths_, work.next, newborns);
      work.next += Newborns::count;
    }
    if (newborns.walked == 0) {
      work.lanes.idle(lane);
      return false;
    }
    const int which = std::countr_zero(newborns.walked);
    newborns.walked &= newborns.walked - 1;
    work.lanes.start(lane, newborns, which,
                     static_cast<std::int64_t>(newborns.first - work.batch.first) + which);
    ++work.counts.walked;
    return true;
  }

  // The straight pieces of path ahead of all lanes.
  LaneSets find_pieces(Batch& work) const {
    if (columns_.exist())
      work.column_lanes.draw_depths(work.lanes);
    else
      draw_scattering_depths(work.lanes);
    find_heights(work.lanes);
    find_segments(ice_, work.lanes);
    if (columns_.exist()) work.column_lanes.cut(work.lanes);
    return find_reach(clearance_.view(), work.lanes);
  }

  // To their ends, and into new directions.
  void go_on(Batch& work) const {
    if (columns_.exist()) {
      work.column_lanes.advance(work.lanes);
      work.column_lanes.scatter(work.lanes);
    } else {
      advance(ice_, work.lanes);
      scatter(ice_, work.lanes);
    }
  }

  void find_heights(Lanes& lanes) const {
    alignas(64) float shift[Lanes::count];
    tilt_.shifts(lanes.x, lanes.y, lanes.z, shift, Lanes::count);
    for (int i = 0; i < Lanes::count; ++i)
      lanes.height[i] = (lanes.z[i] - shift[i] - ice_.z_bottom) * ice_.layers_per_metre;
  }

  // True when the photon ends here: on a module of nominal size, or back on the module that emitted it.
  bool meet_modules(Batch& work, int lane) const {
    Lanes& lanes = work.lanes;
    const float length = lanes.length[lane];
    const Vec3f origin{lanes.x[lane], lanes.y[lane], lanes.z[lane]};
    const Vec3f direction{lanes.nx[lane], lanes.ny[lane], lanes.nz[lane]};
    work.crossings.clear();
    if (lanes.may_meet_others[lane]) {
      ++work.counts.queries;
      finder_->find(origin, direction, length, work.crossings);
    } else {
      column_finder_.find(lanes.nearest_module[lane], origin, direction, length, work.crossings);
    }
    const float back_home = distance_to_emitter(work, lane, origin, direction);
    if (!work.crossings.empty()) {
      RandomStream random = lanes.random[lane];
      const bool stopped = land(work, lane, direction, back_home, random);
      lanes.random.set(lane, random);
      if (stopped) return true;
    }
    return back_home <= length;
  }

  // Infinite for a photon on its way out.
  float distance_to_emitter(const Batch& work, int lane, const Vec3f& origin, const Vec3f& direction) const {
    if (!work.emitter || work.lanes.scatters[lane] == 0) return std::numeric_limits<float>::infinity();
    return distance_home(model_.detector->modules()[*work.emitter].position.cast<float>(), origin, direction,
                         work.lanes.length[lane]);
  }

  // True when a module stops the photon.
  bool land(Batch& work, int lane, const Vec3f& direction, float back_home, RandomStream& random) const {
    const Lanes& lanes = work.lanes;
    for (const ModuleCrossing& crossing : work.crossings) {
      if (work.emitter == crossing.module) continue;
      if (crossing.distance > back_home) return false;
      if (acceptance_.accepts(crossing, direction, lanes.wavelength[lane], random)) {
        const float time = lanes.time[lane] + crossing.distance * lanes.slowness[lane] +
                           acceptance_.clock_offset(crossing.module);
        const std::uint64_t photon = work.batch.first + static_cast<std::uint64_t>(lanes.number[lane]);
        work.hits.push_back({crossing.module, time, lanes.wavelength[lane], direction, crossing.inward,
                             photon, weight(work, lane, crossing.distance)});
      }
      if (oversize_ == 1) return true;
    }
    return false;
  }

  float weight(const Batch& work, int lane, float distance) const {
    const double stretch = work.batch.absorption_stretch;
    if (stretch == 1) return 1;
    const float left = work.column_lanes.absorption_depth_at(work.lanes, lane, distance);
    return weight_of_stretched(work.lanes.absorption_budget[lane] - left, stretch);
  }

  // Photons end out of order; hits leave in the order of the photons.
  static void hand_over(Batch& work, std::vector<SimulatedHit>& hits) {
    std::stable_sort(work.hits.begin(), work.hits.end(),
                     [](const SimulatedHit& a, const SimulatedHit& b) { return a.photon < b.photon; });
    hits.insert(hits.end(), work.hits.begin(), work.hits.end());
  }

  const Model model_;
  const LayerTilt& tilt_;
  IceView ice_;
  float oversize_;
  std::unique_ptr<ModuleFinder> finder_;
  ColumnFinder column_finder_;
  ClearanceMap clearance_;
  HoleIceColumns columns_;
  PhotonAcceptance acceptance_;
  WavelengthTable wavelengths_;
};

}  // namespace

std::unique_ptr<PhotonWalker> make_vector_walker(const Model& model, double oversize) {
  return std::make_unique<VectorWalker>(model, oversize);
}

}  // namespace floe
