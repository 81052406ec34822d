#include <cassert>

#include "propagation/ice/ice_model.h"

namespace floe {

namespace {
// Of the index itself and of the ratio group/phase, in powers of the wavelength in micrometres
// (fits to laboratory data, given in arXiv:1301.5361).
constexpr double phase_terms[] = {1.55749, -1.57988, 3.99993, -4.68271, 2.09354};
constexpr double ratio_terms[] = {1 + 0.227106, -0.954648, 1.42568, -0.711832};

template <std::size_t n>
double polynomial(const double (&terms)[n], double x) {
  double value = 0;
  for (std::size_t i = n; i-- > 0;) value = value * x + terms[i];
  return value;
}
}  // namespace

double phase_index(double wavelength) {
  assert(250 <= wavelength && wavelength <= 700);
  return polynomial(phase_terms, wavelength * 1e-3);
}

double group_index(double wavelength) {
  return phase_index(wavelength) * polynomial(ratio_terms, wavelength * 1e-3);
}

}  // namespace floe
