#include "reco/ice_fit/anisotropies.h"

#include <algorithm>

namespace floe {

const std::vector<AnisotropyDescription>& anisotropy_descriptions() {
  static const std::vector<AnisotropyDescription> all{
      {"isotropic", {}},
      {"absorption anisotropy", {"absorption-anisotropy"}},
      {"scattering anisotropy", {"scattering-anisotropy"}},
      {"birefringence", {"birefringence"}},
      {"birefringence and absorption anisotropy", {"birefringence", "absorption-anisotropy"}}};
  return all;
}

Model with_anisotropy_of(const Model& base, const std::vector<std::string_view>& effects) {
  ModelParts parts = parts_of(base);
  for (const std::string_view effect : {"birefringence", "absorption-anisotropy", "scattering-anisotropy"})
    if (std::find(effects.begin(), effects.end(), effect) == effects.end()) switch_off(parts.ice, effect);
  return freeze(std::move(parts));
}

}  // namespace floe
