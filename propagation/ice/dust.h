// Absorption by dust against what a table says of it.
#pragma once

#include "propagation/ice/ice_tables.h"

namespace floe {

inline constexpr double reference_wavelength = 400;  // of the tables [nm]

// a_dust(400) = (D x + E) q - t [1/m] of a layer, with x the table's column. Models since 2013 tabulate
// a_dust(400) itself (D = q = 1, E = 0), older ones a concentration (arXiv:1301.5361; q = 400^-kappa). Tables
// of version 20 hold the whole absorption at 400 nm, of which t is the ice's own.
struct DustLaw {
  double D = 1, E = 0, q = 1, t = 0;

  double absorption(double column) const { return (D * column + E) * q - t; }
  double column(double absorption) const { return ((absorption + t) / q - E) / D; }  // D != 0
};
DustLaw dust_law(const IceTables& tables, const IceLayerRow& row);

// Absorption of pure ice, A e^(-B/lambda), at the temperature where delta-tau is 0 [1/m]; wavelength in nm.
double thermal_factor(const WavelengthDependence& dependence, double wavelength);

}  // namespace floe
