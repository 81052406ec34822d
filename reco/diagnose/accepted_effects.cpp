#include "reco/diagnose/accepted_effects.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "reco/diagnose/contest.h"
#include "reco/diagnose/score_test.h"
#include "reco/validation/two_sample_tests.h"

namespace floe {

namespace {

constexpr double still_there = 3;  // standard deviations

bool is_layered(const NamedEffect& effect) {
  return !effect.parameters.front().family.empty();
}

// As `floe.toml` has it: places that are no parameters of a fit, and values.
std::vector<EffectSetting> settings_of(const NamedEffect& effect) {
  std::vector<EffectSetting> settings;
  for (const auto& [name, value] : effect.suspect.place)
    if (name == "string" || name == "dom") settings.push_back({effect.suspect.effect, name, value});
  for (std::size_t i = 0; i < effect.values.size(); ++i) {
    const std::string& name = effect.parameters[i].name;
    settings.push_back({effect.suspect.effect, name.substr(name.find('.') + 1), effect.values[i]});
  }
  return settings;
}

}  // namespace

bool AcceptedEffects::has(const Suspect& suspect) const {
  return std::any_of(effects_.begin(), effects_.end(), [&](const NamedEffect& e) {
    const bool one_by_one = suspect.place.count("string") > 0;
    return e.suspect.effect == suspect.effect && (!one_by_one || e.suspect.place == suspect.place);
  });
}

std::vector<IceParameter> AcceptedEffects::parameters(const std::vector<IceParameter>& more) const {
  std::vector<IceParameter> all = parameters_;
  for (std::size_t i = 0; i < all.size(); ++i) all[i].begin_at(numbers_[i]);
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

void AcceptedEffects::add(NamedEffect effect, const IceFit& fit) {
  effects_.push_back(std::move(effect));
  take(fit);
}

std::vector<IceParameter> AcceptedEffects::parameters_by_layers(std::size_t effect, LayerFamily family,
                                                                const DepthRange& range) const {
  constexpr double least = 0.1;  // layers are factors, and begin at one that can grow
  // Of ln(strength): grains change slowly with depth. In SpiceBFR v2 layers of 110 m that follow one another
  // differ by 0.2 (rms), which is within the smoothness prior of half of this.
  constexpr double large = 0.5;
  // Of what is common to all of them. It was fitted with one strength for all, perhaps while something else
  // was missing, and six priors of half of a factor e about it would hold it there more firmly than light
  // does.
  constexpr double any_mean = 2;
  const std::size_t at = first_parameter(effect);
  std::vector<IceParameter> layers = layer_parameters(family, range);
  for (IceParameter& layer : layers) {
    layer.start = std::log(std::max(least, numbers_[at]));
    layer.scale = large;
    layer.prior = any_mean;
  }
  std::vector<IceParameter> all = parameters();
  const auto place = all.erase(all.begin() + static_cast<std::ptrdiff_t>(at));
  all.insert(place, layers.begin(), layers.end());
  return all;
}

double AcceptedEffects::spread_of_layers(std::size_t effect, const IceFit& fit) const {
  const std::size_t first = first_parameter(effect), count = layer_count(fit);
  const auto at = static_cast<Eigen::Index>(first), size = static_cast<Eigen::Index>(count);
  const Eigen::VectorXd weights =
      fit.covariance.block(at, at, size, size).ldlt().solve(Eigen::VectorXd::Ones(size));
  double mean = 0;
  for (Eigen::Index i = 0; i < size; ++i)
    mean += weights(i) / weights.sum() * fit.numbers[first + static_cast<std::size_t>(i)];
  return fit.distance(first, std::vector<double>(count, mean));
}

void AcceptedEffects::take_layers(std::size_t effect, const IceFit& fit) {
  const auto first = fit.parameters.begin() + static_cast<std::ptrdiff_t>(first_parameter(effect));
  effects_[effect].parameters.assign(first, first + static_cast<std::ptrdiff_t>(layer_count(fit)));
  take(fit);
}

// Of a fit with layers in the place of one parameter.
std::size_t AcceptedEffects::layer_count(const IceFit& fit) const {
  return fit.parameters.size() + 1 - parameters_.size();
}

std::optional<AcceptedEffects::Faded> AcceptedEffects::faded() const {
  for (std::size_t e = 0; e + 1 < effects_.size(); ++e) {
    if (effects_[e].significance < still_there) return Faded{e, effects_[e].significance};
  }
  return {};
}

void AcceptedEffects::drop(std::size_t effect) {
  const auto cut = [first = static_cast<std::ptrdiff_t>(first_parameter(effect)),
                    count = static_cast<std::ptrdiff_t>(effects_[effect].parameters.size())](auto& all) {
    all.erase(all.begin() + first, all.begin() + first + count);
  };
  cut(parameters_), cut(numbers_);
  effects_.erase(effects_.begin() + static_cast<std::ptrdiff_t>(effect));
}

EffectGroups AcceptedEffects::beside_ice() const {
  EffectGroups groups;
  for (const NamedEffect& effect : effects_)
    if (!is_layered(effect) && !changes_ice(settings_of(effect), base_))
      groups.push_back(settings_of(effect));
  return groups;
}

std::size_t AcceptedEffects::first_parameter(std::size_t effect) const {
  std::size_t first = 0;
  for (std::size_t e = 0; e < effect; ++e) first += effects_[e].parameters.size();
  return first;
}

void AcceptedEffects::take(const IceFit& fit) {
  parameters_ = fit.parameters;
  numbers_ = fit.numbers;
  std::size_t first = 0;
  for (NamedEffect& effect : effects_) {
    const std::size_t end = first + effect.parameters.size();
    effect.values.clear(), effect.errors.clear();
    for (std::size_t i = first; i < end; ++i) {
      effect.values.push_back(fit.value(i));
      effect.errors.push_back(fit.error(i));
    }
    const bool by_factors = is_layered(effect) && effect.parameters.front().logarithmic;
    if (by_factors) effect.mean = mean_of(effect, fit, first);
    // Where the base has no birefringence, its layers are factors of the published strength, of which that
    // would be 0: the mean says how far away it is.
    if (by_factors && !base_.ice->tables().configuration.birefringence)
      effect.significance = effect.mean->value / effect.mean->error;
    else
      effect.significance =
          sigmas_of(ln_chi_square_probability(chi_square_of(effect.parameters, fit, first, base_),
                                              static_cast<double>(effect.parameters.size())));
    for (std::size_t i = 0; i < effect.parameters.size(); ++i)
      if (is_place_of_band(effect.parameters[i])) {
        const std::string& name = effect.parameters[i].name;
        effect.suspect.place[name.substr(name.find('.') + 1)] = effect.values[i];
      }
    first = end;
  }
}

NamedEffect::Mean AcceptedEffects::mean_of(const NamedEffect& effect, const IceFit& fit, std::size_t first) {
  const auto at = static_cast<Eigen::Index>(first),
             count = static_cast<Eigen::Index>(effect.parameters.size());
  Eigen::VectorXd share(count);
  for (Eigen::Index i = 0; i < count; ++i)
    share(i) = effect.values[static_cast<std::size_t>(i)] / static_cast<double>(count);
  return {"strength", share.sum(), std::sqrt(share.dot(fit.covariance.block(at, at, count, count) * share))};
}

}  // namespace floe
