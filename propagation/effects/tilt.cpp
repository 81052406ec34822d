#include "propagation/effects/effect.h"
#include "propagation/effects/rising_layers.h"

namespace floe {

namespace {

class Tilt final : public Effect {
 public:
  std::string name() const override { return "tilt"; }
  std::string description() const override {
    return "Layers rise or fall along 225 deg, in addition to the tilt that the model has";
  }
  std::string source() const override { return "arXiv:1301.5361, arXiv:2307.13951"; }

  std::vector<EffectParameter> parameters(const ModelParts&) const override {
    return {{"slope", "m/km", "added to the layers' rise along 225 deg", 0, -300, 300}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    const double slope = values[0];
    if (slope != 0) add_rise([slope](double) { return slope; }, model);
  }
};

}  // namespace

const Effect& tilt_effect() {
  static const Tilt effect;
  return effect;
}

}  // namespace floe
