// More or less dust everywhere.
#include "propagation/effects/effect.h"
#include "propagation/effects/row_scaling.h"

namespace floe {

namespace {

class AbsorptionScale final : public Effect {
 public:
  std::string name() const override { return "absorption-scale"; }
  std::string description() const override {
    return "Absorption by dust is stronger or weaker in all layers";
  }
  std::string source() const override { return "arXiv:1301.5361"; }

  std::vector<EffectParameter> parameters(const ModelParts&) const override {
    return {{"factor", "", "multiplies the dust absorption of every layer", 1, 0.1, 10}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    WavelengthDependence& w = model.ice.wavelength;
    if ((w.D || w.E) && model.ice.version != 20) {  // also where no column of dust makes so little absorption
      if (w.D) *w.D *= values[0];
      if (w.E) *w.E *= values[0];
      return;
    }
    for (IceLayerRow& row : model.ice.layers) scale_absorption(model.ice, row, values[0]);
  }
};

class ScatteringScale final : public Effect {
 public:
  std::string name() const override { return "scattering-scale"; }
  std::string description() const override { return "Scattering is stronger or weaker in all layers"; }
  std::string source() const override { return "arXiv:1301.5361"; }

  std::vector<EffectParameter> parameters(const ModelParts&) const override {
    return {{"factor", "", "multiplies the table's effective scattering of every layer", 1, 0.1, 10}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    for (IceLayerRow& row : model.ice.layers) scale_scattering(row, values[0]);
  }
};

}  // namespace

const Effect& absorption_scale_effect() {
  static const AbsorptionScale effect;
  return effect;
}
const Effect& scattering_scale_effect() {
  static const ScatteringScale effect;
  return effect;
}

}  // namespace floe
