// The walk of one photon in double precision, straight from the ice model: what the vector engine is
// tested against, and the place to read what floe simulates.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "data/base/constants.h"
#include "geometry/clearance_map.h"
#include "geometry/module_scene.h"
#include "propagation/engine/anisotropy.h"
#include "propagation/engine/birefringence.h"
#include "propagation/engine/directions.h"
#include "propagation/engine/hole_ice.h"
#include "propagation/engine/meeting_modules.h"
#include "propagation/engine/path_record.h"
#include "propagation/engine/photon_acceptance.h"
#include "propagation/engine/scattering.h"
#include "propagation/engine/turn_score.h"
#include "propagation/engine/walker.h"

namespace floe {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

struct Photon {
  std::uint64_t id;
  Vec3 position, direction;
  double time, wavelength;
  double absorption_budget;                               // optical depth that it may spend in all
  double absorption_depth, scattering_depth;              // left until it is absorbed, until it scatters
  double dust_factor, thermal_factor, scattering_factor;  // of its wavelength, see IceLayer
  bool scattered = false;
};

// A straight piece of path in one medium, the ice or a hole-ice column. It ends where an optical depth is
// spent or, earlier, at a limit: where it enters or leaves a column.
struct Piece {
  enum class End { scatter, absorption, limit };
  double length = 0;
  End end = End::limit;
  bool in_column = false;
  double absorption_depth, scattering_depth;  // what is left of them at the end
  int layer = 0;                              // in which it ends
  double diffusion = 0, deflection = 0;       // birefringence strengths integrated along it [m]
};

// A path as far as it has been walked, and where its hits go.
struct Trace {
  PathRecord record;
  const PathSink& sink;
};

// What one call of walk() or trace() is about.
struct Task {
  const PhotonBatch& batch;
  std::optional<std::size_t> emitter;
  std::vector<SimulatedHit>& hits;
  Trace* trace = nullptr;
  WalkerCounts counts = {};
};

class PlainWalker : public PhotonWalker, public PathTracer {
 public:
  PlainWalker(const Model& model, double oversize)
      : model_(model),
        ice_(*model.ice),
        oversize_(oversize),
        finder_(make_embree_finder(*model.detector, oversize)),
        clearance_(*model.detector, oversize),
        columns_(model),
        acceptance_(*model.detector, model.acceptance),
        old_scaling_(ice_.old_absorption_scaling()),
        ice_scattering_{ice_.simplified_liu_fraction(), ice_.mean_cosine()},
        column_scattering_{columns_.simplified_liu_fraction(), columns_.mean_cosine()},
        score_scattering_{static_cast<float>(ice_.simplified_liu_fraction()),
                          static_cast<float>(ice_.mean_cosine())},
        flow_(std::cos(ice_.flow_azimuth()), std::sin(ice_.flow_azimuth())) {}

  WalkerCounts walk(const Source& source, const PhotonBatch& batch,
                    std::vector<SimulatedHit>& hits) const override {
    Task task{batch, source.emitting_module(), hits};
    for (std::uint64_t id = batch.first; id < batch.first + batch.count; ++id) {
      RandomStream random(batch.seed, batch.stream, id);
      const EmittedPhoton born = source.emit(random);
      if (random.uniform() >= acceptance_.walked_share(born.wavelength)) continue;
      ++task.counts.walked;
      walk_one(born, id, random, task);
    }
    return task.counts;
  }

  void trace(const Source& source, std::uint64_t seed, std::uint64_t stream,
             std::span<const std::uint64_t> photons, const PathSink& sink) const override {
    const PhotonBatch batch{seed, stream, 0, 0};
    std::vector<SimulatedHit> hits;
    Trace trace{PathRecord(), sink};
    Task task{batch, source.emitting_module(), hits, &trace};
    for (const std::uint64_t id : photons) {
      RandomStream random(seed, stream, id);
      const EmittedPhoton born = source.emit(random);
      if (random.uniform() >= acceptance_.walked_share(born.wavelength)) continue;
      trace.record = PathRecord(ice_.layers().size());
      hits.clear();
      walk_one(born, id, random, task);
    }
  }

