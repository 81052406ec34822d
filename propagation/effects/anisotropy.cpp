// Light goes further along the flow than across it: by less absorption, or by less scattering.
#include <algorithm>

#include "propagation/effects/effect.h"

namespace floe {

namespace {

// An ellipsoid about the flow that keeps its volume: what k1 adds along the flow is taken from the two axes
// across it.
double across(double k1) {
  return k1 == 0 ? 0 : -k1 / 2;
}

class AbsorptionAnisotropy final : public Effect {
 public:
  std::string name() const override { return "absorption-anisotropy"; }
  std::string description() const override {
    return "Absorption is weaker along the flow and stronger across it, the mean being kept";
  }
  std::string source() const override { return "arXiv:2107.08692"; }

  std::vector<EffectParameter> parameters(const ModelParts& model) const override {
    const auto& k = model.ice.configuration.absorption_anisotropy;
    return {{"k1", "", "natural logarithm along the flow; k2 = kz = -k1/2", k ? k->k1 : 0, -1.5, 1.5, false,
             0.4}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    const double k1 = values[0];
    if (k1 == parameters(model)[0].null_value) return;  // whatever its k2 and kz are
    model.ice.configuration.absorption_anisotropy = {k1, across(k1), across(k1)};
  }
};

constexpr double a_tenth = 0.1;  // larger differences change light by more than a linear share

double k1_of(const IceTables& ice, const IceLayerRow& row) {
  return row.k1.value_or(ice.configuration.k1);
}
double k2_of(const IceTables& ice, const IceLayerRow& row) {
  return row.k2.value_or(ice.configuration.k2);
}

class ScatteringAnisotropy final : public Effect {
 public:
  std::string name() const override { return "scattering-anisotropy"; }
  std::string description() const override {
    return "Scattering is weaker along the flow and stronger across it, alike in all layers";
  }
  std::string source() const override { return "arXiv:1309.7010"; }

  // Layers may differ; the first one stands for the model.
  std::vector<EffectParameter> parameters(const ModelParts& model) const override {
    const IceTables& ice = model.ice;
    const double null_value = ice.layers.empty() ? ice.configuration.k1 : k1_of(ice, ice.layers.front());
    return {
        {"k1", "", "natural logarithm along the flow; k2 = -k1/2", null_value, -0.5, 0.5, false, a_tenth}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    const double k1 = values[0];
    if (k1 == parameters(model)[0].null_value) return;  // whatever its k2 and its other layers are
    IceTables& ice = model.ice;
    const bool was_isotropic = std::all_of(ice.layers.begin(), ice.layers.end(), [&](const IceLayerRow& row) {
      return k1_of(ice, row) == 0 && k2_of(ice, row) == 0;
    });
    // The old anisotropy of absorption follows k1 and k2. Models that have none may leave its scaling at 1.
    if (was_isotropic) ice.configuration.old_absorption_scaling = 0;
    ice.configuration.k1 = k1, ice.configuration.k2 = across(k1);
    for (IceLayerRow& row : ice.layers) row.k1 = k1, row.k2 = across(k1);
  }
};

}  // namespace

const Effect& absorption_anisotropy_effect() {
  static const AbsorptionAnisotropy effect;
  return effect;
}
const Effect& scattering_anisotropy_effect() {
  static const ScatteringAnisotropy effect;
  return effect;
}

}  // namespace floe
