#include "reco/diagnose/held_out_gaps.h"

namespace floe {

namespace {

double gap(const ModelJudge& judge, const Model& model, std::size_t run) {
  const ModelJudge::Fit fit = judge.judge(model, run);
  return 2 * (fit.measured.neg_llh - fit.expected);
}

}  // namespace

std::vector<RunGap> gaps_of(const Model& base, const FlasherData& data, const ModelJudge& judge) {
  std::vector<RunGap> gaps;
  for (std::size_t r = 0; r < data.runs.size(); ++r) {
    const double before = gap(judge, base, r);
    gaps.push_back({data.runs[r].name, before, before});
  }
  return gaps;
}

void hold_out(const HeldOutRuns& held_out, const ModelJudge& judge,
              const std::function<Model(int fold)>& model_without, std::vector<RunGap>& gaps) {
  for (int fold = 0; fold < held_out.folds(); ++fold) {
    const Model model = model_without(fold);
    for (std::size_t r = 0; r < gaps.size(); ++r)
      if (held_out.holds(r, fold)) gaps[r].after = gap(judge, model, r);
  }
}

}  // namespace floe
