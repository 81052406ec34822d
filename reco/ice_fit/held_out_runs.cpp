#include "reco/ice_fit/held_out_runs.h"

#include <algorithm>
#include <numeric>

namespace floe {

HeldOutRuns::HeldOutRuns(const FlasherData& data, const Detector& detector, int folds)
    : folds_(folds), fold_of_run_(data.runs.size()) {
  std::vector<std::size_t> by_depth(data.runs.size());
  std::iota(by_depth.begin(), by_depth.end(), std::size_t{0});
  std::stable_sort(by_depth.begin(), by_depth.end(), [&](std::size_t a, std::size_t b) {
    return flasher_depth(data.runs[a], detector) < flasher_depth(data.runs[b], detector);
  });
  for (std::size_t i = 0; i < by_depth.size(); ++i)
    fold_of_run_[by_depth[i]] = static_cast<int>(i % static_cast<std::size_t>(folds));
}

FlasherData HeldOutRuns::rest(const FlasherData& data, int fold) const {
  FlasherData rest;
  for (std::size_t r = 0; r < data.runs.size(); ++r)
    if (!holds(r, fold)) rest.runs.push_back(data.runs[r]);
  return rest;
}

}  // namespace floe
