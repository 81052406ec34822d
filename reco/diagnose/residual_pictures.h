// Residuals as pictures: along one axis, and module by module.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "reco/diagnose/where.h"

namespace floe {

// Points with errors against the axis, as SVG: `before` in red, `after` (where there is one) in blue.
// `marked`: a place on the axis that has a name.
std::string profile_picture(const ResidualProfile& before, const ResidualProfile* after,
                            const std::optional<std::pair<double, std::string>>& marked);

// Every module of `modules`, the axis "module", by string and number, as SVG: how many standard deviations
// the data are above (red) or below (blue) the model. Strings of `beside`, where there is one, have columns,
// too, so that two pictures can be compared.
std::string module_picture(const ResidualProfile& modules, const ResidualProfile* beside,
                           const std::string& title);

}  // namespace floe
