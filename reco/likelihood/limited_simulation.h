// The likelihood of counts when the expectation is itself a simulation of limited size and the model
// behind it is only known to some per cent (arXiv:1304.0735). Theory: docs/theory/likelihood.md.
#pragma once

namespace floe {

// One bin: d counts in n_d events of data, s counts in n_s events of simulation.
struct BinCounts {
  double data = 0;               // d >= 0
  double data_events = 1;        // n_d > 0
  double simulation = 0;         // s >= 0; an effective number of counts where simulations are combined
  double simulation_events = 1;  // n_s > 0
};

struct BinLikelihood {
  // Saturated negative log-likelihood, >= 0; 0 when the two rates agree exactly.
  double value = 0;
  // Derivatives of value with respect to the logarithm of the expectation s/n_s at fixed s (that is,
  // to -ln n_s). The second one is never negative: value is convex in the expectation's logarithm.
  double slope = 0;
  double curvature = 0;
  // The rates per event that minimise it.
  double data_rate = 0, simulation_rate = 0;
};

// The minimum over mu_s, mu_d > 0 of
//   s ln((s/n_s)/mu_s) + n_s mu_s - s + d ln((d/n_d)/mu_d) + n_d mu_d - d + ln^2(mu_d/mu_s)/(2 sigma^2)
// (arXiv:1304.0735, eq. 20 and below). At the minimum d - n_d mu_d = n_s mu_s - s =: w, the root of
//   sigma^2 w = ln((d - w)/n_d) - ln((s + w)/n_s),   -s < w < d,
// whose right side falls and left side rises; sigma = 0 forces mu_d = mu_s. With a bin empty on both
// sides everything is 0. Needs sigma >= 0.
BinLikelihood limited_simulation(const BinCounts& counts, double sigma);

// The same for a bin of which only is known that it holds `data` counts or more (a saturated module):
//   -ln P(N >= d | mu),
// N Poisson about a gamma distributed rate of mean mu = n_d s/n_s and relative variance
// v = sigma^2 + 1/s, which makes N negative binomial and P the regularised incomplete beta function
// I_x(d, 1/v), x = v mu/(1 + v mu). data_rate and simulation_rate are both s/n_s. Needs data > 0, s > 0.
BinLikelihood at_least(const BinCounts& counts, double sigma);

// The weight of one bin in the Fisher information of the logarithm of its expectation `counts`, known
// as well as `effective_simulation` counts allow: 1/(sigma^2 + 1/counts + 1/effective_simulation).
double expected_curvature(double counts, double effective_simulation, double sigma);

}  // namespace floe
