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
#include "propagation/engine/photon_acceptance.h"
#include "propagation/engine/scattering.h"
#include "propagation/engine/walker.h"

namespace floe {

namespace {

struct Photon {
  std::uint64_t id;
  Vec3 position, direction;
  double time, wavelength;
  double absorption_depth;  // optical depth left until it is absorbed
};

// A straight piece of path: to the next scatter, or to absorption when that comes first.
struct Segment {
  double length = 0;
  bool absorbed = false;
  int layer = 0;                         // in which it ends
  double diffusion = 0, deflection = 0;  // birefringence strengths integrated along it [m]
};

class PlainWalker : public PhotonWalker {
 public:
  PlainWalker(const Model& model, double oversize)
      : model_(model),
        ice_(*model.ice),
        oversize_(oversize),
        finder_(make_embree_finder(*model.detector, oversize)),
        clearance_(*model.detector, oversize),
        acceptance_(*model.detector, model.acceptance),
        flow_(std::cos(ice_.flow_azimuth()), std::sin(ice_.flow_azimuth())) {}

  WalkerCounts walk(const Source& source, const PhotonBatch& batch,
                    std::vector<SimulatedHit>& hits) const override {
    WalkerCounts counts;
    for (std::uint64_t id = batch.first; id < batch.first + batch.count; ++id) {
      RandomStream random(batch.seed, batch.stream, id);
      const EmittedPhoton born = source.emit(random);
      if (random.uniform() >= acceptance_.walked_share(born.wavelength)) continue;
      ++counts.walked;
      walk_one(born, id, source.emitting_module(), random, hits, counts);
    }
    return counts;
  }

 private:
  void walk_one(const EmittedPhoton& born, std::uint64_t id, std::optional<std::size_t> emitter,
                RandomStream& random, std::vector<SimulatedHit>& hits, WalkerCounts& counts) const {
    Photon photon{id, born.position.cast<double>(), born.direction.cast<double>(), born.time, born.wavelength,
                  0};
    const double speed = speed_of_light / group_index(photon.wavelength);
    photon.absorption_depth = random.exponential();
    for (bool first = true;; first = false) {
      const double scattering_depth = random.exponential();
      const Segment segment = straight_segment(photon, scattering_depth);
      const bool stopped = meet_modules(photon, segment.length, speed, emitter, first, random, hits, counts);
      if (stopped || segment.absorbed) return;
      photon.position += segment.length * photon.direction;
      photon.time += segment.length / speed;
      birefringent_step(photon, segment, random);
      scatter(photon, segment.layer, random);
      ++counts.scatters;
    }
  }

  // Spends the optical depths layer by layer; the tilt's shift is taken at the segment's start.
  Segment straight_segment(Photon& photon, double scattering_depth) const {
    const double step = ice_.layer_step(), slope = photon.direction.z();
    const int last = static_cast<int>(ice_.layers().size()) - 1;
    double z = photon.position.z() - ice_.tilt().shift(static_cast<float>(photon.position.x()),
                                                       static_cast<float>(photon.position.y()),
                                                       static_cast<float>(photon.position.z()));
    int layer = ice_.layer_at(z);
    const double absorption_factor = anisotropic_absorption(photon.direction, layer);
    Segment segment;
    for (;;) {
      const IceLayer& ice = ice_.layers()[layer];
      const double scattering = ice_.geometric_scattering(layer, photon.wavelength);
      const double absorption = absorption_factor * ice_.absorption(layer, photon.wavelength);
      const double to_scatter = scattering_depth / scattering;
      const double to_absorb = photon.absorption_depth / absorption;
      const int next = layer + (slope > 0 ? 1 : -1);
      const double boundary = ice_.z_bottom() + step * (slope > 0 ? layer + 1 : layer);
      const double to_boundary = slope == 0 || next < 0 || next > last
                                     ? std::numeric_limits<double>::infinity()
                                     : std::max(0.0, (boundary - z) / slope);
      const double length = std::min({to_scatter, to_absorb, to_boundary});
      segment.length += length;
      segment.diffusion += length * ice.diffusion_strength;
      segment.deflection += length * ice.deflection_strength;
      photon.absorption_depth -= length * absorption;
      if (length < to_boundary) {
        segment.absorbed = to_absorb <= to_scatter;
        segment.layer = layer;
        return segment;
      }
      scattering_depth -= length * scattering;
      z = boundary;
      layer = next;
    }
  }

