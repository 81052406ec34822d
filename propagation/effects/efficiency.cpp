// Modules that see more or less of the light: one, those of a string, or all.
#include "data/base/error.h"
#include "propagation/effects/choice_of_modules.h"
#include "propagation/effects/effect.h"

namespace floe {

namespace {

constexpr double lowest = 0.01, highest = 10;  // of a factor

void scale(double string, double dom, double factor, ModelParts& model) {
  if (factor == 1) return;
  model.detector = with_modules(model.detector, string, dom,
                                [&](Module& module) { module.relative_efficiency *= factor; });
}

class ModuleEfficiency final : public Effect {
 public:
  std::string name() const override { return "module-efficiency"; }
  std::string description() const override { return "One module sees more or less of the light"; }
  std::string source() const override { return "arXiv:1311.4767"; }

  std::vector<EffectParameter> parameters(const ModelParts&) const override {
    return {string_parameter(),
            {"dom", "", "number of the module on its string; 0: none", 0, 0, 100000, true},
            {"factor", "", "multiplies the module's efficiency", 1, lowest, highest}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    const double string = values[0], dom = values[1], factor = values[2];
    if (string == 0 && dom == 0 && factor == 1) return;
    if (string == 0 || dom == 0)
      throw UsageError(name() + ": found no module; expected string, dom and factor, all three");
    expect_modules(model.detector, string, dom, name());
    scale(string, dom, factor, model);
  }
};

class StringEfficiency final : public Effect {
 public:
  std::string name() const override { return "string-efficiency"; }
  std::string description() const override { return "The modules of a string see more or less of the light"; }
  std::string source() const override { return "arXiv:1311.4767"; }

  std::vector<EffectParameter> parameters(const ModelParts&) const override {
    return {string_parameter(),
            {"factor", "", "multiplies the efficiency of its modules", 1, lowest, highest}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    const double string = values[0], factor = values[1];
    if (string == 0 && factor == 1) return;
    if (string == 0) throw UsageError(name() + ": found no string; expected string and factor, both");
    expect_modules(model.detector, string, 0, name());
    scale(string, 0, factor, model);
  }
};

class OverallEfficiency final : public Effect {
 public:
  std::string name() const override { return "overall-efficiency"; }
  std::string description() const override { return "All modules see more or less of the light"; }
  std::string source() const override { return "arXiv:1311.4767"; }

  std::vector<EffectParameter> parameters(const ModelParts&) const override {
    return {{"factor", "", "multiplies the efficiency of all modules", 1, lowest, highest}};
  }
  // The ice's directory holds the number, too, and its hash counts it.
  void apply(std::span<const double> values, ModelParts& model) const override {
    model.acceptance.overall_efficiency *= values[0];
    model.ice.configuration.module_efficiency *= values[0];
  }
};

}  // namespace

const Effect& module_efficiency_effect() {
  static const ModuleEfficiency effect;
  return effect;
}
const Effect& string_efficiency_effect() {
  static const StringEfficiency effect;
  return effect;
}
const Effect& overall_efficiency_effect() {
  static const OverallEfficiency effect;
  return effect;
}

}  // namespace floe
