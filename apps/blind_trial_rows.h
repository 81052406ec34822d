// Blind trials as JSON: what the result file says of each, and the rows of a run that can be resumed.
#pragma once

#include <span>
#include <vector>

#include "apps/planned_output.h"
#include "reco/diagnose/blind_trials.h"

namespace floe {

Json to_json(const BlindTrial& trial);
Json to_json(const FullTrial& trial);
// What is hidden in the trials, and in whole diagnoses.
Json sealed_json(std::span<const HiddenEffect> trials, std::span<const std::vector<HiddenEffect>> full);
// Throw nlohmann's exceptions for what is no such row.
BlindTrial blind_trial_of(const Json& json);
FullTrial full_trial_of(const Json& json);

}  // namespace floe
