#include "reco/ice_fit/score_map.h"

#include "propagation/ice/ice_hash.h"

namespace floe {

namespace {

// The tables of `changed` with everything that weights can express taken from `base`.
IceTables without_weightable(const IceTables& changed, const IceTables& base) {
  IceTables tables = changed;
  if (tables.layers.size() != base.layers.size()) return tables;
  for (std::size_t i = 0; i < tables.layers.size(); ++i) {
    IceLayerRow& row = tables.layers[i];
    const IceLayerRow& was = base.layers[i];
    row.effective_scattering = was.effective_scattering;
    row.dust_absorption = was.dust_absorption;
    row.birefringence_strength = was.birefringence_strength;
    row.deflection_strength = was.deflection_strength;
  }
  tables.configuration.absorption_anisotropy = base.configuration.absorption_anisotropy;
  return tables;
}

}  // namespace

ScoreMap::ScoreMap(const Model& model, double wavelength, int parameters)
    : model_(model), wavelength_(wavelength), parameters_(parameters), entries_(model.ice->layers().size()) {}

bool ScoreMap::add(int parameter, const Model& changed, double step) {
  const IceModel &was = *model_.ice, &is = *changed.ice;
  if (ice_hash(without_weightable(is.tables(), was.tables())) != was.hash()) return false;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const int layer = static_cast<int>(i);
    const IceLayer &a = was.layers()[i], &b = is.layers()[i];
    const Entry entry{
        parameter, (is.absorption(layer, wavelength_) - was.absorption(layer, wavelength_)) / step,
        (is.geometric_scattering(layer, wavelength_) - was.geometric_scattering(layer, wavelength_)) / step,
        (b.diffusion_strength - a.diffusion_strength) / step,
        (b.deflection_strength - a.deflection_strength) / step};
    if (entry.absorption != 0 || entry.scattering != 0 || entry.diffusion != 0 || entry.deflection != 0)
      entries_[i].push_back(entry);
  }
  AnisotropyEntry anisotropy{parameter, {}};
  for (std::size_t i = 0; i < 3; ++i)
    anisotropy.slope[i] = (is.absorption_anisotropy()[i] - was.absorption_anisotropy()[i]) / step;
  if (anisotropy.slope != std::array<double, 3>{}) anisotropy_.push_back(anisotropy);
  return true;
}

void ScoreMap::scores(const PathScores& path, Eigen::VectorXd& result) const {
  result.setZero(parameters_);
  for (int layer = path.lowest; layer <= path.highest; ++layer) {
    const PathScores::Layer& score = path.layers[static_cast<std::size_t>(layer)];
    for (const Entry& entry : entries_[static_cast<std::size_t>(layer)])
      result(entry.parameter) += entry.absorption * score.absorption + entry.scattering * score.scattering +
                                 entry.diffusion * score.diffusion + entry.deflection * score.deflection;
  }
  for (const AnisotropyEntry& entry : anisotropy_)
    for (std::size_t i = 0; i < 3; ++i)
      result(entry.parameter) += entry.slope[i] * path.absorption_anisotropy[i];
}

}  // namespace floe
