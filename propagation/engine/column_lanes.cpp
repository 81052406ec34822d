#include "propagation/engine/column_lanes.h"

#include <algorithm>

#include "propagation/engine/directions.h"

namespace floe {

namespace {

// What the common steps change of a lane although it should stay.
struct KeptLane {
  RandomStream stream;
  float nx, ny, nz, scattering_depth;
  std::int32_t scatters;

  static KeptLane of(const Lanes& lanes, int lane) {
    return {lanes.random[lane],           lanes.nx[lane],      lanes.ny[lane], lanes.nz[lane],
            lanes.scattering_depth[lane], lanes.scatters[lane]};
  }
  void put_back(Lanes& lanes, int lane) const {
    lanes.random.set(lane, stream);
    lanes.nx[lane] = nx;
    lanes.ny[lane] = ny;
    lanes.nz[lane] = nz;
    lanes.scattering_depth[lane] = scattering_depth;
    lanes.scatters[lane] = scatters;
  }
};

}  // namespace

ColumnLanes::ColumnLanes(const HoleIceColumns& columns, const IceView& ice)
    : columns_(columns),
      ice_(ice),
      scattering_{static_cast<float>(columns.simplified_liu_fraction()),
                  static_cast<float>(columns.mean_cosine())} {}

void ColumnLanes::draw_depths(Lanes& lanes) {
  std::vector<KeptLane> kept;
  for (const int lane : going_on_) kept.push_back(KeptLane::of(lanes, lane));
  draw_scattering_depths(lanes);
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i].put_back(lanes, going_on_[i]);
  going_on_.clear();
}

void ColumnLanes::cut(Lanes& lanes) {
  cuts_.clear();
  for (int lane = 0; lane < Lanes::count; ++lane)
    if (lanes.number[lane] >= 0 && lanes.length[lane] >= columns_.free(lanes.x[lane], lanes.y[lane]))
      cut_lane(lanes, lane);
}

void ColumnLanes::cut_lane(Lanes& lanes, int lane) {
  const Vec3 origin(lanes.x[lane], lanes.y[lane], lanes.z[lane]);
  const Vec3 direction = Vec3(lanes.nx[lane], lanes.ny[lane], lanes.nz[lane]).normalized();
  const auto column = columns_.first(origin, direction, lanes.length[lane]);
  if (!column) return;
  if (column->entry > 0) {
    const LanePiece piece = piece_of_segment(ice_, lanes, lane, static_cast<float>(column->entry));
    lanes.length[lane] = piece.length;
    lanes.scattering_depth[lane] = piece.scattering_depth;
    lanes.absorption_depth[lane] = piece.absorption_depth;
    lanes.diffusion[lane] = piece.diffusion;
    lanes.deflection[lane] = piece.deflection;
    lanes.layer[lane] = piece.layer;
    lanes.absorbed[lane] = 0;
    cuts_.push_back({lane, false, true});
    return;
  }
  const double to_scatter = lanes.scattering_depth_before[lane] / columns_.geometric_scattering();
  const double to_absorb = lanes.absorption_depth_before[lane] / columns_.absorption();
  const auto length = static_cast<float>(std::min({to_scatter, to_absorb, column->exit}));
  const bool at_limit = column->exit < std::min(to_scatter, to_absorb);
  lanes.length[lane] = length;
  lanes.scattering_depth[lane] =
      lanes.scattering_depth_before[lane] - length * static_cast<float>(columns_.geometric_scattering());
  lanes.absorption_depth[lane] =
      lanes.absorption_depth_before[lane] - length * static_cast<float>(columns_.absorption());
  lanes.diffusion[lane] = lanes.deflection[lane] = 0;
  lanes.absorbed[lane] = !at_limit && to_absorb <= to_scatter ? 1 : 0;
  cuts_.push_back({lane, true, at_limit});
}

float ColumnLanes::absorption_depth_at(const Lanes& lanes, int lane, float distance) const {
  const bool in_column = std::any_of(
      cuts_.begin(), cuts_.end(), [lane](const CutLane& cut) { return cut.lane == lane && cut.in_column; });
  if (in_column)
    return lanes.absorption_depth_before[lane] - distance * static_cast<float>(columns_.absorption());
  return piece_of_segment(ice_, lanes, lane, distance).absorption_depth;
}

// Inside a column the crystals' strengths are 0, so that their step changes nothing; it draws no numbers.
void ColumnLanes::advance(Lanes& lanes) {
  std::vector<RandomStream> streams;
  for (const CutLane& cut : cuts_) streams.push_back(lanes.random[cut.lane]);
  floe::advance(ice_, lanes);
  for (std::size_t i = 0; i < cuts_.size(); ++i)
    if (cuts_[i].in_column) lanes.random.set(cuts_[i].lane, streams[i]);
}

void ColumnLanes::scatter(Lanes& lanes) {
  std::vector<KeptLane> kept;
  for (const CutLane& cut : cuts_) kept.push_back(KeptLane::of(lanes, cut.lane));
  floe::scatter(ice_, lanes);
  for (std::size_t i = 0; i < cuts_.size(); ++i) {
    const int lane = cuts_[i].lane;
    kept[i].put_back(lanes, lane);
    if (cuts_[i].at_limit) {
      going_on_.push_back(lane);
      continue;
    }
    RandomStream random = lanes.random[lane];
    const float loss = scattering_.one_minus_cos(random.uniform());
    const TurnFunctions<float> turn = turn_functions(random.uniform());
    deflect(loss, turn.cosine, turn.sine, lanes.nx[lane], lanes.ny[lane], lanes.nz[lane]);
    lanes.random.set(lane, random);
    ++lanes.scatters[lane];
  }
}

void ColumnLanes::ended(int lane) {
  std::erase(going_on_, lane);
}

}  // namespace floe
