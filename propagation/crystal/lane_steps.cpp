// The loops over lanes. -fopt-info-vec-optimized must name each of them: docs/decisions/005.
#include "propagation/crystal/draws.h"
#include "propagation/crystal/lanes.h"

namespace floe {

namespace {

// sin(2 pi u) and cos(2 pi u) for u in [0, 1] to rounding, without calls. With a = u - 1/2 and b = |a| - 1/4
// both follow, as in vector_math.h, from x = 2 pi b, |x| <= pi/2, here by their Taylor series: the first
// terms left out are below 1e-16.
[[gnu::always_inline]] inline TurnFunctions<double> lane_turn(double u) {
  const double a = u - 0.5, x = 2 * pi * (std::fabs(a) - 0.25), q = -x * x;
  double sine = 1, cosine = 1;
#pragma GCC unroll 10
  for (int n = 10; n > 0; --n) {
    sine = 1 + q / ((2 * n) * (2 * n + 1.0)) * sine;
    cosine = 1 + q / ((2 * n) * (2 * n - 1.0)) * cosine;
  }
  return {-std::copysign(cosine, a), x * sine};
}

// The parts along the boundary of P = k x c and Q = k (k.c) - n_o^2 c. An ordinary wave has E = P, H = Q, an
// extraordinary one E = Q, H = -n_o^2 P.
struct Parts {
  double Px, Py, Qx, Qy;
};
[[gnu::always_inline]] inline Parts parts_of(double kx, double ky, double kz, double cx, double cy, double cz,
                                             double square) {
  const double along = kx * cx + ky * cy + kz * cz;
  return {ky * cz - kz * cy, kz * cx - kx * cz, kx * along - square * cx, ky * along - square * cy};
}

// The quadratic equation a z^2 + 2 b z + c = 0 for the extraordinary wave's normal component.
struct Quadratic {
  double a, b, discriminant;
};
[[gnu::always_inline]] inline Quadratic extraordinary(double kx, double ky, double cx, double cy, double cz,
                                                      double inverse, double difference) {
  const double along = kx * cx + ky * cy;
  const double a = inverse + difference * cz * cz, b = difference * along * cz;
  const double c = inverse * (kx * kx + ky * ky) + difference * along * along - 1;
  return {a, b, b * b - a * c};
}

[[gnu::always_inline]] inline double at_least(double value, double least) {
  return value < least ? least : value;
}

}  // namespace

LaneConstants lane_constants(const Polycrystal& crystal) {
  const double o = crystal.indices.ordinary, e = crystal.indices.extraordinary;
  const Fabric& fabric = crystal.fabric;
  return {o * o,          1 / (o * o),    1 / (e * e),   crystal.grains.axes,
          fabric.scale(), fabric.rates(), fabric.keep(), fabric.keeps_all()};
}

void draw_boundaries(CrystalLanes& l, double step, const LaneConstants& constants) {
  const LaneConstants m = constants;
  const bool thinned = !m.keeps_all;
#pragma omp simd
  for (int i = 0; i < CrystalLanes::count; ++i) {
    const double dx = l.dx[i], dy = l.dy[i], dz = l.dz[i];
    l.px[i] += step * dx;
    l.py[i] += step * dy;
    l.pz[i] += step * dz;
    const double square = fine_uniform(l.streams.bits(i)), turn = fine_uniform(l.streams.bits(i));
    double nx, ny, nz;
    boundary_normal(m.axes, dx, dy, dz, square, lane_turn(turn), nx, ny, nz);
    l.nx[i] = nx;
    l.ny[i] = ny;
    l.nz[i] = nz;
  }
#pragma omp simd
  for (int i = 0; i < CrystalLanes::count; ++i) {
    const double along = 2 * fine_uniform(l.streams.bits(i)) - 1, turn = fine_uniform(l.streams.bits(i));
    const Fabric::Trial found = Fabric::trial(m.scale, m.rates, m.keep, along, lane_turn(turn));
    l.bx[i] = found.x;
    l.by[i] = found.y;
    l.bz[i] = found.z;
    l.kept[i] = found.weight;
    l.choice[i] = found.exponent;
  }
  if (!thinned) return;
#pragma omp simd
  for (int i = 0; i < CrystalLanes::count; ++i) {
    const double chance = l.kept[i] * decay(-smaller(static_cast<float>(l.choice[i]), 80));
    l.kept[i] = fine_uniform(l.streams.bits(i)) < chance ? 1 : 0;
  }
}

// In the frame whose third axis is the boundary's normal. Of the tangential fields, as 2 x 2 matrices
// (columns: ordinary, extraordinary) E, H of the refracted waves and F, K of the reflected ones, and e, h of
// the incident wave, the conditions E t - F r = e, H t - K r = h give, with G = H E^-1,
//   (G F - K) r = h - G e,   t = E^-1 (e + F r).
// One long body: split into functions of small structs, g++ 12 leaves the loop scalar, five times slower.
void cross_boundaries(CrystalLanes& l, const LaneConstants& constants) {
  const double square = constants.square_ordinary, inverse = constants.inverse_extraordinary,
               inverse_o = constants.inverse_ordinary, difference = inverse_o - inverse;
  constexpr double least = 1e-12;  // below it, of the squares of normal components, waves count as evanescent
#pragma omp simd
  for (int i = 0; i < CrystalLanes::count; ++i) {
    // The frame: Duff et al., JCGT 6(1), 2017, as in deflect().
    const double nx = l.nx[i], ny = l.ny[i], nz = l.nz[i];
    const double sign = std::copysign(1.0, nz), f = -1 / (sign + nz), g = nx * ny * f;
    const double sx = 1 + sign * nx * nx * f, sy = sign * g, sz = -sign * nx;
    const double tx = g, ty = sign + ny * ny * f, tz = -ny;

    const double gkx = l.kx[i], gky = l.ky[i], gkz = l.kz[i];
    const double gax = l.ax[i], gay = l.ay[i], gaz = l.az[i];
    const double gbx = l.bx[i], gby = l.by[i], gbz = l.bz[i];
    const double kx = gkx * sx + gky * sy + gkz * sz, ky = gkx * tx + gky * ty + gkz * tz,
                 kz = gkx * nx + gky * ny + gkz * nz;
    const double ax = gax * sx + gay * sy + gaz * sz, ay = gax * tx + gay * ty + gaz * tz,
                 az = gax * nx + gay * ny + gaz * nz;
    const double bx = gbx * sx + gby * sy + gbz * sz, by = gbx * tx + gby * ty + gbz * tz,
                 bz = gbx * nx + gby * ny + gbz * nz;

    const double root_square = square - kx * kx - ky * ky;
    const Quadratic back = extraordinary(kx, ky, ax, ay, az, inverse, difference),
                    ahead = extraordinary(kx, ky, bx, by, bz, inverse, difference);
    const double z_o = std::sqrt(at_least(root_square, least)),
                 z_back = (-back.b - std::sqrt(at_least(back.discriminant, least))) / back.a,
                 z_ahead = (-ahead.b + std::sqrt(at_least(ahead.discriminant, least))) / ahead.a;

    const Parts in = parts_of(kx, ky, kz, ax, ay, az, square),
                r1 = parts_of(kx, ky, -z_o, ax, ay, az, square),
                r2 = parts_of(kx, ky, z_back, ax, ay, az, square),
                t1 = parts_of(kx, ky, z_o, bx, by, bz, square),
                t2 = parts_of(kx, ky, z_ahead, bx, by, bz, square);
    const double o = l.ordinary[i], x = 1 - o;
    const double ex = o * in.Px + x * in.Qx, ey = o * in.Py + x * in.Qy, hx = o * in.Qx - x * square * in.Px,
                 hy = o * in.Qy - x * square * in.Py;

    const double det = 1 / (t1.Px * t2.Qy - t2.Qx * t1.Py);
    const double gxx = (t1.Qx * t2.Qy + square * t2.Px * t1.Py) * det,
                 gxy = -(t1.Qx * t2.Qx + square * t2.Px * t1.Px) * det,
                 gyx = (t1.Qy * t2.Qy + square * t2.Py * t1.Py) * det,
                 gyy = -(t1.Qy * t2.Qx + square * t2.Py * t1.Px) * det;
    const double lxx = gxx * r1.Px + gxy * r1.Py - r1.Qx, lyx = gyx * r1.Px + gyy * r1.Py - r1.Qy,
                 lxy = gxx * r2.Qx + gxy * r2.Qy + square * r2.Px,
                 lyy = gyx * r2.Qx + gyy * r2.Qy + square * r2.Py;
    const double ux = hx - gxx * ex - gxy * ey, uy = hy - gyx * ex - gyy * ey;
    const double inverse_l = 1 / (lxx * lyy - lxy * lyx);
    const double ro = (ux * lyy - uy * lxy) * inverse_l, re = (uy * lxx - ux * lyx) * inverse_l;
    const double vx = ex + ro * r1.Px + re * r2.Qx, vy = ey + ro * r1.Py + re * r2.Qy;
    const double to = (vx * t2.Qy - vy * t2.Qx) * det, te = (vy * t1.Px - vx * t1.Py) * det;

    const double whole = 1 / (ex * hy - ey * hx);
    const double share_ro = -ro * ro * (r1.Px * r1.Qy - r1.Py * r1.Qx) * whole,
                 share_re = re * re * square * (r2.Qx * r2.Py - r2.Qy * r2.Px) * whole,
                 share_to = to * to * (t1.Px * t1.Qy - t1.Py * t1.Qx) * whole,
                 share_te = -te * te * square * (t2.Qx * t2.Py - t2.Qy * t2.Px) * whole;

    const double choice = fine_uniform(l.streams.bits(i));
    l.choice[i] = choice;
    const double step1 = choice - share_ro, step2 = step1 - share_re, step3 = step2 - share_to;
    const double is_re = (step1 >= 0) & (step2 < 0) ? 1.0 : 0.0,
                 is_to = (step2 >= 0) & (step3 < 0) ? 1.0 : 0.0, is_ro = step1 < 0 ? 1.0 : 0.0,
                 is_te = 1 - is_ro - is_re - is_to;
    const double reflected = is_ro + is_re, refracted = 1 - reflected, ordinary = is_ro + is_to;
    const double z = (is_to - is_ro) * z_o + is_re * z_back + is_te * z_ahead;

    const double cx = reflected * gax + refracted * gbx, cy = reflected * gay + refracted * gby,
                 cz = reflected * gaz + refracted * gbz;
    const double qx = kx * sx + ky * tx + z * nx, qy = kx * sy + ky * ty + z * ny,
                 qz = kx * sz + ky * tz + z * nz;
    const double bend = (1 - ordinary) * difference / inverse * (qx * cx + qy * cy + qz * cz);
    const double fx = qx + bend * cx, fy = qy + bend * cy, fz = qz + bend * cz;
    const double norm = 1 / std::sqrt(fx * fx + fy * fy + fz * fz);

    // Whatever is not a number leaves the lane to the plain version, too.
    const double sum = share_ro + share_re + share_to + share_te;
    const bool good = (root_square > least) & (back.discriminant > least) & (ahead.discriminant > least) &
                      (std::fabs(sum - 1) < 1e-9);
    l.left_over[i] = good ? 0.0 : 1.0;
    l.kx[i] = good ? qx : gkx;
    l.ky[i] = good ? qy : gky;
    l.kz[i] = good ? qz : gkz;
    l.ax[i] = good ? cx : gax;
    l.ay[i] = good ? cy : gay;
    l.az[i] = good ? cz : gaz;
    l.dx[i] = good ? fx * norm : l.dx[i];
    l.dy[i] = good ? fy * norm : l.dy[i];
    l.dz[i] = good ? fz * norm : l.dz[i];
    l.ordinary[i] = good ? ordinary : o;
  }
}

}  // namespace floe
