// When the tube's voltage rises above the discriminator's threshold (arXiv:1612.05093, section 4.2).
#pragma once

#include <span>
#include <vector>

#include "response/pulse_shape.h"

namespace floe {

struct DiscriminatorSettings {
  double threshold = 0.25;  // of the peak of a photoelectron of the peak's charge
};

// Times at which the sum of the pulses rises through the threshold, in order [ns]. `photoelectrons` are in
// order of time.
std::vector<double> threshold_crossings(const DiscriminatorSettings& settings, const PulseShape& shape,
                                        std::span<const Photoelectron> photoelectrons);

}  // namespace floe
