#include <algorithm>

#include "propagation/crystal/boundary.h"
#include "propagation/crystal/lanes.h"
#include "propagation/crystal/walk.h"
#include "propagation/crystal/walk_frame.h"
#include "propagation/engine/threads.h"

namespace floe {

namespace {

using FirstDirections = std::array<Vec3, CrystalLanes::count>;

void set_ray(CrystalLanes& lanes, int i, const CrystalRay& ray) {
  lanes.kx[i] = ray.k.x(), lanes.ky[i] = ray.k.y(), lanes.kz[i] = ray.k.z();
  lanes.ax[i] = ray.axis.x(), lanes.ay[i] = ray.axis.y(), lanes.az[i] = ray.axis.z();
  lanes.dx[i] = ray.direction.x(), lanes.dy[i] = ray.direction.y(), lanes.dz[i] = ray.direction.z();
  lanes.ordinary[i] = ray.polarisation == Polarisation::ordinary ? 1 : 0;
}

CrystalRay ray_of(const CrystalLanes& lanes, int i) {
  return {{lanes.ax[i], lanes.ay[i], lanes.az[i]},
          {lanes.kx[i], lanes.ky[i], lanes.kz[i]},
          {lanes.dx[i], lanes.dy[i], lanes.dz[i]},
          lanes.ordinary[i] == 1 ? Polarisation::ordinary : Polarisation::extraordinary};
}

// Lanes beyond the last photon that is wanted walk, too; they belong to the photons that follow.
void start(CrystalLanes& lanes, FirstDirections& first, const Polycrystal& crystal, const CrystalWalk& walk,
           const PhotonStream& photon) {
  for (int i = 0; i < CrystalLanes::count; ++i) {
    RandomStream stream(photon.seed, photon.pattern, photon.photon + static_cast<std::uint64_t>(i));
    first[i] = first_direction(walk.angle, stream);
    set_ray(lanes, i, first_ray(crystal, first[i], stream));
    lanes.px[i] = lanes.py[i] = lanes.pz[i] = 0;
    lanes.streams.set(i, stream);
  }
}

void draw_remaining_axes(CrystalLanes& lanes, const Fabric& fabric) {
  for (int i = 0; i < CrystalLanes::count; ++i) {
    if (lanes.kept[i] == 1) continue;
    RandomStream stream = lanes.streams[i];
    const Vec3 axis = fabric.draw(stream);
    lanes.bx[i] = axis.x(), lanes.by[i] = axis.y(), lanes.bz[i] = axis.z();
    lanes.streams.set(i, stream);
  }
}

// Boundaries with evanescent waves, one in some hundred.
void cross_remaining(CrystalLanes& lanes, const CrystalIndices& indices) {
  for (int i = 0; i < CrystalLanes::count; ++i) {
    if (lanes.left_over[i] == 0) continue;
    set_ray(lanes, i,
            cross_boundary(ray_of(lanes, i), {lanes.nx[i], lanes.ny[i], lanes.nz[i]},
                           {lanes.bx[i], lanes.by[i], lanes.bz[i]}, lanes.choice[i], indices));
  }
}

void walk_lanes(CrystalLanes& lanes, const Polycrystal& crystal, const CrystalWalk& walk,
                const LaneConstants& constants) {
  for (int crossing = 0; crossing < walk.crossings; ++crossing) {
    draw_boundaries(lanes, walk.step, constants);
    if (!constants.keeps_all) draw_remaining_axes(lanes, crystal.fabric);
    cross_boundaries(lanes, constants);
    cross_remaining(lanes, crystal.indices);
  }
}

}  // namespace

std::vector<WalkedPhoton> walk_photons(const Polycrystal& crystal, const CrystalWalk& walk,
                                       const PhotonStream& first, std::size_t count, int threads,
                                       const Progress& progress) {
  constexpr std::size_t at_once = CrystalLanes::count;
  const LaneConstants constants = lane_constants(crystal);
  std::vector<WalkedPhoton> photons(count);
  const auto blocks = static_cast<std::int64_t>((count + at_once - 1) / at_once);
  std::int64_t done = 0;
#pragma omp parallel for schedule(dynamic) num_threads(thread_count(threads))
  for (std::int64_t block = 0; block < blocks; ++block) {
    CrystalLanes lanes;
    FirstDirections directions;
    const std::size_t offset = static_cast<std::size_t>(block) * at_once;
    start(lanes, directions, crystal, walk, {first.seed, first.pattern, first.photon + offset});
    walk_lanes(lanes, crystal, walk, constants);
    for (std::size_t i = 0; i < std::min(at_once, count - offset); ++i)
      photons[offset + i] = end_of(directions[i], {lanes.dx[i], lanes.dy[i], lanes.dz[i]},
                                   {lanes.px[i], lanes.py[i], lanes.pz[i]});
#pragma omp critical(floe_crystal_progress)
    if (++done, progress) progress(static_cast<double>(done) / static_cast<double>(blocks), "photons");
  }
  return photons;
}

}  // namespace floe
