// Size and shape of the ice's grains (docs/theory/crystal.md): how often light meets a boundary between
// crystals, and which way boundaries face.
#include <algorithm>
#include <cmath>

#include "data/base/error.h"
#include "propagation/effects/effect.h"

namespace floe {

namespace {

constexpr double grain_of_strength_1 = 1;  // mean distance between crossings [mm] (arXiv:2107.08692)
// What numbers are taken to stand for: of the published ones it is known, directories do not say.
constexpr double elongation_of_models = 1.4;

// c x + d x^2, with x = 1 - 1.4/elongation.
struct Trend {
  double c, d;
  double at(double x) const { return x * (c + d * x); }
};

// How a width A exp(-B [atan(D sin eta)]^C) changes: ln A; the logarithm of its fall ln A - ln sigma(90 deg);
// C; and the bend D, that of long grains: widths do not fall on where light travels across the flow.
struct WidthTrends {
  Trend along, fall, exponent;
  double bend;
};

// How the deflection A atan(D sin eta cos eta) exp(-B sin eta + C cos eta) changes: ln A, B, C.
struct DeflectionTrends {
  Trend amplitude, B, C;
};

// One least-squares fit each, to what all photons of floe crystal --fabric 0.1,4 do at 19 angles and the
// elongations 1, 1.2, 1.4, 1.7, 2, 2.5 and 3 (docs/decisions/023-grains-by-trends.md).
constexpr WidthTrends width_x{{0.7562, 0.1905}, {1.5582, -0.5772}, {-0.0826, 2.0556}, 2.6858},
    width_y{{0.7680, 0.2002}, {0.8748, -0.1845}, {-0.7652, 1.1779}, 1.6718};
constexpr DeflectionTrends deflection_x{{1.1880, 2.5580}, {3.1795, 4.1958}, {3.5193, -1.6863}};

// D counts with its square where it is small: so that the curve is smooth in x at 0, too.
void lengthen(const WidthTrends& trends, double x, DiffusionFunction& f) {
  const double fall = f.B * std::pow(std::atan(f.D), f.C) * std::exp(trends.fall.at(x));
  f.A *= std::exp(trends.along.at(x));
  f.C += trends.exponent.at(x);
  f.D = std::hypot(f.D, trends.bend * std::max(x, 0.0));
  f.B = fall == 0 ? 0 : fall / std::pow(std::atan(f.D), f.C);
}

void lengthen(const DeflectionTrends& trends, double x, DiffusionFunction& f) {
  f.A *= std::exp(trends.amplitude.at(x));
  f.B += trends.B.at(x);
  f.C += trends.C.at(x);
}

// 0 without birefringence.
double mean_strength(const IceTables& ice) {
  if (!ice.configuration.birefringence || ice.layers.empty()) return 0;
  double sum = 0;
  for (const IceLayerRow& row : ice.layers) sum += row.birefringence_strength;
  return sum / static_cast<double>(ice.layers.size());
}

class Grains final : public Effect {
 public:
  std::string name() const override { return "grains"; }
  std::string description() const override {
    return "Grains are larger or smaller, and longer or shorter along the flow; c-axes form a girdle";
  }
  std::string source() const override { return "arXiv:2107.08692; The Cryosphere 18, 75 (2024)"; }

  std::vector<EffectParameter> parameters(const ModelParts& model) const override {
    const double strength = mean_strength(model.ice);
    const double size = strength > 0 ? grain_of_strength_1 / strength : grain_of_strength_1;
    return {{"size", "mm",
             "mean distance between boundaries, 1 mm / mean strength A of the layers; all change alike", size,
             0.01, 100, false, size / 3},
            {"elongation", "", "long axis, along the flow, over short axis; models stand for 1.4",
             elongation_of_models, 1, 3, false, 0.3}};
  }

  void apply(std::span<const double> values, ModelParts& model) const override {
    const double null_size = parameters(model)[0].null_value, size = values[0], elongation = values[1];
    if (size == null_size && elongation == elongation_of_models) return;
    if (mean_strength(model.ice) == 0)
      throw UsageError(
          "grains: the ice has no birefringence that grains could change; give it some with "
          "birefringence.strength=1");
    if (size != null_size)
      for (IceLayerRow& row : model.ice.layers) row.birefringence_strength *= null_size / size;
    if (elongation == elongation_of_models) return;
    const double x = 1 - elongation_of_models / elongation;
    BirefringenceNumbers& numbers = *model.ice.configuration.birefringence;
    lengthen(width_x, x, numbers.sigma_x);
    lengthen(width_y, x, numbers.sigma_y);
    lengthen(deflection_x, x, numbers.mean_x);
  }
};

}  // namespace

const Effect& grains_effect() {
  static const Grains effect;
  return effect;
}

}  // namespace floe
