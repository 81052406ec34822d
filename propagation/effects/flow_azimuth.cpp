#include "propagation/effects/effect.h"

namespace floe {

namespace {

class FlowAzimuth final : public Effect {
 public:
  std::string name() const override { return "flow-azimuth"; }
  std::string description() const override {
    return "Where the ice flows to: the axis of birefringence and of both anisotropies";
  }
  std::string source() const override { return "arXiv:1309.7010, arXiv:2107.08692"; }

  std::vector<EffectParameter> parameters(const ModelParts& model) const override {
    return {
        {"azimuth", "deg", "of the axis of the flow", model.ice.configuration.flow_azimuth_deg, -360, 360}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    model.ice.configuration.flow_azimuth_deg = values[0];
  }
};

}  // namespace

const Effect& flow_azimuth_effect() {
  static const FlowAzimuth effect;
  return effect;
}

}  // namespace floe
