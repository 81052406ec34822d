#include "propagation/ice/dust.h"

#include <cmath>

namespace floe {

double thermal_factor(const WavelengthDependence& dependence, double wavelength) {
  return dependence.A * std::exp(-dependence.B / wavelength);
}

DustLaw dust_law(const IceTables& tables, const IceLayerRow& row) {
  const WavelengthDependence& w = tables.wavelength;
  DustLaw law;
  if (w.D || w.E) {
    law.D = w.D.value_or(0), law.E = w.E.value_or(0);
    law.q = std::pow(reference_wavelength, -w.kappa);
  }
  if (tables.version == 20)
    law.t = (1 + 0.01 * row.temperature_difference) * thermal_factor(w, reference_wavelength);
  return law;
}

}  // namespace floe
