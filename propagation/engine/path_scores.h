// How the expected light depends on the ice, read off the paths of detected photons.
//
// A hit's probability density, as a function of the ice's numbers, is a product over its path: of
// exp(-a l) for absorption, b exp(-b l) for each flight that ends in a scatter, a Gaussian for each
// birefringent step. With s = d ln(density)/d p summed up to the hit, the derivative of any expected sum over
// hits is the sum with each hit weighted by s (the likelihood-ratio or score-function method, e.g. Glynn,
// Comm. ACM 33, 1990). Absorption has little variance, scattering has about one unit a scatter, birefringence
// a fifth of that: its steps are judged by what the scatter behind them leaves of them
// (propagation/engine/turn_score.h).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "propagation/engine/simulator.h"

namespace floe {

// What a photon met on its way to a hit. Hole-ice columns are not part of the layers.
struct PathScores {
  // One of each layer of IceModel::layers(). Derivatives of ln(density) with respect to the layer's
  //   isotropic absorption coefficient at the photon's wavelength [m]: minus the path, times its anisotropy,
  //   geometric scattering coefficient at the photon's wavelength [m]: scatters/b less the path,
  //   diffusion strength a and deflection strength a b (IceLayer). These two are 0 where the strength is 0:
  //   birefringence cannot be weighted in where there is none. A step's displacement is held as it is: what
  //   half a piece of path adds to a direction's change, which lasts for about 1/(1 - g) pieces.
  struct Layer {
    double absorption = 0, scattering = 0, diffusion = 0, deflection = 0;
    double length = 0;  // of the path in the layer [m]
    // Absorption and scattering again, each bit of path times its distance [m] from the frame's origin along
    // the direction of 1D tilt, as tilt's shift is taken: where the piece began.
    double tilted_absorption = 0, tilted_scattering = 0;
  };
  std::vector<Layer> layers;
  // With respect to the absorption anisotropy's normalised factors (K1, K2, Kz).
  std::array<double, 3> absorption_anisotropy{};
  int lowest = 0, highest = -1;  // the layers that the path touched; all others are 0
};

// Hits in the order along each path.
using PathSink = std::function<void(const SimulatedHit&, const PathScores&)>;

// Walks photons again, one by one and in double precision, and scores their paths. Photons belong to
// their numbers: a run's hits name those that are worth it (SimulatedHit::photon). Rounding makes the
// path of about one photon in some hundred another one than in the vector engine, equally likely. Immutable;
// trace() may be called from several threads.
class PathTracer {
 public:
  virtual ~PathTracer() = default;
  virtual void trace(const Source& source, std::uint64_t seed, std::uint64_t stream,
                     std::span<const std::uint64_t> photons, const PathSink& sink) const = 0;
};
std::unique_ptr<PathTracer> make_path_tracer(const Model& model, double oversize);

}  // namespace floe
