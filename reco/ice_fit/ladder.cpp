#include "reco/ice_fit/ladder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "data/base/error.h"
#include "reco/ice_fit/anisotropies.h"
#include "reco/ice_fit/held_out_runs.h"
#include "reco/ice_fit/model_judge.h"
#include "reco/ice_fit/run_plan.h"

namespace floe {

namespace {

constexpr int rounds_of_folds = 3;  // they start where the fit to all runs ended
constexpr std::uint64_t first_stream = std::uint64_t{1} << 59, held_out_stream = std::uint64_t{1} << 61;

std::vector<IceParameter> parameters_of(const AnisotropyDescription& plan, const Model& base) {
  std::vector<IceParameter> parameters;
  for (const char* effect : {"absorption-scale", "scattering-scale"})
    parameters.push_back(effect_parameter(effect, base));
  for (const std::string_view effect : plan.effects) {
    parameters.push_back(effect_parameter(effect, base));
    // Birefringence has no slope where there is none.
    if (effect == "birefringence") parameters.back().start = 1;
  }
  return parameters;
}

class Climb {
 public:
  Climb(const Model& base, const FlasherData& data, const LadderOptions& options, const Progress& progress)
      : base_(base), data_(data), options_(options), progress_(progress) {}

  Ladder run() {
    plan_measure();
    Ladder ladder;
    for (const RunData& run : data_.runs) ladder.runs.push_back(run.name);
    ladder.left_out = data_.left_out;
    const Model bare = with_anisotropy_of(base_, {});
    for (const AnisotropyDescription& plan : anisotropy_descriptions())
      ladder.rungs.push_back(rung(plan, bare));
    return ladder;
  }

 private:
  RunRequest request(std::size_t r, std::uint64_t stream, double photons) const {
    return request_of(data_.runs[r], options_.fit, photons, stream + r);
  }

  // Held-out runs are compared in bins of the base's light, the same for every rung.
  void plan_measure() {
    FirstLook look = look_first(
        base_, [this](std::size_t r, double photons) { return request(r, first_stream, photons); }, data_);
    leave_out_dark_runs(data_, look);
    judge_.emplace(base_, data_, look, options_.fit, held_out_stream);
  }

  IceFit fit(const Model& bare, const FlasherData& data, const std::vector<IceParameter>& parameters,
             int most_rounds) {
    IceFitOptions options = options_.fit;
    options.most_rounds = std::min(options.most_rounds, most_rounds);
    const double done =
        static_cast<double>(fits_++) /
        static_cast<double>(anisotropy_descriptions().size() * static_cast<std::size_t>(options_.folds + 1));
    const double share = 1 / static_cast<double>(anisotropy_descriptions().size() *
                                                 static_cast<std::size_t>(options_.folds + 1));
    try {
      return fit_ice(bare, data, parameters, options, [&](double fraction, const std::string& stage) {
        if (progress_) progress_(done + share * fraction, name_ + ": " + stage);
      });
    } catch (const InputError& error) {
      throw InputError(
          fmt::format("the fit of {} leads to no physical ice; steps are less noisy with more "
                      "light (--light). {}",
                      name_, error.what()));
    }
  }

  LadderRung rung(const AnisotropyDescription& plan, const Model& bare) {
    name_ = plan.name;
    LadderRung rung;
    rung.name = plan.name;
    std::vector<IceParameter> parameters = parameters_of(plan, bare);
    rung.fit = fit(bare, data_, parameters, options_.fit.most_rounds);
    for (std::size_t i = 0; i < parameters.size(); ++i) parameters[i].begin_at(rung.fit.numbers[i]);
    rung.held_out.assign(data_.runs.size(), 0);
    const HeldOutRuns held_out(data_, *base_.detector, options_.folds);
    for (int fold = 0; fold < options_.folds; ++fold) {
      const IceFit blind = fit(bare, held_out.rest(data_, fold), parameters, rounds_of_folds);
      const Model model = with_parameters(bare, parameters, blind.numbers);
      for (std::size_t r = 0; r < data_.runs.size(); ++r)
        if (held_out.holds(r, fold)) rung.held_out[r] = judge_->measure(model, r).neg_llh;
    }
    return rung;
  }

  const Model& base_;
  FlasherData data_;
  const LadderOptions& options_;
  const Progress& progress_;
  std::optional<ModelJudge> judge_;
  std::string name_;
  std::size_t fits_ = 0;
};

}  // namespace

double LadderRung::total() const {
  return std::accumulate(held_out.begin(), held_out.end(), 0.0);
}

std::size_t Ladder::best() const {
  const auto least =
      std::min_element(rungs.begin(), rungs.end(),
                       [](const LadderRung& a, const LadderRung& b) { return a.total() < b.total(); });
  return static_cast<std::size_t>(least - rungs.begin());
}

Ladder::Gap Ladder::gap(std::size_t rung) const {
  const std::vector<double>&worse = rungs[rung].held_out, &better = rungs[best()].held_out;
  const auto n = static_cast<double>(worse.size());
  Gap gap{rungs[rung].total() - rungs[best()].total(), 0};
  double squares = 0;
  for (std::size_t r = 0; r < worse.size(); ++r) {
    const double off = worse[r] - better[r] - gap.value / n;
    squares += off * off;
  }
  gap.error = std::sqrt(squares * n / std::max(1.0, n - 1));
  return gap;
}

Ladder climb_ladder(const Model& base, const FlasherData& data, const LadderOptions& options,
                    const Progress& progress) {
  if (data.runs.size() < 2) throw UsageError("a ladder holds runs out: it needs at least two flasher runs");
  if (options.folds < 2 || options.folds > flasher_count(data))
    throw UsageError(fmt::format("found {} folds; expected 2 to {}, the number of flashers", options.folds,
                                 flasher_count(data)));
  return Climb(base, data, options, progress).run();
}

}  // namespace floe
