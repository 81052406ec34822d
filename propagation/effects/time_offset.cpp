#include "propagation/effects/choice_of_modules.h"
#include "propagation/effects/effect.h"

namespace floe {

namespace {

class TimeOffset final : public Effect {
 public:
  std::string name() const override { return "time-offset"; }
  std::string description() const override { return "The clocks of a string, or of flashers, are off"; }
  std::string source() const override { return "arXiv:1612.05093"; }

  std::vector<EffectParameter> parameters(const ModelParts&) const override {
    return {{"string", "", "number of the string whose hits are late; 0: flashers are", 0, 0, 100000, true},
            {"time", "ns", "added to the times of its hits, or of all flashes", 0, -1000, 1000}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    const double string = values[0], time = values[1];
    if (string == 0) {
      model.sources.time_offset += time;
      return;
    }
    expect_modules(model.detector, string, 0, name());
    if (time != 0)
      model.detector =
          with_modules(model.detector, string, 0, [time](Module& module) { module.clock_offset += time; });
  }
};

}  // namespace

const Effect& time_offset_effect() {
  static const TimeOffset effect;
  return effect;
}

}  // namespace floe
