// One scattering off dust or air bubbles: the angle's distribution (arXiv:1301.5361 section 3).
#pragma once

#include <cmath>

#include "propagation/engine/vector_math.h"

namespace floe {

// With probability `liu_fraction` simplified Liu, cos = 2 u^((1-g)/(1+g)) - 1, otherwise
// Henyey-Greenstein; both have the mean cosine g. Branch-free, for scalars and for vector loops.
template <typename Scalar>
struct ScatteringFunction {
  Scalar liu_fraction, g;
  Scalar liu_exponent = (1 - g) / (1 + g);
  Scalar per_liu = liu_fraction > 0 ? 1 / liu_fraction : Scalar(1);
  Scalar per_rest = liu_fraction < 1 ? 1 / (1 - liu_fraction) : Scalar(1);

  // 1 - cos(theta) in [0, 2] from one uniform number in (0, 1).
  Scalar one_minus_cos(Scalar u) const {
    // Both are computed, from where u lies in either's share, and one is kept: by a factor, because
    // compilers make a branch of a choice between long expressions.
    const Scalar is_liu = u < liu_fraction ? Scalar(1) : Scalar(0);
    const Scalar liu = 2 - 2 * decay(liu_exponent * natural_log(u * per_liu));
    // Henyey-Greenstein, cos = (1 + g^2 - ((1 - g^2)/p)^2)/(2g) with p = 1 - g + 2 g v, rearranged so that
    // small angles and g = 0 lose no digits.
    const Scalar beyond = (u - liu_fraction) * per_rest, v = beyond < 0 ? Scalar(0) : beyond;
    const Scalar p = 1 - g + 2 * g * v;
    const Scalar henyey_greenstein = 2 * (1 - v) * (1 - g) * (1 - g) * (1 + g * v) / (p * p);
    const Scalar x = is_liu * liu + (1 - is_liu) * henyey_greenstein;
    return x < 0 ? Scalar(0) : x > 2 ? Scalar(2) : x;
  }

  // Probability density of cos(theta) at this 1 - cos(theta).
  Scalar density(Scalar one_minus_cos) const {
    const Scalar half = 1 - one_minus_cos / 2, least = Scalar(1e-30);
    const Scalar power = (1 / liu_exponent - 1) * natural_log(half > least ? half : least);
    const Scalar liu = decay(power > Scalar(-80) ? power : Scalar(-80)) / (2 * liu_exponent);
    const Scalar square = (1 - g) * (1 - g) + 2 * g * one_minus_cos;
    const Scalar henyey_greenstein = (1 - g * g) / (2 * square * std::sqrt(square));
    return liu_fraction * liu + (1 - liu_fraction) * henyey_greenstein;
  }
};

}  // namespace floe
