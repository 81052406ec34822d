// Where a walk begins, and the axes its end is told along. Shared by the plain and the fast walk.
#pragma once

#include "propagation/crystal/boundary.h"
#include "propagation/crystal/walk.h"
#include "propagation/engine/birefringence.h"

namespace floe {

// At `angle` to the flow (x), turned around it by a uniform angle: fabrics and grains need not be symmetric
// around the flow.
inline Vec3 first_direction(double angle, RandomStream& stream) {
  const auto turn = turn_functions(fine_uniform(stream));
  return {std::cos(angle), std::sin(angle) * turn.cosine, std::sin(angle) * turn.sine};
}

// Unpolarised light in a grain of the fabric, its energy flowing along `direction`.
inline CrystalRay first_ray(const Polycrystal& crystal, const Vec3& direction, RandomStream& stream) {
  const Vec3 axis = crystal.fabric.draw(stream);
  const bool ordinary = fine_uniform(stream) < 0.5;
  return ray_along(direction, axis, ordinary ? Polarisation::ordinary : Polarisation::extraordinary,
                   crystal.indices);
}

inline WalkedPhoton end_of(const Vec3& first, const Vec3& direction, const Vec3& position) {
  const auto frame = flow_frame<double>(1, 0, first.x(), first.y(), first.z());
  const Vec3 x(frame.xx, frame.xy, frame.xz), y(frame.yx, frame.yy, frame.yz);
  const auto components = [&](const Vec3& v) { return Vec3(v.dot(x), v.dot(y), v.dot(first)); };
  return {components(direction), components(position)};
}

}  // namespace floe
