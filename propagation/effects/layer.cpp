// More or less dust at one depth.
#include <algorithm>
#include <cmath>

#include "propagation/effects/effect.h"
#include "propagation/effects/row_scaling.h"
#include "propagation/ice/ice_model.h"

namespace floe {

namespace {

std::vector<EffectParameter> layer_parameters(const IceTables& ice, const std::string& what) {
  const bool none = ice.layers.empty();
  const double top = none ? 0 : ice.layers.front().depth, bottom = none ? 5000 : ice.layers.back().depth;
  constexpr double a_layer = 20;  // the light knows little of what lies further off
  return {{"depth", "m", "of the middle of the changed ice, below the surface", (top + bottom) / 2, top,
           bottom, false, a_layer},
          {"width", "m", "of the changed ice, from its top to its bottom", 50, 1, 2000, false, a_layer},
          {"factor", "", "multiplies " + what + " there", 1, 0.1, 10}};
}

// Calls change(row, factor) for the rows in the changed ice. One that its edge cuts gets the factor in
// proportion to the overlap, so that nothing jumps when depth and width move.
template <class Change>
void change_layer(std::span<const double> values, IceTables& ice, Change change) {
  const double depth = values[0], width = values[1], factor = values[2];
  const double step = layer_step(ice.layers);
  for (IceLayerRow& row : ice.layers) {
    const double top = std::max(row.depth - step / 2, depth - width / 2);
    const double bottom = std::min(row.depth + step / 2, depth + width / 2);
    if (bottom > top) change(row, std::lerp(1.0, factor, std::min(1.0, (bottom - top) / step)));
  }
}

class AbsorptionLayer final : public Effect {
 public:
  std::string name() const override { return "absorption-layer"; }
  std::string description() const override {
    return "Absorption by dust is stronger or weaker between two depths";
  }
  std::string source() const override { return "arXiv:1301.5361"; }

  std::vector<EffectParameter> parameters(const ModelParts& model) const override {
    return layer_parameters(model.ice, "the dust absorption");
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    IceTables& ice = model.ice;
    change_layer(values, ice, [&](IceLayerRow& row, double factor) { scale_absorption(ice, row, factor); });
  }
};

class ScatteringLayer final : public Effect {
 public:
  std::string name() const override { return "scattering-layer"; }
  std::string description() const override { return "Scattering is stronger or weaker between two depths"; }
  std::string source() const override { return "arXiv:1301.5361"; }

  std::vector<EffectParameter> parameters(const ModelParts& model) const override {
    return layer_parameters(model.ice, "the table's effective scattering");
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    change_layer(values, model.ice, scale_scattering);
  }
};

}  // namespace

const Effect& absorption_layer_effect() {
  static const AbsorptionLayer effect;
  return effect;
}
const Effect& scattering_layer_effect() {
  static const ScatteringLayer effect;
  return effect;
}

}  // namespace floe
