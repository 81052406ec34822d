// Flashers that are not quite what they are said to be.
#include "propagation/effects/effect.h"

namespace floe {

namespace {

class FlasherProfile final : public Effect {
 public:
  std::string name() const override { return "flasher-profile"; }
  std::string description() const override { return "The beams of flashers are wider or narrower"; }
  std::string source() const override { return "arXiv:1612.05093"; }

  std::vector<EffectParameter> parameters(const ModelParts&) const override {
    return {{"width", "", "multiplies the width (sigma) of the beams", 1, 0.1, 5}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    model.sources.width_factor *= values[0];
  }
};

class FlasherBrightness final : public Effect {
 public:
  std::string name() const override { return "flasher-brightness"; }
  std::string description() const override { return "Flashers are brighter or dimmer"; }
  std::string source() const override { return "arXiv:1301.5361"; }

  std::vector<EffectParameter> parameters(const ModelParts&) const override {
    return {{"factor", "", "multiplies the photons of flashers", 1, 0.001, 1000}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    model.sources.brightness_factor *= values[0];
  }
};

}  // namespace

const Effect& flasher_profile_effect() {
  static const FlasherProfile effect;
  return effect;
}
const Effect& flasher_brightness_effect() {
  static const FlasherBrightness effect;
  return effect;
}

}  // namespace floe
