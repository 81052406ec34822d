// Texts of floe crystal's options as what they mean.
#pragma once

#include <string>
#include <vector>

#include "propagation/crystal/pattern_grid.h"

namespace floe {

// "isotropic", "girdle" or "LN,LN": ln(S1/S2), ln(S2/S3).
Fabric parse_fabric(const std::string& option, const std::string& text);
// "1mm", "800um", "0.5cm", "0.001m" -> [m], from 1 um to 1 m.
double parse_length(const std::string& option, const std::string& text);
// Numbers between commas, each from low to high.
std::vector<double> parse_numbers(const std::string& option, const std::string& text, double low,
                                  double high);
// Angles in degrees between commas, 0 to 90, rising -> [rad].
std::vector<double> parse_angles(const std::string& option, const std::string& text);

}  // namespace floe
