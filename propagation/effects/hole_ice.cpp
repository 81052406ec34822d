#include "propagation/effects/effect.h"

namespace floe {

namespace {

class HoleIceEffect final : public Effect {
 public:
  std::string name() const override { return "hole-ice"; }
  std::string description() const override { return "The refrozen ice around the strings scatters more"; }
  std::string source() const override { return "arXiv:2107.10435"; }

  std::vector<EffectParameter> parameters(const ModelParts& model) const override {
    const HoleIce& hole = model.ice.configuration.hole_ice;
    return {{"radius", "module radii", "of the column; 0: no hole ice", hole.radius, 0, 10},
            {"scattering", "m", "effective scattering length in the column", hole.effective_scattering_length,
             0.001, 10}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    HoleIce& hole = model.ice.configuration.hole_ice;
    hole.radius = values[0];
    hole.effective_scattering_length = values[1];
  }
};

}  // namespace

const Effect& hole_ice_effect() {
  static const HoleIceEffect effect;
  return effect;
}

}  // namespace floe
