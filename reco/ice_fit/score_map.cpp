#include "reco/ice_fit/score_map.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "propagation/ice/ice_hash.h"
#include "propagation/ice/tilt.h"

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
  tables.tilt_lines = base.tilt_lines;
  tables.tilt_map = base.tilt_map;
  return tables;
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

// How the shift of layers differs at a height: `at_origin` [m] and in proportion to the distance along the
// direction of 1D tilt. None when it is no such plane within the detector.
struct Rise {
  double at_origin, slope;
};
std::optional<Rise> rise_between(const LayerTilt& was, const LayerTilt& is, double z) {
  constexpr double reach = 200, rounding = 1e-4;  // [m]
  const auto change = [&](double along, double across) {
    const double c = std::cos(tilt_lines_direction), s = std::sin(tilt_lines_direction);
    const auto x = static_cast<float>(along * c - across * s), y = static_cast<float>(along * s + across * c);
    const auto height = static_cast<float>(z);
    return static_cast<double>(is.shift(x, y, height)) - was.shift(x, y, height);
  };
  const Rise rise{change(0, 0), (change(reach, 0) - change(-reach, 0)) / (2 * reach)};
  for (const double across : {-reach, 0.0, reach})
    for (const double along : {-reach, 0.0, reach})
      if (std::abs(change(along, across) - rise.at_origin - rise.slope * along) >
          rounding + 0.01 * reach * std::abs(rise.slope))
        return {};
  return rise;
}

bool same_tilt(const IceTables& a, const IceTables& b) {
  const auto shifts = [](const auto& tilt) { return tilt ? &tilt->shifts : nullptr; };
  const auto same = [&](const auto& s, const auto& t) {
    return (!shifts(s) && !shifts(t)) || (shifts(s) && shifts(t) && *shifts(s) == *shifts(t));
  };
  return same(a.tilt_lines, b.tilt_lines) && same(a.tilt_map, b.tilt_map);
}

}  // namespace

ScoreMap::ScoreMap(const Model& model, double wavelength, int parameters)
    : model_(model),
      wavelength_(wavelength),
      parameters_(parameters),
      entries_(model.ice->layers().size()),
      rises_(static_cast<std::size_t>(parameters)) {}

bool ScoreMap::is_symmetric(int parameter) const {
  return !rises_[static_cast<std::size_t>(parameter)];
}

void ScoreMap::add_entry(std::size_t layer, const Entry& entry) {
  for (const double slope : {entry.absorption, entry.scattering, entry.diffusion, entry.deflection,
                             entry.tilted_absorption, entry.tilted_scattering})
    if (slope != 0) {
      entries_[layer].push_back(entry);
      return;
    }
}

// Where layers shift up by d, a place is in the ice that was d below: coefficients change by -d times their
// gradient. Layers meet in jumps; the path on either side of one stands for the path at it.
bool ScoreMap::add_rise(int parameter, const Model& changed, double step) {
  const IceModel& ice = *model_.ice;
  const int last = static_cast<int>(entries_.size()) - 1;
  std::vector<Entry> entries;
  for (int layer = 0; layer <= last; ++layer) {
    const double z = ice.z_bottom() + (layer + 0.5) * ice.layer_step();
    const auto rise = rise_between(ice.tilt(), changed.ice->tilt(), z);
    if (!rise) return false;
    const int below = std::max(0, layer - 1), above = std::min(last, layer + 1);
    const double across = 2 * ice.layer_step() * step;
    const double absorption =
        (ice.absorption(above, wavelength_) - ice.absorption(below, wavelength_)) / across;
    const double scattering =
        (ice.geometric_scattering(above, wavelength_) - ice.geometric_scattering(below, wavelength_)) /
        across;
    entries.push_back({.parameter = parameter,
                       .absorption = -rise->at_origin * absorption,
                       .scattering = -rise->at_origin * scattering,
                       .tilted_absorption = -rise->slope * absorption,
                       .tilted_scattering = -rise->slope * scattering});
  }
  for (std::size_t layer = 0; layer < entries_.size(); ++layer) add_entry(layer, entries[layer]);
  rises_[static_cast<std::size_t>(parameter)] = 1;
  return true;
}

bool ScoreMap::add(int parameter, const Model& changed, double step) {
  const IceModel &was = *model_.ice, &is = *changed.ice;
  if (ice_hash(without_weightable(is.tables(), was.tables())) != was.hash()) return false;
  ModelDifference others = difference(model_, changed);
  others.ice = false;
  if (others != ModelDifference{} || !weightable_birefringence(was, is)) return false;
  if (!same_tilt(was.tables(), is.tables()) && !add_rise(parameter, changed, step)) return false;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const int layer = static_cast<int>(i);
    const IceLayer &a = was.layers()[i], &b = is.layers()[i];
    add_entry(
        i, {.parameter = parameter,
            .absorption = (is.absorption(layer, wavelength_) - was.absorption(layer, wavelength_)) / step,
            .scattering =
                (is.geometric_scattering(layer, wavelength_) - was.geometric_scattering(layer, wavelength_)) /
                step,
            .diffusion = (b.diffusion_strength - a.diffusion_strength) / step,
            .deflection = (b.deflection_strength - a.deflection_strength) / step});
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
                                 entry.diffusion * score.diffusion + entry.deflection * score.deflection +
                                 entry.tilted_absorption * score.tilted_absorption +
                                 entry.tilted_scattering * score.tilted_scattering;
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
