#include "reco/diagnose/held_out_gaps.h"

namespace floe {

namespace {

double gap(const ModelJudge::Fit& fit) {
  return 2 * (fit.measured.neg_llh - fit.expected);
}

}  // namespace

std::vector<ModelJudge::Fit> fits_of(const Model& model, const FlasherData& data, const ModelJudge& judge) {
  std::vector<ModelJudge::Fit> fits;
  for (std::size_t r = 0; r < data.runs.size(); ++r) fits.push_back(judge.judge(model, r));
  return fits;
}

std::vector<RunGap> gaps_of(const FlasherData& data, const std::vector<ModelJudge::Fit>& fits) {
  std::vector<RunGap> gaps;
  for (std::size_t r = 0; r < fits.size(); ++r)
    gaps.push_back({data.runs[r].name, gap(fits[r]), gap(fits[r])});
  return gaps;
}

void hold_out(const HeldOutRuns& held_out, const ModelJudge& judge,
              const std::function<Model(int fold)>& model_without, std::vector<RunGap>& gaps) {
  for (int fold = 0; fold < held_out.folds(); ++fold) {
    const Model model = model_without(fold);
    for (std::size_t r = 0; r < gaps.size(); ++r)
      if (held_out.holds(r, fold)) gaps[r].after = gap(judge.judge(model, r));
  }
}

}  // namespace floe
