// What birefringent polycrystalline ice does to a photon over a straight segment (arXiv:2107.08692,
// equations of its section on the diffusion patterns): it diffuses and drifts towards the flow.
#pragma once

#include <cmath>

namespace floe {

// Brings the plane's point (px, py) onto the sphere by the inverse stereographic projection with
// tan(theta/2) = p/2: returns the direction's components along x, y and its loss along n (1 - cos).
template <typename Scalar>
struct OnSphere {
  Scalar x, y, loss;
};
template <typename Scalar>
OnSphere<Scalar> project_onto_sphere(Scalar px, Scalar py) {
  const Scalar hx = px / 2, hy = py / 2;
  const Scalar q = hx * hx + hy * hy;
  const Scalar scale = 2 / (1 + q);
  return {scale * hx, scale * hy, scale * q};
}

// The axes of the plane across the direction n: x towards the nearer flow direction, y = n cross x. `cosine`
// and `sine` are those of the angle eta between n and the flow axis, folded to 0..90 deg.
template <typename Scalar>
struct FlowFrame {
  Scalar xx, xy, xz, yx, yy, yz, cosine, sine;
};
// (flow_x, flow_y) is the unit vector of the flow axis in the horizontal plane.
template <typename Scalar>
FlowFrame<Scalar> flow_frame(Scalar flow_x, Scalar flow_y, Scalar nx, Scalar ny, Scalar nz) {
  // The part of the nearer flow direction that is across n. Along the flow it has no direction, and the
  // photon's step none either but for its widths: any axis does.
  const Scalar along = flow_x * nx + flow_y * ny;
  const Scalar side = along < 0 ? Scalar(-1) : Scalar(1);
  Scalar xx = side * (flow_x - along * nx), xy = side * (flow_y - along * ny), xz = -side * along * nz;
  const Scalar square = xx * xx + xy * xy + xz * xz;
  const bool parallel = square < Scalar(1e-12);
  const Scalar sine = std::sqrt(square), norm = 1 / (parallel ? Scalar(1) : sine);
  xx = parallel ? Scalar(0) : xx * norm;
  xy = parallel ? Scalar(0) : xy * norm;
  xz = parallel ? Scalar(1) : xz * norm;
  return {xx, xy, xz, ny * xz - nz * xy, nz * xx - nx * xz, nx * xy - ny * xx, side * along, sine};
}

// Deflects the direction n and displaces the position r at the end of a segment of length L. The step in
// the plane across the photon has widths sigma_x, sigma_y and mean mean_x [rad] along the axes of `frame`.
//   direction: Gaussian (sigma_x, sigma_y) around (mean_x, 0), from the two standard normals g1, g2;
//   position:  mean delta_n L/2 with the direction's own change delta_n, and independently a variance
//              sigma^2 L^2/12 per axis, from g3, g4.
// n stays a unit vector but for rounding, which adds up: normalise it once a step.
template <typename Scalar>
void birefringent_deflection(const FlowFrame<Scalar>& frame, Scalar sigma_x, Scalar sigma_y, Scalar mean_x,
                             Scalar g1, Scalar g2, Scalar g3, Scalar g4, Scalar displacement_length,
                             Scalar& nx, Scalar& ny, Scalar& nz, Scalar& rx, Scalar& ry, Scalar& rz) {
  const auto [xx, xy, xz, yx, yy, yz, cosine, sine] = frame;
  const Scalar px = sigma_x * g1 + mean_x, py = sigma_y * g2;

  constexpr Scalar one_over_root_three = Scalar(0.57735026918962576);
  const OnSphere<Scalar> chord =
      project_onto_sphere(px + sigma_x * one_over_root_three * g3, py + sigma_y * one_over_root_three * g4);
  const Scalar half = displacement_length / 2;
  rx += half * (chord.x * xx + chord.y * yx - chord.loss * nx);
  ry += half * (chord.x * xy + chord.y * yy - chord.loss * ny);
  rz += half * (chord.x * xz + chord.y * yz - chord.loss * nz);

  const OnSphere<Scalar> turn = project_onto_sphere(px, py);
  nx += turn.x * xx + turn.y * yx - turn.loss * nx;
  ny += turn.x * xy + turn.y * yy - turn.loss * ny;
  nz += turn.x * xz + turn.y * yz - turn.loss * nz;
}

}  // namespace floe
