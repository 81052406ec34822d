// One scattering off dust or air bubbles: the angle's distribution (arXiv:1301.5361 section 3).
#pragma once

#include <cmath>

namespace floe {

// With probability `liu_fraction` simplified Liu, cos = 2 u^((1-g)/(1+g)) - 1, otherwise
// Henyey-Greenstein; both have the mean cosine g. Branch-free, for scalars and for vector loops.
template <typename Scalar>
struct ScatteringFunction {
  Scalar liu_fraction, g;
  Scalar liu_exponent = (1 - g) / (1 + g);

  // 1 - cos(theta) in [0, 2] from one uniform number in (0, 1).
  Scalar one_minus_cos(Scalar u) const {
    const bool is_liu = u < liu_fraction;
    const Scalar v = is_liu ? u / liu_fraction : (u - liu_fraction) / (1 - liu_fraction);
    const Scalar liu = 2 - 2 * std::exp(liu_exponent * std::log(v));
    // Henyey-Greenstein, cos = (1 + g^2 - ((1 - g^2)/p)^2)/(2g) with p = 1 - g + 2 g v, rearranged so that
    // small angles and g = 0 lose no digits.
    const Scalar p = 1 - g + 2 * g * v;
    const Scalar henyey_greenstein = 2 * (1 - v) * (1 - g) * (1 - g) * (1 + g * v) / (p * p);
    const Scalar x = is_liu ? liu : henyey_greenstein;
    return x < 0 ? Scalar(0) : x > 2 ? Scalar(2) : x;
  }
};

}  // namespace floe
