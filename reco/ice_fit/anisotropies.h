// Descriptions of why light goes further along the flow, to be compared with each other.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "propagation/model.h"

namespace floe {

struct AnisotropyDescription {
  std::string name;
  std::vector<std::string_view> effects;  // of the catalogue: all that is not alike in all directions
};

// From the plainest up: isotropic ice, absorption anisotropy, scattering anisotropy, birefringence,
// birefringence and absorption anisotropy (arXiv:2107.08692 compares the same ones).
const std::vector<AnisotropyDescription>& anisotropy_descriptions();

// The model with the anisotropy that these effects give it, and no other.
Model with_anisotropy_of(const Model& base, const std::vector<std::string_view>& effects);

}  // namespace floe
