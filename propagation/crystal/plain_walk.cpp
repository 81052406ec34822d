#include "propagation/crystal/boundary.h"
#include "propagation/crystal/walk.h"
#include "propagation/crystal/walk_frame.h"

namespace floe {

namespace {

Vec3 draw_normal(const GrainShape& grains, const Vec3& ray, RandomStream& stream) {
  const double square = fine_uniform(stream);
  const auto turn = turn_functions(fine_uniform(stream));
  Vec3 normal;
  boundary_normal(grains.axes, ray.x(), ray.y(), ray.z(), square, turn, normal.x(), normal.y(), normal.z());
  return normal;
}

}  // namespace

WalkedPhoton walk_plainly(const Polycrystal& crystal, const CrystalWalk& walk, const PhotonStream& photon) {
  RandomStream stream(photon.seed, photon.pattern, photon.photon);
  const Vec3 first = first_direction(walk.angle, stream);
  CrystalRay ray = first_ray(crystal, first, stream);
  Vec3 position = Vec3::Zero();
  for (int crossing = 0; crossing < walk.crossings; ++crossing) {
    position += walk.step * ray.direction;
    const Vec3 normal = draw_normal(crystal.grains, ray.direction, stream);
    const Vec3 axis_behind = crystal.fabric.draw(stream);
    ray = cross_boundary(ray, normal, axis_behind, fine_uniform(stream), crystal.indices);
  }
  return end_of(first, ray.direction, position);
}

}  // namespace floe
