// The charge of a single photoelectron at the anode: arXiv:2002.00997, eq. 1.
#pragma once

#include "propagation/engine/random.h"

namespace floe {

struct PhotoelectronChargeSettings {
  double steep_share = 0, steep_width = 0.0343;                 // P_e1, w_1
  double exponential_share = 0.301, exponential_width = 0.445;  // P_e2, w_2
  double peak_width = 0.313;                                    // sigma, of the Gaussian around 1
};

// f(q) = P_e1/w_1 exp(-q/w_1) + P_e2/w_2 exp(-q/w_2) + (1 - P_e1 - P_e2) G(q), q > 0, in units of the
// Gaussian's peak; G is Gaussian around 1 with width sigma, cut off at 0 and normalised to 1 above it.
class PhotoelectronCharge {
 public:
  // Shares in 0..1 with a sum of at most 1, widths above 0.
  explicit PhotoelectronCharge(const PhotoelectronChargeSettings& settings = {}) : settings_(settings) {}

  double density(double charge) const;
  double probability_below(double charge) const;
  double mean() const;
  double draw(RandomStream& stream) const;

 private:
  PhotoelectronChargeSettings settings_;
};

}  // namespace floe
