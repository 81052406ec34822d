#include "reco/diagnose/held_out_gaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "data/base/error.h"
#include "reco/diagnose/goodness.h"
#include "reco/diagnose/suspects.h"

namespace floe {

namespace {

double gap(const ModelJudge::Fit& fit) {
  return 2 * (fit.measured.neg_llh - fit.expected);
}

// What only the runs that are held out tell of is not known: a prior, as wide as a large change, leaves it
// where it changes nothing, and the place of a band where the fit to all runs has it. Layers have priors of
// their own; of birefringence that the base lacks, about the one strength that was fitted before them.
void expect_no_change(IceParameter& p, const Model& base) {
  if (!p.family.empty()) {
    if (base.ice->tables().configuration.birefringence) p.prior_centre = null_number(p, base);
    return;
  }
  p.prior = p.prior > 0 ? std::min(p.prior, p.scale) : p.scale;
  p.prior_centre = is_place_of_band(p) ? p.start : null_number(p, base);
}

}  // namespace

double Gaps::total() const {
  return std::accumulate(of_runs.begin(), of_runs.end(), 0.0);
}

HeldOutGaps::HeldOutGaps(const Model& base, const FlasherData& data, const FirstLook& look,
                         const RunSettings& settings, std::uint64_t stream, int folds, const EffectFits& fits)
    : base_(base),
      data_(data),
      fits_(fits),
      judge_(base, data, look, settings, stream),
      held_out_(data, *base.detector, folds),
      fits_of_base_(judge_.judge_all(base)),
      right_of_base_(right_fit(fits_of_base_)) {
  for (const ModelJudge::Fit& fit : fits_of_base_) of_base_.of_runs.push_back(gap(fit));
}

Gaps HeldOutGaps::of(const AcceptedEffects& effects, Stages& stages, double from, double to) const {
  stages.begin(from, to, "holding runs out");
  const int folds = held_out_.folds();
  const std::vector<GroupModel> groups =
      folds == 1 ? std::vector<GroupModel>{{effects.model()}} : fitted_without(effects);
  Gaps gaps{std::vector<double>(data_.runs.size())};
  for (int fold = 0; fold < folds; ++fold) {
    const GroupModel& group = groups[static_cast<std::size_t>(fold)];
    gaps.unknown += group.unknown;
    if (!group.is_fitted)
      gaps.remarks.push_back(fmt::format(
          "Without the runs of group {} of {} the others fit to no physical ice: the base judges these runs",
          fold + 1, folds));
    for (std::size_t r = 0; r < gaps.of_runs.size(); ++r)
      if (held_out_.holds(r, fold)) gaps.of_runs[r] = gap(judge_.judge(group.model, r));
  }
  return gaps;
}

// The base where the other runs lead to no ice that can be: they tell nothing of this then.
std::vector<HeldOutGaps::GroupModel> HeldOutGaps::fitted_without(const AcceptedEffects& effects) const {
  std::vector<IceParameter> parameters = effects.parameters();
  for (IceParameter& p : parameters) expect_no_change(p, base_);
  std::vector<FitWithout> fits;
  try {
    fits = fits_.fit_without(held_out_.left_out(), parameters);
  } catch (const InputError&) {
    fits.resize(static_cast<std::size_t>(held_out_.folds()));  // no physical ice on the way of any of them
  }
  std::vector<GroupModel> groups;
  for (const FitWithout& fit : fits)
    groups.push_back(fit.numbers ? GroupModel{with_parameters(base_, parameters, *fit.numbers), fit.unknown}
                                 : GroupModel{.model = base_, .is_fitted = false});
  return groups;
}

double HeldOutGaps::p_of_base(double allowed) const {
  return probability_of(neg_llh_of(fits_of_base_) - allowed, right_of_base_);
}

double HeldOutGaps::p_of(const Model& model, double allowed) const {
  const std::vector<ModelJudge::Fit> fits = judge_.judge_all(model);
  return probability_of(neg_llh_of(fits) - allowed, right_fit(fits));
}

}  // namespace floe