 private:
  void walk_one(const EmittedPhoton& born, std::uint64_t id, RandomStream& random, Task& task) const {
    Photon photon{};
    photon.id = id;
    photon.position = born.position.cast<double>();
    photon.direction = born.direction.cast<double>();
    photon.time = born.time;
    photon.wavelength = born.wavelength;
    photon.dust_factor = ice_.absorption_dust_factor(photon.wavelength);
    photon.thermal_factor = ice_.absorption_thermal_factor(photon.wavelength);
    photon.scattering_factor = ice_.scattering_power_factor(photon.wavelength);
    const double speed = speed_of_light / group_index(photon.wavelength);
    photon.absorption_budget = task.batch.absorption_stretch * random.exponential();
    photon.absorption_depth = photon.absorption_budget;
    photon.scattering_depth = random.exponential();
    for (;;) {
      const Piece piece = next_piece(photon);
      const bool stopped = meet_modules(photon, piece, speed, random, task);
      if (stopped || piece.end == Piece::End::absorption) return;
      if (task.trace) record_piece(photon, piece, task.trace->record);
      photon.position += piece.length * photon.direction;
      photon.time += piece.length / speed;
      photon.absorption_depth = piece.absorption_depth;
      photon.scattering_depth = piece.scattering_depth;
      std::optional<BirefringentTurn> turn;
      if (ice_.birefringence() && !piece.in_column) turn = birefringent_step(photon, piece, random);
      if (piece.end == Piece::End::scatter) scatter(photon, piece, random);
      if (task.trace && turn) record_turn(photon, piece, *turn, task.trace->record);
      if (piece.end == Piece::End::limit) continue;
      photon.scattering_depth = random.exponential();
      ++task.counts.scatters;
    }
  }

  // As far as the scatter, the absorption or the surface of a hole-ice column.
  Piece next_piece(const Photon& photon) const {
    const Piece whole = piece_in_ice(photon, unlimited);
    if (!columns_.exist()) return whole;
    const Vec3f at = photon.position.cast<float>();
    if (whole.length < columns_.free(at.x(), at.y())) return whole;
    const auto column = columns_.first(photon.position, photon.direction, whole.length);
    if (!column) return whole;
    return column->entry > 0 ? piece_in_ice(photon, column->entry) : piece_in_column(photon, column->exit);
  }

  Piece piece_in_column(const Photon& photon, double limit) const {
    Piece piece;
    piece.in_column = true;
    const double to_scatter = photon.scattering_depth / columns_.geometric_scattering();
    const double to_absorb = photon.absorption_depth / columns_.absorption();
    piece.length = std::min({to_scatter, to_absorb, limit});
    piece.absorption_depth = photon.absorption_depth - piece.length * columns_.absorption();
    piece.scattering_depth = photon.scattering_depth - piece.length * columns_.geometric_scattering();
    if (piece.length < limit)
      piece.end = to_absorb <= to_scatter ? Piece::End::absorption : Piece::End::scatter;
    return piece;
  }

  Piece piece_in_ice(const Photon& photon, double limit) const {
    return piece_in_ice(photon, limit, [](int, double, double, double) {});
  }

  // Spends the optical depths layer by layer; the tilt's shift is taken at the piece's start. Calls
  // visit(layer, length, isotropic absorption, absorption) for each layer's share.
  template <class Visit>
  Piece piece_in_ice(const Photon& photon, double limit, Visit&& visit) const {
    const double step = ice_.layer_step(), slope = photon.direction.z();
    const int last = static_cast<int>(ice_.layers().size()) - 1;
    double z = photon.position.z() - ice_.tilt().shift(static_cast<float>(photon.position.x()),
                                                       static_cast<float>(photon.position.y()),
                                                       static_cast<float>(photon.position.z()));
    Piece piece;
    piece.layer = ice_.layer_at(z);
    piece.absorption_depth = photon.absorption_depth;
    piece.scattering_depth = photon.scattering_depth;
    const double absorption_factor = anisotropic_absorption(photon.direction, piece.layer);
    for (;;) {
      const IceLayer& ice = ice_.layers()[piece.layer];
      const double scattering = scattering_of(photon, piece.layer);
      const double isotropic =
          ice.absorption_dust * photon.dust_factor + ice.absorption_thermal * photon.thermal_factor;
      const double absorption = absorption_factor * isotropic;
      const double to_scatter = piece.scattering_depth / scattering;
      const double to_absorb = piece.absorption_depth / absorption;
      const double to_limit = limit - piece.length;
      const int next = piece.layer + (slope > 0 ? 1 : -1);
      const double boundary = ice_.z_bottom() + step * (slope > 0 ? piece.layer + 1 : piece.layer);
      const double to_boundary =
          slope == 0 || next < 0 || next > last ? unlimited : std::max(0.0, (boundary - z) / slope);
      const double length = std::min({to_scatter, to_absorb, to_boundary, to_limit});
      visit(piece.layer, length, isotropic, absorption);
      piece.length += length;
      piece.diffusion += length * ice.diffusion_strength;
      piece.deflection += length * ice.deflection_strength;
      piece.absorption_depth -= length * absorption;
      piece.scattering_depth -= length * scattering;
      if (length < to_boundary || length == to_limit) {
        if (length < to_limit)
          piece.end = to_absorb <= to_scatter ? Piece::End::absorption : Piece::End::scatter;
        return piece;
      }
      z = boundary;
      piece.layer = next;
    }
  }

