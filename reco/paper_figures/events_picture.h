// Errors of a few events' fits with two models, as a picture.
#pragma once

#include <string>
#include <vector>

namespace floe {

struct FitErrors {
  double angle = 0, distance = 0;  // from the truth [rad], [m]
  double energy_ratio = 1;         // over the true one
};

struct EventErrors {
  int number = 1;
  FitErrors with, without;                            // birefringence
  double delta_neg_llh = 0, delta_neg_llh_error = 0;  // without - with
};

// SVG text: a row for each event, a panel for each of angle, distance, energy and likelihood.
std::string events_picture(const std::vector<EventErrors>& events, const std::string& title);

}  // namespace floe