  double anisotropic_absorption(const Vec3& direction, int layer) const {
    const auto [n1, n2, n3] = flow_components(direction);
    const auto& K = ice_.absorption_anisotropy();
    double factor = absorption_anisotropy_factor(K[0], K[1], K[2], n1, n2, n3);
    if (const double f = ice_.old_absorption_scaling(); f != 0)
      factor *= old_absorption_factor(ice_.layers()[layer].k1, ice_.layers()[layer].k2, f, n1, n2, n3);
    return factor;
  }

  // True when the photon ends here: on a module of nominal size, or back on the module that emitted it.
  bool meet_modules(const Photon& photon, double length, double speed, std::optional<std::size_t> emitter,
                    bool first_segment, RandomStream& random, std::vector<SimulatedHit>& hits,
                    WalkerCounts& counts) const {
    const Vec3f origin = photon.position.cast<float>(), direction = photon.direction.cast<float>();
    if (length < clearance_(origin)) return false;
    ++counts.queries;
    std::vector<ModuleCrossing> crossings;
    finder_->find(origin, direction, static_cast<float>(length), crossings);
    for (ModuleCrossing crossing : crossings) {
      if (emitter == crossing.module) {
        const Vec3f centre = model_.detector->modules()[crossing.module].position.cast<float>();
        if (!first_segment &&
            cross_module(centre, 1, origin, direction, static_cast<float>(length), crossing))
          return true;
        continue;
      }
      const auto wavelength = static_cast<float>(photon.wavelength);
      if (acceptance_.accepts(crossing, direction, wavelength, random)) {
        const auto time = static_cast<float>(photon.time + crossing.distance / speed);
        hits.push_back({crossing.module, time, wavelength, direction, crossing.inward, photon.id});
      }
      if (oversize_ == 1) return true;
    }
    return false;
  }

  void birefringent_step(Photon& photon, const Segment& segment, RandomStream& random) const {
    if (!ice_.birefringence()) return;
    const BirefringenceNumbers& numbers = *ice_.birefringence();
    const auto [g1, g2] = gaussian_pair(random);
    const auto [g3, g4] = gaussian_pair(random);
    Vec3 &n = photon.direction, &r = photon.position;
    const auto frame = flow_frame(flow_.x(), flow_.y(), n.x(), n.y(), n.z());
    const DiffusionStep one_metre = diffusion_step(numbers, std::min(frame.cosine, 1.0));
    const double width = numbers.diffusion ? std::sqrt(segment.diffusion) : 0.0;
    const double drift = numbers.deflection ? segment.deflection : 0.0;
    birefringent_deflection(
        frame, width * one_metre.sigma_x, width * one_metre.sigma_y, drift * one_metre.mean_x, g1, g2, g3, g4,
        numbers.displacement ? segment.length : 0.0, n.x(), n.y(), n.z(), r.x(), r.y(), r.z());
  }

  void scatter(Photon& photon, int layer, RandomStream& random) const {
    const ScatteringFunction<double> function{ice_.simplified_liu_fraction(), ice_.mean_cosine()};
    const double one_minus_cos = function.one_minus_cos(random.uniform());
    const double turn = random.uniform();
    const IceLayer& ice = ice_.layers()[layer];
    if (ice.k1 == 0 && ice.k2 == 0) {
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

  static std::array<double, 2> gaussian_pair(RandomStream& random) {
    const double radius = std::sqrt(2 * random.exponential()), angle = 2 * pi * random.uniform();
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }

  const Model model_;
  const IceModel& ice_;
  double oversize_;
  std::unique_ptr<ModuleFinder> finder_;
  ClearanceMap clearance_;
  PhotonAcceptance acceptance_;
  Eigen::Vector2d flow_;
};

}  // namespace

std::unique_ptr<PhotonWalker> make_plain_walker(const Model& model, double oversize) {
  return std::make_unique<PlainWalker>(model, oversize);
}

}  // namespace floe
