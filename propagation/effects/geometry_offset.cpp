#include "data/base/error.h"
#include "propagation/effects/choice_of_modules.h"
#include "propagation/effects/effect.h"

namespace floe {

namespace {

// With its drill hole. (A 1D tilt that is measured from the string goes with it.)
Detector moved(const Detector& detector, double string, const Vec3& offset) {
  const Detector shifted =
      with_modules(detector, string, 0, [&](Module& module) { module.position += offset; });
  auto holes = detector.strings();
  holes.at(static_cast<int>(string)) += offset.head<2>();
  return {detector.name(), shifted.modules(), std::move(holes)};
}

class GeometryOffset final : public Effect {
 public:
  std::string name() const override { return "geometry-offset"; }
  std::string description() const override {
    return "A string hangs elsewhere, with its modules and its hole";
  }
  std::string source() const override { return "arXiv:1612.05093"; }

  std::vector<EffectParameter> parameters(const ModelParts&) const override {
    return {string_parameter(),
            {"x", "m", "added to the x of its modules", 0, -20, 20},
            {"y", "m", "added to the y of its modules", 0, -20, 20},
            {"z", "m", "added to the z of its modules, upwards", 0, -20, 20}};
  }
  void apply(std::span<const double> values, ModelParts& model) const override {
    const double string = values[0];
    const Vec3 offset(values[1], values[2], values[3]);
    if (string == 0 && offset.isZero(0)) return;
    if (string == 0) throw UsageError(name() + ": found no string; expected string and x, y or z");
    expect_modules(model.detector, string, 0, name());
    if (!offset.isZero(0)) model.detector = moved(model.detector, string, offset);
  }
};

}  // namespace

const Effect& geometry_offset_effect() {
  static const GeometryOffset effect;
  return effect;
}

}  // namespace floe
