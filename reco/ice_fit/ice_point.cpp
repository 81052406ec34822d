#include "reco/ice_fit/ice_point.h"

#include <algorithm>

#include "data/base/error.h"
#include "reco/ice_fit/noise_slopes.h"
#include "reco/ice_fit/run_likelihood.h"

namespace floe {

namespace {

constexpr double weight_step = 1e-3;  // in the parameter's scale, for weights, which are exact
constexpr double clock_step = 4;      // [ns] each way; light rises more slowly after some scattering

}  // namespace

double PairPlan::share(double hits) const {
  return std::max(light, std::min(1.0, least_hits / std::max(1.0, hits)));
}

IcePoint::IcePoint(const Model& base, const std::vector<IceParameter>& parameters,
                   std::vector<double> numbers, double wavelength, double turns_from)
    : base_(base),
      parameters_(parameters),
      numbers_(std::move(numbers)),
      model_(with_parameters(base, parameters, numbers_)),
      map_(model_, wavelength, static_cast<int>(parameters.size())),
      of_modules_(parameters.size()) {
  for (std::size_t p = 0; p < parameters_.size(); ++p) {
    const double size = weight_step * parameters_[p].scale;
    const bool downwards = numbers_[p] > 0 && numbers_[p] - size >= parameters_[p].low;
    const double step = downwards ? -size : size;
    const Model changed = moved(p, step);
    if (changed.noise_rate != model_.noise_rate) {
      of_noise_.push_back({p, (changed.noise_rate - model_.noise_rate) / step});
      continue;
    }
    const bool of_turns = parameters_[p].effect && parameters_[p].effect->effect == "birefringence";
    const bool by_weights = !of_turns || numbers_[p] >= turns_from;
    if (by_weights && map_.add(static_cast<int>(p), changed, step)) continue;
    of_modules_[p] = ModuleChange::between(model_, changed);
    if (of_modules_[p] && of_modules_[p]->only_clocks) {
      std::vector<double> later = of_modules_[p]->later;
      for (double& time : later) time /= step;
      of_clocks_.push_back({p, std::move(later)});
    } else if (auto change = AcceptanceChange::between(model_, changed))
      of_acceptance_.push_back({p, std::move(*change), step});
    else
      pairs_.push_back(p);
  }
}

Model IcePoint::moved(std::size_t parameter, double step) const {
  std::vector<double> moved = numbers_;
  moved[parameter] = parameters_[parameter].within(numbers_[parameter] + step);
  return with_parameters(base_, parameters_, moved);
}

Model IcePoint::moved_towards(std::size_t parameter, double& step) const {
  constexpr int most_halvings = 5;
  for (int i = 0;; ++i) {
    try {
      return moved(parameter, step);
    } catch (const InputError&) {
      if (i == most_halvings) throw;
      step /= 2;
    }
  }
}

IcePoint::Light IcePoint::light(const RunRequest& request, const SimulatedRun& simulated, const RunBins& bins,
                                double time_zero, const PairPlan& plan) const {
  Light result;
  result.light = light_with_slopes(model_, request, simulated, bins, map_, time_zero);
  for (const OfAcceptance& slope : of_acceptance_) add_acceptance(simulated, bins, slope, result.light);
  for (const OfNoise& slope : of_noise_) add_noise(request, bins, slope, result.light);
  for (const OfClocks& slope : of_clocks_) add_clocks(simulated, bins, slope, result.light);
  for (const std::size_t p : pairs_)
    result.propagated += add_pair(request, bins, time_zero, plan, p, result.light);
  leave_out_untouched(request, bins, result.light);
  return result;
}

void IcePoint::leave_out_untouched(const RunRequest& request, const RunBins& bins, RunLight& light) const {
  const std::size_t flasher = model_.detector->index_of(request.run.module);
  for (std::size_t p = 0; p < of_modules_.size(); ++p) {
    if (!of_modules_[p] || of_modules_[p]->moved[flasher]) continue;
    for (const RunBins::Receiver& receiver : bins.receivers()) {
      if (of_modules_[p]->touched[receiver.module]) continue;
      for (LightFold& fold : light.folds)
        fold.dwell.col(static_cast<Eigen::Index>(p)).segment(receiver.first, receiver.bins()).setZero();
    }
  }
}

// The hits themselves, earlier and later.
void IcePoint::add_clocks(const SimulatedRun& simulated, const RunBins& bins, const OfClocks& slope,
                          RunLight& light) const {
  const auto column = static_cast<Eigen::Index>(slope.parameter);
  light.symmetric[slope.parameter] = 0;
  for (LightFold& fold : light.folds) fold.dwell.col(column) = fold.counts;
  for (const SimulatedHit& hit : simulated.hits) {
    const double later = slope.later[hit.module];
    if (later == 0) continue;
    const int after = bins.bin(hit.module, hit.time + clock_step),
              before = bins.bin(hit.module, hit.time - clock_step);
    if (after == before) continue;  // also: no receiver
    const double change = later / (2 * clock_step);
    LightFold& fold = light.folds[hit.photon & 1];
    fold.slopes(after, column) += change;
    fold.slopes(before, column) -= change;
    for (const int bin : {after, before}) fold.slope_squares(bin, column) += change * change;
  }
}

// Exactly known in counts; relative to the light of a half it has that half's noise, as other slopes have.
void IcePoint::add_noise(const RunRequest& request, const RunBins& bins, const OfNoise& slope,
                         RunLight& light) const {
  NoiseWindow window = request.noise;
  window.readouts *= light.photons;
  const auto column = static_cast<Eigen::Index>(slope.parameter);
  light.symmetric[slope.parameter] = 0;
  for (LightFold& fold : light.folds) {
    fold.dwell.col(column) = fold.counts;
    fold.slopes.col(column) = slope.slope * noise_of_bins(bins, window);
  }
}

void IcePoint::add_acceptance(const SimulatedRun& simulated, const RunBins& bins, const OfAcceptance& slope,
                              RunLight& light) const {
  const auto column = static_cast<Eigen::Index>(slope.parameter);
  light.symmetric[slope.parameter] = 0;
  for (LightFold& fold : light.folds) fold.dwell.col(column) = fold.counts;
  for (const SimulatedHit& hit : simulated.hits) {
    const int bin = bins.bin(hit.module, hit.time);
    if (bin < 0) continue;
    const double score = slope.change.ln_ratio(hit) / slope.step;
    LightFold& fold = light.folds[hit.photon & 1];
    fold.slopes(bin, column) += score;
    fold.slope_squares(bin, column) += score * score;
  }
}

std::uint64_t IcePoint::add_pair(const RunRequest& request, const RunBins& bins, double time_zero,
                                 const PairPlan& plan, std::size_t parameter, RunLight& light) const {
  const IceParameter& p = parameters_[parameter];
  const auto column = static_cast<Eigen::Index>(parameter);
  const double number = numbers_[parameter], reach = plan.reach * p.scale;
  // It acts all over the ice: light dwells in it wherever it goes.
  for (LightFold& fold : light.folds) fold.dwell.col(column) = fold.counts;
  light.symmetric[parameter] = 0;
  light.independent[parameter] = plan.stream != 0;
  double down = std::max(-reach, p.low - number), up = std::min(reach, p.high - number);
  const Model below = moved_towards(parameter, down), above = moved_towards(parameter, up);
  RunRequest less = request;
  const double hits = light.folds[0].counts.sum() + light.folds[1].counts.sum();
  const double share = plan.share(hits) * (down == 0 || up == 0 ? plan.one_sided : 1);
  less.photons *= share;
  less.stream += plan.stream;
  std::uint64_t propagated = 0;
  Eigen::VectorXd own[2] = {Eigen::VectorXd::Zero(bins.size()), Eigen::VectorXd::Zero(bins.size())};
  for (const double step : {down, up}) {
    SimulatedRun simulated = simulate_run(step == up ? above : below, less);
    delay(simulated, time_zero);
    propagated += simulated.propagated;
    const RunLight counted = count_light(simulated, bins, less.photons, 0);
    const double factor = (step == up ? 1 : -1) / ((up - down) * share);
    for (int fold = 0; fold < 2; ++fold) {
      own[fold] += counted.folds[fold].counts / (2 * share);
      light.folds[fold].slopes.col(column) += factor * counted.folds[fold].counts;
      light.folds[fold].slope_squares.col(column) += factor * factor * counted.folds[fold].counts;
    }
  }
  // Slopes that are independent of the run's counts are relative to the pair's own.
  if (plan.stream != 0)
    for (int fold = 0; fold < 2; ++fold) {
      const Eigen::ArrayXd ratio = light.folds[fold].counts.array() / own[fold].array().max(1);
      light.folds[fold].slopes.col(column).array() *= ratio;
      light.folds[fold].slope_squares.col(column).array() *= ratio.square();
    }
  return propagated;
}

}  // namespace floe
