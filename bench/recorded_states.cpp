#include "bench/recorded_states.h"

#include <bit>

#include "propagation/engine/lane_steps.h"

namespace floe {

namespace {

constexpr int warm_up = 400;                 // steps, until young and old photons are mixed
constexpr std::size_t recorded_steps = 128;  // more lanes than a branch predictor remembers
constexpr int steps_between = 7;             // recorded ones
constexpr std::size_t most_segments = 4096;  // of each kind
constexpr int most_steps = 400000;           // in search of them

class LaneWalk {
 public:
  LaneWalk(const Model& model, const Source& source)
      : source_(source),
        tilt_(model.ice->tilt()),
        ice_(*model.ice),
        wavelengths_(*model.ice, PhotonAcceptance(*model.detector, model.acceptance)) {
    for (int lane = 0; lane < Lanes::count; ++lane) give_birth(lane);
  }

  const Lanes& lanes() const { return lanes_; }
  std::uint64_t may_meet() const { return may_meet_; }

  void draw() {
    draw_scattering_depths(lanes_);
    float shift[Lanes::count];
    tilt_.shifts(lanes_.x, lanes_.y, lanes_.z, shift, Lanes::count);
    for (int i = 0; i < Lanes::count; ++i)
      lanes_.height[i] = (lanes_.z[i] - shift[i] - ice_.z_bottom) * ice_.layers_per_metre;
  }
  void find(const ClearanceMap& clearance) {
    find_segments(ice_, lanes_);
    may_meet_ = find_reach(clearance.view(), lanes_).may_meet;
  }
  void go() {
    advance(ice_, lanes_);
    scatter(ice_, lanes_);
    for (int lane = 0; lane < Lanes::count; ++lane)
      if (lanes_.absorbed[lane]) give_birth(lane);
  }

 private:
  void give_birth(int lane) {
    if (newborns_.walked == 0) {
      bear_photons(source_, {1, 0, next_, Newborns::count}, wavelengths_, next_, newborns_);
      next_ += Newborns::count;
    }
    lanes_.start(lane, newborns_, std::countr_zero(newborns_.walked), 0);
    newborns_.walked &= newborns_.walked - 1;
  }

  const Source& source_;
  const LayerTilt& tilt_;
  IceView ice_;
  WavelengthTable wavelengths_;
  Newborns newborns_{};
  Lanes lanes_{};
  std::uint64_t may_meet_ = 0;
  std::uint64_t next_ = 0;
};

void note_segments(const Lanes& lanes, std::uint64_t may_meet, RecordedStates& states) {
  for (int i = 0; i < Lanes::count; ++i) {
    if ((may_meet >> i & 1) == 0) continue;
    auto& segments = lanes.may_meet_others[i] ? states.near_more : states.near_one;
    if (segments.size() == most_segments) continue;
    segments.push_back({{lanes.x[i], lanes.y[i], lanes.z[i]},
                        {lanes.nx[i], lanes.ny[i], lanes.nz[i]},
                        lanes.length[i],
                        lanes.nearest_module[i]});
  }
}

bool is_complete(const RecordedStates& states) {
  return states.begun.size() == recorded_steps && states.near_one.size() == most_segments &&
         states.near_more.size() == most_segments;
}

}  // namespace

RecordedStates record_states(const Model& model, const Source& source, const ClearanceMap& clearance) {
  LaneWalk walk(model, source);
  RecordedStates states;
  for (int step = 0; step < most_steps && !is_complete(states); ++step) {
    const bool keeps = step >= warm_up && step % steps_between == 0 && states.begun.size() < recorded_steps;
    if (keeps) states.begun.push_back(walk.lanes());
    walk.draw();
    if (keeps) states.drawn.push_back(walk.lanes());
    walk.find(clearance);
    if (keeps) states.found.push_back(walk.lanes());
    if (step >= warm_up) note_segments(walk.lanes(), walk.may_meet(), states);
    walk.go();
  }
  return states;
}

}  // namespace floe
