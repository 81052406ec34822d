// A walker follows photons from birth to absorption. Two of them exist: the plain one, to be read, and
// the vector engine, to be used; the same photon draws the same random numbers in both.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "propagation/engine/simulator.h"

namespace floe {

// Photons number first .. first + count - 1 of a source.
struct PhotonBatch {
  std::uint64_t seed, stream, first;
  std::uint32_t count;
  double absorption_stretch = 1;  // k, see SimulationOptions
};

struct WalkerCounts {
  std::uint64_t walked = 0, scatters = 0, queries = 0;
};

class PhotonWalker {
 public:
  virtual ~PhotonWalker() = default;
  // Appends the hits of a batch to `hits`, in the order of the photons and along each path. Safe to
  // call from many threads.
  virtual WalkerCounts walk(const Source& source, const PhotonBatch& batch,
                            std::vector<SimulatedHit>& hits) const = 0;
};

// The order in which every walker draws a photon's numbers:
//   birth: those of Source::emit(), one for being walked at all, one for the absorption length;
//   each segment, from birth or a scatter to the next scatter: one for its length;
//   each piece of a segment, which the surfaces of hole-ice columns cut (without columns a segment is one
//   piece): one for each module met; four for the birefringent step (where the ice has it, for pieces
//   outside columns, and not after the photon's last piece);
//   each scatter: two for the angle.
std::unique_ptr<PhotonWalker> make_plain_walker(const Model& model, double oversize);
std::unique_ptr<PhotonWalker> make_vector_walker(const Model& model, double oversize);

}  // namespace floe
