// The ice against depth, before and after a fit: as a table and as a picture.
#pragma once

#include <string>
#include <vector>

#include "propagation/model.h"
#include "reco/ice_fit/ice_fit.h"

namespace floe {

// One row of the layer table. Coefficients at 400 nm; errors are relative, of the fit's factor for that
// depth, 0 where it was not fitted.
struct StratigraphyRow {
  double depth;                                      // [m]
  double scattering_length, base_scattering_length;  // effective, of what is not birefringence [m]
  double absorption_length, base_absorption_length;  // [m]
  double strength, base_strength;                    // birefringence, 0 where there is none
  double scattering_error, absorption_error, strength_error;
};

// From the top down, as far as the fit's families reach (all rows when it has none).
std::vector<StratigraphyRow> stratigraphy(const Model& base, const Model& fitted, const IceFit& fit);

// Mean distance between a photon's crossings of grain boundaries [mm]: 1 mm at strength 1 (arXiv:2107.08692).
// Infinite at strength 0.
double crystal_size(double strength);

// Lines of comma-separated values with a heading.
std::string stratigraphy_csv(const std::vector<StratigraphyRow>& rows);

// Three panels against depth: scattering length, absorption length, crystal size; base and fitted, errors as
// a band. An SVG document.
std::string stratigraphy_picture(const std::vector<StratigraphyRow>& rows, const std::string& title);

}  // namespace floe
