#include "propagation/effects/effect.h"

namespace floe {

namespace {

class ScatteringFunction final : public Effect {
 public:
  std::string name() const override { return "scattering-function"; }
  std::string description() const override {
    return "By which angles dust scatters; the effective scattering stays as it is";
  }
  std::string source() const override { return "arXiv:1301.5361, section 3"; }

  std::vector<EffectParameter> parameters(const ModelParts& model) const override {
    const IceConfiguration& c = model.ice.configuration;
    return {{"g", "", "mean cosine of the scattering angle", c.mean_cosine, 0.5, 0.99},
            {"liu", "", "f_SL, share of the simplified Liu function", c.simplified_liu_fraction, 0, 1}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    model.ice.configuration.mean_cosine = values[0];
    model.ice.configuration.simplified_liu_fraction = values[1];
  }
};

}  // namespace

const Effect& scattering_function_effect() {
  static const ScatteringFunction effect;
  return effect;
}

}  // namespace floe
