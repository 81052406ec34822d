#include "propagation/effects/effect.h"

namespace floe {

namespace {

class Birefringence final : public Effect {
 public:
  std::string name() const override { return "birefringence"; }
  std::string description() const override {
    return "Crystals turn and displace photons; where a model has no numbers for it, those of SpiceBFR v2";
  }
  std::string source() const override { return "arXiv:2107.08692"; }

  std::vector<EffectParameter> parameters(const ModelParts& model) const override {
    const bool has_it = model.ice.configuration.birefringence.has_value();
    return {{"strength", "", "multiplies every layer's strength A; 0: no birefringence", has_it ? 1.0 : 0.0,
             0, 10, false, 2}};
  }

  // At 0 the numbers go, too: it is the same ice as --without birefringence.
  void apply(std::span<const double> values, ModelParts& model) const override {
    auto& numbers = model.ice.configuration.birefringence;
    if (values[0] == 0) {
      numbers.reset();
      return;
    }
    if (!numbers) numbers = published_birefringence();
    for (IceLayerRow& row : model.ice.layers) row.birefringence_strength *= values[0];
  }
};

}  // namespace

const Effect& birefringence_effect() {
  static const Birefringence effect;
  return effect;
}

}  // namespace floe
