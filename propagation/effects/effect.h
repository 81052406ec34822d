// An effect is a thing: something about ice, modules or sources that may be otherwise, with a name and
// numbers. Simulations (--with), fits of the ice and its diagnosis use one catalogue of them.
//
// A new effect is a file in this folder and a line in catalogue.cpp (besides its file's name in the room's
// CMakeLists.txt): docs/guide/effects.md.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "propagation/model_parts.h"

namespace floe {

struct EffectParameter {
  std::string name;            // "strength"
  std::string unit;            // as users write it: "deg", "m", "ns", "m/km"; "" for a pure number
  std::string description;     // one line
  double null_value;           // at which the model is what it is without the effect
  double low, high;            // valid range, inclusive; the null value is valid wherever it lies
  bool names_a_place = false;  // a whole number that names a string or a module: nothing to be fitted
  double large_change = 0;     // fits take no longer step; 0: a twenty-fifth of the range
};

class Effect {
 public:
  virtual ~Effect() = default;
  virtual std::string name() const = 0;         // "birefringence"
  virtual std::string description() const = 0;  // one line
  virtual std::string source() const = 0;       // paper
  // Of this model: null values are what it has (a scale of something absent is 0, ...). The number and order
  // of parameters are the same for every model.
  virtual std::vector<EffectParameter> parameters(const ModelParts& model) const = 0;
  // Changes the parts; values in the order of parameters(), within their ranges. At the null values nothing
  // changes. Throws UsageError where the effect makes no sense of the values in this model.
  virtual void apply(std::span<const double> values, ModelParts& model) const = 0;
};

// The catalogue, in the order in which help lists it and in which effects are applied.
const std::vector<const Effect*>& effects();
// Throws UsageError naming all known effects, the most similar first.
const Effect& find_effect(std::string_view name);

// What --with says: a value of a parameter of an effect.
struct EffectSetting {
  std::string effect, parameter;
  double value = 0;

  bool operator==(const EffectSetting&) const = default;
};

// Reads "birefringence.strength=2". Throws UsageError unless it has that form and the value is a finite
// number. Names are looked up by apply_effects.
EffectSetting parse_effect_setting(std::string_view text);
// "birefringence.strength=2", which reads back to the same.
std::string text_of(const EffectSetting& setting);
std::vector<std::string> texts_of(std::span<const EffectSetting> settings);

// Applies each effect that is named once, with all that is set of it; its other parameters keep their null
// values. In the order of the catalogue: the order of settings does not matter. Throws UsageError: unknown
// effect or parameter (naming those known, the most similar first), a parameter set twice, a value outside
// its range, an effect that makes no sense of its values.
void apply_effects(std::span<const EffectSetting> settings, ModelParts& model);

}  // namespace floe