  double scattering_of(const Photon& photon, int layer) const {  // geometric
    const IceLayer& ice = ice_.layers()[static_cast<std::size_t>(layer)];
    return (ice.scattering_constant + ice.scattering_power * photon.scattering_factor) /
           (1 - ice_.mean_cosine());
  }

  double anisotropic_absorption(const Vec3& direction, int layer) const {
    const auto [n1, n2, n3] = flow_components(direction);
    const auto& K = ice_.absorption_anisotropy();
    return absorption_anisotropy_factor(K[0], K[1], K[2], n1, n2, n3) * old_absorption(n1, n2, n3, layer);
  }

  // Of the oldest models; 1 where there is none.
  double old_absorption(double n1, double n2, double n3, int layer) const {
    const double f = old_scaling_;
    const IceLayer& ice = ice_.layers()[static_cast<std::size_t>(layer)];
    return f == 0 ? 1 : old_absorption_factor(ice.k1, ice.k2, f, n1, n2, n3);
  }

  // True when the photon ends here: on a module of nominal size, or back on the module that emitted it.
  bool meet_modules(const Photon& photon, const Piece& piece, double speed, RandomStream& random,
                    Task& task) const {
    const Vec3f origin = photon.position.cast<float>(), direction = photon.direction.cast<float>();
    if (piece.length < clearance_(origin)) return false;
    ++task.counts.queries;
    const auto length = static_cast<float>(piece.length);
    std::vector<ModuleCrossing> crossings;
    finder_->find(origin, direction, length, crossings);
    const float back_home = distance_to_emitter(photon, origin, direction, length, task);
    for (const ModuleCrossing& crossing : crossings) {
      if (task.emitter == crossing.module) continue;
      if (crossing.distance > back_home) break;
      const auto wavelength = static_cast<float>(photon.wavelength);
      if (acceptance_.accepts(crossing, direction, wavelength, random)) {
        const auto time = static_cast<float>(photon.time + crossing.distance / speed) +
                          acceptance_.clock_offset(crossing.module);
        task.hits.push_back({crossing.module, time, wavelength, direction, crossing.inward, photon.id,
                             weight(photon, piece, crossing.distance, task.batch.absorption_stretch)});
        if (task.trace) tell_hit(photon, piece, crossing.distance, task.hits.back(), *task.trace);
      }
      if (oversize_ == 1) return true;
    }
    return back_home <= length;
  }

  // Infinite for a photon on its way out.
  float distance_to_emitter(const Photon& photon, const Vec3f& origin, const Vec3f& direction, float length,
                            const Task& task) const {
    if (!task.emitter || !photon.scattered) return std::numeric_limits<float>::infinity();
    return distance_home(model_.detector->modules()[*task.emitter].position.cast<float>(), origin, direction,
                         length);
  }

  float weight(const Photon& photon, const Piece& piece, double distance, double stretch) const {
    if (stretch == 1) return 1;
    const Piece flown = piece.in_column ? piece_in_column(photon, distance) : piece_in_ice(photon, distance);
    return weight_of_stretched(photon.absorption_budget - flown.absorption_depth, stretch);
  }

  void record_flight(const Photon& photon, const Piece& piece, double length, PathRecord& record) const {
    record.begin_piece(flow_components(photon.direction), ice_.absorption_anisotropy(),
                       distance_along_tilt(photon.position));
    if (piece.in_column) return;
    piece_in_ice(photon, length, [&](int layer, double flown, double isotropic, double absorption) {
      record.fly(layer, flown, isotropic, absorption);
    });
  }

  void record_piece(const Photon& photon, const Piece& piece, PathRecord& record) const {
    record_flight(photon, piece, piece.length, record);
    if (piece.end == Piece::End::scatter && !piece.in_column)
      record.scatter(piece.layer, scattering_of(photon, piece.layer));
  }

  void tell_hit(const Photon& photon, const Piece& piece, double distance, const SimulatedHit& hit,
                const Trace& trace) const {
    PathRecord record = trace.record;
    record_flight(photon, piece, distance, record);
    trace.sink(hit, record.scores());
  }

