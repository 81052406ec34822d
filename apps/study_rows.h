// Rows of the calibration study as JSON: metres, nanoseconds, radians and GeV, as inside floe.
#pragma once

#include "apps/planned_output.h"
#include "reco/study/study.h"

namespace floe {

Json to_json(const StudyRow& row);
StudyRow study_row_of(const Json& json);  // throws nlohmann's exceptions for what is no such row

}  // namespace floe
