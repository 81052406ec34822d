// Comparing two samples of hits of the same light source: how many, where, when, from which direction.
#pragma once

#include <span>

#include "data/event.h"

namespace floe {

// One family of Kolmogorov-Smirnov tests, one test a module.
struct ModuleTests {
  int tried = 0;
  double smallest_probability = 1;
  ModuleId worst;
  // The smallest probability, corrected for the number of modules tried, is above `level`.
  bool passes(double level) const { return smallest_probability * tried > level || tried == 0; }
};

struct SampleComparison {
  double hits_a = 0, hits_b = 0;
  double ratio = 0, ratio_error = 0;  // of the totals, a / b, per repetition of the source
  double chi_square = 0;              // of hits per module
  int modules = 0;                    // in the chi-square: 20 hits or more (expected from both samples)
  double chi_square_p = 1;
  ModuleTests times, zeniths, azimuths, impacts;
};

// `scale_a`, `scale_b`: how many repetitions of the source each sample holds. Modules with 200 hits or
// more in both samples are tested for times and directions. A photon that meets a module again makes
// counts over-dispersed: `dispersion` is the variance of a count over its mean (1: Poisson).
SampleComparison compare_samples(std::span<const Hit> a, double scale_a, std::span<const Hit> b,
                                 double scale_b, double dispersion);

}  // namespace floe