  BirefringentTurn birefringent_step(Photon& photon, const Piece& piece, RandomStream& random) const {
    const BirefringenceNumbers& numbers = *ice_.birefringence();
    const auto [g1, g2] = gaussian_pair(random);
    const auto [g3, g4] = gaussian_pair(random);
    Vec3 &n = photon.direction, &r = photon.position;
    const auto frame = flow_frame(flow_.x(), flow_.y(), n.x(), n.y(), n.z());
    const DiffusionStep one_metre = diffusion_step(numbers, std::min(frame.cosine, 1.0));
    const double width = numbers.diffusion ? std::sqrt(piece.diffusion) : 0.0;
    const double drift = numbers.deflection ? piece.deflection : 0.0;
    const BirefringentTurn turn{in_flow_frame(n),
                                in_flow_frame({frame.xx, frame.xy, frame.xz}),
                                in_flow_frame({frame.yx, frame.yy, frame.yz}),
                                width * one_metre.sigma_x,
                                width * one_metre.sigma_y,
                                drift * one_metre.mean_x,
                                g1,
                                g2};
    birefringent_deflection(frame, turn.width_x, turn.width_y, turn.mean_x, g1, g2, g3, g4,
                            numbers.displacement ? piece.length : 0.0, n.x(), n.y(), n.z(), r.x(), r.y(),
                            r.z());
    n.normalize();
    return turn;
  }

  // After the scatter, where there was one.
  void record_turn(const Photon& photon, const Piece& piece, const BirefringentTurn& turn,
                   PathRecord& record) const {
    const BirefringenceNumbers& numbers = *ice_.birefringence();
    if (!numbers.diffusion) return;  // without widths there is nothing to weight
    const IceLayer& ice = ice_.layers()[static_cast<std::size_t>(piece.layer)];
    const TurnMoments moments =
        piece.end == Piece::End::scatter
            ? moments_given_scatter(turn, in_flow_frame(photon.direction), score_scattering_,
                                    std::exp(ice.k1), std::exp(ice.k2))
            : moments_drawn(turn);
    const DiffusionStep one_metre = diffusion_step(numbers, std::min(std::abs(turn.before.x()), 1.0));
    record.turn(piece.diffusion, moments, numbers.deflection ? one_metre.mean_x / one_metre.sigma_x : 0);
  }

  void scatter(Photon& photon, const Piece& piece, RandomStream& random) const {
    const ScatteringFunction<double>& function = piece.in_column ? column_scattering_ : ice_scattering_;
    const double one_minus_cos = function.one_minus_cos(random.uniform());
    const double turn = random.uniform();
    const IceLayer& ice = ice_.layers()[piece.layer];
    photon.scattered = true;
    if (piece.in_column || (ice.k1 == 0 && ice.k2 == 0)) {
      photon.direction = deflect(photon.direction, one_minus_cos, turn);
      return;
    }
    photon.direction = stretched(photon.direction, std::exp(ice.k1), std::exp(ice.k2));
    photon.direction = deflect(photon.direction, one_minus_cos, turn);
    photon.direction = stretched(photon.direction, std::exp(-ice.k1), std::exp(-ice.k2));
  }

  Vec3 stretched(const Vec3& direction, double K1, double K2) const {
    auto [n1, n2, n3] = flow_components(direction);
    stretch_direction(K1, K2, n1, n2, n3);
    return {flow_.x() * n1 - flow_.y() * n2, flow_.y() * n1 + flow_.x() * n2, n3};
  }

  std::array<double, 3> flow_components(const Vec3& n) const {
    return {flow_.x() * n.x() + flow_.y() * n.y(), -flow_.y() * n.x() + flow_.x() * n.y(), n.z()};
  }

  Vec3 in_flow_frame(const Vec3& n) const {
    const auto [along, across, up] = flow_components(n);
    return {along, across, up};
  }

  static std::array<double, 2> gaussian_pair(RandomStream& random) {
    const double radius = std::sqrt(2 * random.exponential()), angle = 2 * pi * random.uniform();
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }

  const Model model_;
  const IceModel& ice_;
  double oversize_;
  std::unique_ptr<ModuleFinder> finder_;
  ClearanceMap clearance_;
  HoleIceColumns columns_;
  PhotonAcceptance acceptance_;
  double old_scaling_;
  ScatteringFunction<double> ice_scattering_, column_scattering_;
  ScatteringFunction<float> score_scattering_;
  Eigen::Vector2d flow_;
};

}  // namespace

std::unique_ptr<PhotonWalker> make_plain_walker(const Model& model, double oversize) {
  return std::make_unique<PlainWalker>(model, oversize);
}

std::unique_ptr<PathTracer> make_path_tracer(const Model& model, double oversize) {
  return std::make_unique<PlainWalker>(model, oversize);
}

}  // namespace floe
