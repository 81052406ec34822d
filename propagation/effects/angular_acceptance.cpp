#include "data/base/error.h"
#include "propagation/effects/effect.h"

namespace floe {

namespace {

class AngularAcceptanceEffect final : public Effect {
 public:
  std::string name() const override { return "angular-acceptance"; }
  std::string description() const override {
    return "Modules see more of the light from below, and less of that from above";
  }
  std::string source() const override { return "arXiv:2107.10435"; }

  std::vector<EffectParameter> parameters(const ModelParts&) const override {
    return {{"slope", "", "p of the factor 1 + p cos(eta) on the angular acceptance", 0, -1, 1}};
  }

  // A polynomial stays one: c_k becomes c_k + p c_(k-1).
  void apply(std::span<const double> values, ModelParts& model) const override {
    const double slope = values[0];
    if (slope == 0) return;
    AngularAcceptance& angular = model.acceptance.angular;
    if (angular.is_surface())
      throw UsageError(
          "angular-acceptance: the modules of this model accept light by its place of impact, whatever its "
          "direction; expected an angular acceptance that is a polynomial (as.dat)");
    std::vector<double> coefficients = angular.coefficients();
    coefficients.push_back(0);
    for (std::size_t k = coefficients.size() - 1; k > 0; --k) coefficients[k] += slope * coefficients[k - 1];
    angular = AngularAcceptance::polynomial(std::move(coefficients));
  }
};

}  // namespace

const Effect& angular_acceptance_effect() {
  static const AngularAcceptanceEffect effect;
  return effect;
}

}  // namespace floe
