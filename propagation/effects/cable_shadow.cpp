#include <algorithm>

#include "data/base/error.h"
#include "propagation/effects/effect.h"

namespace floe {

namespace {

bool has_cables(const Detector& detector) {
  const auto& modules = detector.modules();
  return std::any_of(modules.begin(), modules.end(), [](const Module& m) { return m.cable_azimuth; });
}

class CableShadow final : public Effect {
 public:
  std::string name() const override { return "cable-shadow"; }
  std::string description() const override { return "The main cables hide more or less of their modules"; }
  std::string source() const override { return "arXiv:2107.10435"; }

  std::vector<EffectParameter> parameters(const ModelParts& model) const override {
    const double radius = has_cables(model.detector) ? model.acceptance.cable_radius : 0;
    // From cables to none is a large change.
    return {{"radius", "m", "of the cables; 0: they hide nothing", radius, 0, 0.1, false, 0.02}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    if (has_cables(model.detector))
      model.acceptance.cable_radius = values[0];
    else if (values[0] != 0)
      throw UsageError(name() + ": where the cables are is not known (dx.dat)");
  }
};

}  // namespace

const Effect& cable_shadow_effect() {
  static const CableShadow effect;
  return effect;
}

}  // namespace floe
