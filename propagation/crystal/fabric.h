// Fabric: how the c-axes of a polycrystal's grains are distributed.
#pragma once

#include <array>
#include <cmath>

#include "data/base/vec3.h"
#include "propagation/crystal/draws.h"
#include "propagation/engine/vector_math.h"

namespace floe {

// Eigenvalues of the fabric's orientation tensor <c c^T> (Woodcock, GSA Bulletin 88, 1231 (1977)):
// S1 >= S2 >= S3, sum 1.
struct FabricEigenvalues {
  double S1, S2, S3;
};
// From ln(S1/S2) and ln(S2/S3), each in [0, largest_log_ratio]. (0, 0): isotropic; (small, large): girdle;
// (large, small): single maximum. Throws UsageError outside the range.
inline constexpr double largest_log_ratio = 6;
FabricEigenvalues fabric_eigenvalues(double ln_S1_S2, double ln_S2_S3);

// Bingham's distribution of axes (Ann. Stat. 2, 1201 (1974)), diagonal in the crystal frame (grain_shape.h):
// density on the sphere ~ exp(-sum_i rate_i c_i^2), rates >= 0, the smallest 0.
struct BinghamRates {
  std::array<double, 3> rates{};
};
// The moments <c_i^2> of it, by quadrature; errors below 1e-6.
std::array<double, 3> second_moments(const BinghamRates& rates);

// A distribution of c-axes to draw from.
//
// The directions of a Bingham distribution are those of an angular central Gaussian, thinned (Kent, Ganeiban
// and Mardia, arXiv:1310.8110): a uniform direction z, stretched to y = scale z, gives c = y/|y|, which is
// kept with probability keep exp(-sum rate_i c_i^2)/|y|^3.
class Fabric {
 public:
  static Fabric isotropic();
  // Uniform in the plane perpendicular to the flow.
  static Fabric girdle();
  static Fabric bingham(const BinghamRates& rates);
  // The Bingham distribution with these eigenvalues: S1 along z, S2 along y, S3 along x, the flow. (Ice that
  // is drawn out sideways turns its c-axes away from the direction of extension.) Throws NoResult where the
  // fit does not converge.
  static Fabric from_eigenvalues(const FabricEigenvalues& eigenvalues);

  struct Trial {
    double x, y, z;           // unit vector
    double weight, exponent;  // its chance of being kept is weight exp(-exponent)
  };
  // z uniform on the sphere, from its component along the flow, in (-1, 1), and its turn.
  template <typename Turn>
  [[gnu::always_inline]] static inline Trial trial(std::array<double, 3> scale, std::array<double, 3> rate,
                                                   double keep, double along, Turn turn) {
    const double across = std::sqrt((1 - along) * (1 + along));
    const double x = scale[0] * along, y = scale[1] * across * turn.cosine, z = scale[2] * across * turn.sine;
    const double norm = 1 / std::sqrt(x * x + y * y + z * z);
    const double cx = x * norm, cy = y * norm, cz = z * norm;
    const double exponent = rate[0] * cx * cx + rate[1] * cy * cy + rate[2] * cz * cz;
    return {cx, cy, cz, keep * norm * norm * norm, exponent};
  }

  // Draws until one is kept.
  Vec3 draw(RandomStream& stream) const;

  const std::array<double, 3>& scale() const { return scale_; }
  const std::array<double, 3>& rates() const { return rates_; }
  double keep() const { return keep_; }
  bool keeps_all() const { return keeps_all_; }  // isotropic fabrics and girdles: chance is not looked at

 private:
  std::array<double, 3> scale_{1, 1, 1}, rates_{};
  double keep_ = 1;
  bool keeps_all_ = true;
};

}  // namespace floe
