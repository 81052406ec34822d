// Drawing from a distribution by its tabulated quantiles: one random number, one look-up.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace floe {

// Quantiles at equal steps of probability, linear between them. With 4096 steps the outermost one holds
// 2.4e-4 of the distribution; it reaches to the ends of the grid that the table was made from.
class QuantileTable {
 public:
  // From a density on [low, high], given up to a factor; integrated on a fine grid by the trapezoidal rule.
  template <typename Density>
  static QuantileTable of_density(double low, double high, Density density) {
    constexpr int points = 16384;
    const double step = (high - low) / points;
    std::vector<double> cumulative(points + 1);
    double before = density(low);
    for (int i = 1; i <= points; ++i) {
      const double here = density(low + i * step);
      cumulative[i] = cumulative[i - 1] + (before + here) / 2;
      before = here;
    }
    QuantileTable table;
    int i = 0;
    for (int k = 0; k <= steps; ++k) {
      const double wanted = cumulative.back() * k / steps;
      while (i + 1 < points && cumulative[i + 1] < wanted) ++i;
      const double rise = cumulative[i + 1] - cumulative[i];
      const double share = rise > 0 ? std::clamp((wanted - cumulative[i]) / rise, 0.0, 1.0) : 0.0;
      table.quantiles_.push_back(static_cast<float>(low + (i + share) * step));
    }
    return table;
  }
  // From the quantile function itself, u in [0, 1].
  template <typename Quantile>
  static QuantileTable of_quantile(Quantile quantile) {
    QuantileTable table;
    for (int k = 0; k <= steps; ++k)
      table.quantiles_.push_back(static_cast<float>(quantile(static_cast<double>(k) / steps)));
    return table;
  }

  float operator()(float u) const { return view()(u); }  // u in [0, 1)

  // On a plain pointer, for loops that become vector code.
  struct View {
    const float *lower, *upper;  // of each step
    float operator()(float u) const {
      const float place = u * steps;
      const int index = static_cast<int>(place);
      const float low = lower[index], high = upper[index];
      return low + (place - static_cast<float>(index)) * (high - low);
    }
  };
  View view() const { return {quantiles_.data(), quantiles_.data() + 1}; }

 private:
  static constexpr int steps = 4096;
  std::vector<float> quantiles_;
};

}  // namespace floe
