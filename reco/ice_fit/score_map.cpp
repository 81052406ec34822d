#include "reco/ice_fit/score_map.h"

#include <algorithm>

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

bool same(const AngularAcceptance& a, const AngularAcceptance& b) {
  return a.is_surface() == b.is_surface() && a.maximum() == b.maximum() && a.cut() == b.cut() &&
         a.coefficients() == b.coefficients();
}
bool same(const WavelengthSpectrum& a, const WavelengthSpectrum& b) {
  return std::ranges::equal(a.points(), b.points(), [](const auto& p, const auto& q) {
    return p.cumulative == q.cumulative && p.wavelength == q.wavelength;
  });
}
bool same(const std::optional<HighQeRatio>& a, const std::optional<HighQeRatio>& b) {
  if (!a || !b) return !a && !b;
  return std::ranges::equal(a->points(), b->points(), [](const auto& p, const auto& q) {
    return p.wavelength == q.wavelength && p.ratio == q.ratio;
  });
}

// Modules, how they accept light, and sources: nothing that paths through the ice tell of.
bool same_surroundings(const Model& a, const Model& b) {
  return a.detector->hash() == b.detector->hash() && a.sources == b.sources &&
         a.acceptance.overall_efficiency == b.acceptance.overall_efficiency &&
         same(a.acceptance.angular, b.acceptance.angular) &&
         same(a.acceptance.spectrum, b.acceptance.spectrum) &&
         same(a.acceptance.high_qe, b.acceptance.high_qe);
}

// Steps without width have no density: there more diffusion or deflection is not a matter of weights.
bool weightable_birefringence(const IceModel& was, const IceModel& is) {
  const auto& numbers = was.birefringence();
  // Strengths that turn nothing only say how much is taken out of scattering.
  if (!numbers || (!numbers->diffusion && !numbers->deflection)) return true;
  for (std::size_t i = 0; i < was.layers().size(); ++i) {
    const IceLayer &a = was.layers()[i], &b = is.layers()[i];
    const bool same =
        a.diffusion_strength == b.diffusion_strength && a.deflection_strength == b.deflection_strength;
    if (!same && !(numbers->diffusion && a.diffusion_strength > 0)) return false;
  }
  return true;
}

}  // namespace

ScoreMap::ScoreMap(const Model& model, double wavelength, int parameters)
    : model_(model), wavelength_(wavelength), parameters_(parameters), entries_(model.ice->layers().size()) {}

bool ScoreMap::add(int parameter, const Model& changed, double step) {
  const IceModel &was = *model_.ice, &is = *changed.ice;
  if (ice_hash(without_weightable(is.tables(), was.tables())) != was.hash()) return false;
  if (!same_surroundings(model_, changed) || !weightable_birefringence(was, is)) return false;
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

void ScoreMap::scores(const PathScores& path, Eigen::VectorXd& scores, Eigen::VectorXd& dwell) const {
  scores.setZero(parameters_);
  dwell.setZero(parameters_);
  double length = 0;
  for (int layer = path.lowest; layer <= path.highest; ++layer) {
    const PathScores::Layer& score = path.layers[static_cast<std::size_t>(layer)];
    length += score.length;
    for (const Entry& entry : entries_[static_cast<std::size_t>(layer)]) {
      scores(entry.parameter) += entry.absorption * score.absorption + entry.scattering * score.scattering +
                                 entry.diffusion * score.diffusion + entry.deflection * score.deflection;
      dwell(entry.parameter) += score.length;
    }
  }
  for (const AnisotropyEntry& entry : anisotropy_) {
    dwell(entry.parameter) = length;
    for (std::size_t i = 0; i < 3; ++i)
      scores(entry.parameter) += entry.slope[i] * path.absorption_anisotropy[i];
  }
}

}  // namespace floe
