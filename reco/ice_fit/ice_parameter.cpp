#include "reco/ice_fit/ice_parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "propagation/effects/row_scaling.h"

namespace floe {

namespace {

struct FamilyTraits {
  const char* name;
  double least, most;  // factors
  void (*scale)(const IceTables& ice, IceLayerRow& row, double factor);
};

const FamilyTraits& traits_of(LayerFamily family) {
  static const FamilyTraits traits[] = {
      {"absorption", 0.1, 10, scale_absorption},
      {"scattering", 0.1, 10,
       [](const IceTables&, IceLayerRow& row, double factor) { scale_scattering(row, factor); }},
      {"birefringence", 0.02, 20,
       [](const IceTables&, IceLayerRow& row, double factor) { row.birefringence_strength *= factor; }}};
  return traits[static_cast<int>(family)];
}

int group_of(double depth, const DepthRange& range) {
  const double share = (depth - range.top) / (range.bottom - range.top);
  return std::clamp(static_cast<int>(std::floor(share * range.groups)), 0, range.groups - 1);
}

}  // namespace

std::vector<IceParameter> layer_parameters(LayerFamily family, const Model&, const DepthRange& range) {
  const FamilyTraits& traits = traits_of(family);
  std::vector<IceParameter> parameters;
  for (int group = 0; group < range.groups; ++group) {
    const double depth = range.top + (group + 0.5) * (range.bottom - range.top) / range.groups;
    IceParameter parameter;
    parameter.name = fmt::format("{} {:.0f} m", traits.name, depth);
    parameter.family = traits.name;
    parameter.depth = depth;
    parameter.logarithmic = true;
    parameter.low = std::log(traits.least);
    parameter.high = std::log(traits.most);
    parameter.apply = [&traits, range, group](double number, ModelParts& model) {
      for (IceLayerRow& row : model.ice.layers)
        if (group_of(row.depth, range) == group) traits.scale(model.ice, row, std::exp(number));
    };
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

Model with_parameters(const Model& base, const std::vector<IceParameter>& parameters,
                      const std::vector<double>& numbers) {
  ModelParts parts = parts_of(base);
  for (std::size_t i = 0; i < parameters.size(); ++i) parameters[i].apply(numbers[i], parts);
  return freeze(std::move(parts));
}

}  // namespace floe
