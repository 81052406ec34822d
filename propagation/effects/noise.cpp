#include "propagation/effects/effect.h"

namespace floe {

namespace {

class Noise final : public Effect {
 public:
  std::string name() const override { return "noise"; }
  std::string description() const override { return "Every module has hits that no light makes"; }
  std::string source() const override { return "arXiv:1612.05093"; }

  std::vector<EffectParameter> parameters(const ModelParts& model) const override {
    constexpr double usual = 500;  // of modules in ice [Hz]
    return {
        {"rate", "Hz", "of such hits in each module, at any time", model.noise_rate, 0, 1e6, false, usual}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    model.noise_rate = values[0];
  }
};

}  // namespace

const Effect& noise_effect() {
  static const Noise effect;
  return effect;
}

}  // namespace floe
