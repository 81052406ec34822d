// What a fit of the ice may change.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "propagation/effects/effect.h"
#include "propagation/model.h"
#include "propagation/model_parts.h"

namespace floe {

// One number of the fit. Numbers that are positive by nature are fitted as logarithms.
struct IceParameter {
  std::string name;          // e.g. "absorption 1775 m"
  std::string unit;          // of the value that is shown; empty for a pure number
  bool logarithmic = false;  // the value shown is the exponential of the number
  double start = 0, low = 0, high = 0;
  double scale = 1;  // of a large change: no step of the fit is longer
  double prior = 0;  // width of a Gaussian about its centre; 0: that of its family, or none
  std::optional<double> prior_centre = {};  // none: the start
  // Neighbours of one family, in order of depth, are held together by the smoothness prior, in units of
  // `scale`.
  std::string family;
  double depth = 0;  // of the middle, for families over depth [m]
  // Parameters of one effect at one place, "geometry-offset of string 80": light may show some of their
  // combinations only.
  std::string place = {};
  // How it changes the model: a change of its own, or a parameter of an effect of the catalogue.
  std::function<void(double number, ModelParts& model)> apply;
  std::optional<EffectSetting> effect;  // its value is the number

  // The nearest number in its limits: sums of steps that meet them are off by a rounding.
  double within(double number) const;
  // Where the data have led already. The prior stays where it is: data must not speak twice.
  void begin_at(double number);
};

// Depths that a family is divided over: rows of the layer table, in groups of equal thickness. Rows beyond
// the range follow the outermost group.
struct DepthRange {
  double top, bottom;  // [m]
  int groups;
};

// A factor for each group of layers. `kind`: absorption (dust absorption), scattering (effective scattering)
// or birefringence (strength; a model without birefringence starts from the published numbers at strength 1).
enum class LayerFamily { absorption, scattering, birefringence };
std::vector<IceParameter> layer_parameters(LayerFamily family, const DepthRange& range);
// Slopes of the layers along 225 deg [m/km], in addition to the model's tilt, at the middle of each group of
// layers, linear in between: the family "tilt".
std::vector<IceParameter> tilt_parameters(const DepthRange& range);
// "absorption", "scattering", "birefringence"; none for any other name.
std::optional<LayerFamily> layer_family_of(std::string_view name);
// One factor for the rows of the layer table from depth `top` to depth `bottom` [m], both inclusive; rows
// beyond stay as they are. Throws UsageError when the model has no row there, and for the birefringence of a
// model without it: published numbers would come with strength in all its rows.
IceParameter layer_factor(LayerFamily family, double top, double bottom, const Model& base);

// A parameter of an effect of the catalogue, "EFFECT.PARAMETER", or "EFFECT" alone where it has but one. It
// starts at its value in the model. Throws UsageError for unknown names, and for parameters that name a
// place.
IceParameter effect_parameter(std::string_view name, const Model& base);

// The model with all parameters at these numbers.
Model with_parameters(const Model& base, const std::vector<IceParameter>& parameters,
                      const std::vector<double>& numbers);

}  // namespace floe
