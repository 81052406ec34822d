#include "reco/direct_fit/two_cascades.h"

#include <cmath>

namespace floe {
namespace {

// ln(one / other) of a bin from all simulations but one part, drawn to 0 by its own noise: a bin that they
// do not tell apart would only add its noise.
double weight(const BinOfData& one, const BinOfData& one_part, const BinOfData& other,
              const BinOfData& other_part) {
  constexpr double half_a_count = 0.5;  // for bins where a simulation is empty
  const double a = one.simulation - one_part.simulation + half_a_count;
  const double b = other.simulation - other_part.simulation + half_a_count;
  const double logarithm = std::log(a / b), variance = 1 / a + 1 / b;
  const double square = logarithm * logarithm;
  return logarithm * square / (square + variance);
}

// What a cascade makes of the sum.
struct Expected {
  double sum = 0, variance = 0;  // of the data
  double error = 0;              // of `sum`, squared: the simulation's
  void add(const BinOfData& bin, double mean_weight, double model_error, double charge_dispersion) {
    const double counts = bin.simulation * bin.data_events / bin.simulation_events;
    variance += mean_weight * mean_weight *
                (charge_dispersion * counts + model_error * model_error * counts * counts);
  }
  void add_part(const BinOfData& part, double parts, double weight) {
    const double scale = weight * part.data_events / part.simulation_events / parts;
    sum += scale * part.simulation;
    error += scale * scale * part.simulation;
  }
  double chi_square(double seen) const { return (seen - sum) * (seen - sum) / variance; }
  // Of half the chi-square.
  double chi_square_error(double seen) const { return std::abs(seen - sum) / variance * std::sqrt(error); }
};

}  // namespace

Difference worse_by(const Evaluation& one, const Evaluation& other, double model_error,
                    double charge_dispersion) {
  const auto parts = static_cast<double>(one.parts.size());
  Expected from_one, from_other;
  double seen = 0;
  for (std::size_t i = 0; i < one.bins.size(); ++i) {
    if (one.bins[i].saturated || one.bins[i].left_out) continue;
    double mean_weight = 0;
    for (std::size_t k = 0; k < one.parts.size(); ++k) {
      const BinOfData &a = one.parts[k][i], &b = other.parts[k][i];
      const double w = weight(one.bins[i], a, other.bins[i], b);
      from_one.add_part(a, parts, w);
      from_other.add_part(b, parts, w);
      mean_weight += w / parts;
    }
    from_one.add(one.bins[i], mean_weight, model_error, charge_dispersion);
    from_other.add(other.bins[i], mean_weight, model_error, charge_dispersion);
    seen += mean_weight * one.bins[i].data;
  }
  if (!(from_one.variance > 0 && from_other.variance > 0)) return {};
  return {(from_one.chi_square(seen) + std::log(from_one.variance) - from_other.chi_square(seen) -
           std::log(from_other.variance)) /
              2,
          std::hypot(from_one.chi_square_error(seen), from_other.chi_square_error(seen))};
}

}  // namespace floe
