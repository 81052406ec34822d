#include "reco/ice_fit/held_out_runs.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace floe {

int flasher_count(const FlasherData& data) {
  std::set<ModuleId> flashers;
  for (const RunData& run : data.runs) flashers.insert(run.run.module);
  return static_cast<int>(flashers.size());
}

HeldOutRuns::HeldOutRuns(const FlasherData& data, const Detector& detector, int folds)
    : folds_(folds), fold_of_run_(data.runs.size()) {
  std::vector<std::size_t> by_depth(data.runs.size());
  std::iota(by_depth.begin(), by_depth.end(), std::size_t{0});
  std::stable_sort(by_depth.begin(), by_depth.end(), [&](std::size_t a, std::size_t b) {
    return flasher_depth(data.runs[a], detector) < flasher_depth(data.runs[b], detector);
  });
  std::map<ModuleId, int> fold_of;
  for (const std::size_t r : by_depth) {
    const int next = static_cast<int>(fold_of.size()) % folds;
    fold_of_run_[r] = fold_of.try_emplace(data.runs[r].run.module, next).first->second;
  }
}

std::vector<std::vector<char>> HeldOutRuns::left_out() const {
  std::vector<std::vector<char>> left_out(static_cast<std::size_t>(folds_),
                                          std::vector<char>(fold_of_run_.size()));
  for (std::size_t r = 0; r < fold_of_run_.size(); ++r)
    left_out[static_cast<std::size_t>(fold_of_run_[r])][r] = 1;
  return left_out;
}

FlasherData HeldOutRuns::rest(const FlasherData& data, int fold) const {
  FlasherData rest;
  for (std::size_t r = 0; r < data.runs.size(); ++r)
    if (!holds(r, fold)) rest.runs.push_back(data.runs[r]);
  return rest;
}

}  // namespace floe
