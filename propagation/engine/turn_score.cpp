#include "propagation/engine/turn_score.h"

#include <cmath>

#include "data/base/constants.h"
#include "propagation/engine/anisotropy.h"
#include "propagation/engine/birefringence.h"
#include "propagation/engine/vector_math.h"

namespace floe {

namespace {

constexpr int orbit = 32, stride = 13;  // a lattice that is even in both numbers

float fraction(float x) {
  return x - static_cast<float>(static_cast<int>(x));
}

}  // namespace

TurnMoments moments_given_scatter(const BirefringentTurn& turn, const Vec3& after,
                                  const ScatteringFunction<float>& dust, double K1, double K2) {
  const Vec3f n = turn.before.cast<float>(), x = turn.x.cast<float>(), y = turn.y.cast<float>();
  const float nx = n.x(), ny = n.y(), nz = n.z(), xx = x.x(), xy = x.y(), xz = x.z(), yx = y.x(), yy = y.y(),
              yz = y.z();
  const auto width_x = static_cast<float>(turn.width_x), width_y = static_cast<float>(turn.width_y),
             mean_x = static_cast<float>(turn.mean_x);
  const auto k1 = static_cast<float>(K1), k2 = static_cast<float>(K2);
  float ax = static_cast<float>(after.x()), ay = static_cast<float>(after.y()),
        az = static_cast<float>(after.z());
  stretch_direction(k1, k2, ax, ay, az);
  // The uniform numbers that the normals were made from.
  const auto [squares, pull] = moments_drawn(turn);
  const auto first = static_cast<float>(std::exp(-squares / 2));
  const auto second = static_cast<float>(std::atan2(turn.normal_y, turn.normal_x) / (2 * pi) + 1);

  float weights[orbit], square[orbit], normal_x[orbit];
#pragma omp simd
  for (int i = 0; i < orbit; ++i) {
    const float u = fraction(first + static_cast<float>(i) * (1.0f / orbit));
    const auto around = turn_functions(fraction(second + static_cast<float>(i * stride) * (1.0f / orbit)));
    square[i] = -2 * natural_log(larger(u, 1e-7f));
    const float radius = std::sqrt(square[i]);
    normal_x[i] = radius * around.cosine;
    const auto step = project_onto_sphere(width_x * normal_x[i] + mean_x, width_y * radius * around.sine);
    float px = nx + step.x * xx + step.y * yx - step.loss * nx;
    float py = ny + step.x * xy + step.y * yy - step.loss * ny;
    float pz = nz + step.x * xz + step.y * yz - step.loss * nz;
    stretch_direction(k1, k2, px, py, pz);
    const float dx = px - ax, dy = py - ay, dz = pz - az;
    weights[i] = dust.density((dx * dx + dy * dy + dz * dz) / 2);
  }
  float total = 0, sum_of_squares = 0, sum_of_pulls = 0;
  for (int i = 0; i < orbit; ++i) {
    total += weights[i];
    sum_of_squares += weights[i] * square[i];
    sum_of_pulls += weights[i] * normal_x[i];
  }
  if (!(total > 0)) return {squares, pull};
  return {sum_of_squares / total, sum_of_pulls / total};
}

}  // namespace floe
