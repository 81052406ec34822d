#include "propagation/model_hash.h"

#include "data/base/hash.h"

namespace floe {

namespace {

void add(const AngularAcceptance& angular, Hasher& hash) {
  hash.add(angular.is_surface()).add(angular.cut()).add(angular.maximum());
  hash.add(angular.coefficients().size());
  for (const double coefficient : angular.coefficients()) hash.add(coefficient);
}

void add(const WavelengthSpectrum& spectrum, Hasher& hash) {
  hash.add(spectrum.points().size());
  for (const auto& point : spectrum.points()) hash.add(point.cumulative).add(point.wavelength);
}

void add(const std::optional<HighQeRatio>& ratio, Hasher& hash) {
  hash.add(ratio.has_value());
  if (!ratio) return;
  hash.add(ratio->points().size());
  for (const auto& point : ratio->points()) hash.add(point.wavelength).add(point.ratio);
}

}  // namespace

std::string model_hash(const Model& model) {
  Hasher hash;
  hash.add(std::string_view(model.ice->hash())).add(std::string_view(model.detector->hash()));
  const ModuleAcceptance& acceptance = model.acceptance;
  hash.add(acceptance.overall_efficiency).add(acceptance.cable_radius);
  add(acceptance.angular, hash);
  add(acceptance.spectrum, hash);
  add(acceptance.high_qe, hash);
  const SourceSettings& sources = model.sources;
  hash.add(sources.width_factor).add(sources.time_offset).add(sources.brightness_factor);
  hash.add(model.noise_rate);
  return hash.hex();
}

}  // namespace floe
