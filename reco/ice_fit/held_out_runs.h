// Runs that are held out in turn: each is judged by a model that was fitted to others.
#pragma once

#include <vector>

#include "geometry/detector.h"
#include "reco/ice_fit/run_data.h"

namespace floe {

// Modules that flash in these runs: several runs may be of one.
int flasher_count(const FlasherData& data);

// Dealt out by the depth of their flashers: ice is made of layers, and a run can only be told by what others
// say of its own depths. Runs of one flasher stay together.
class HeldOutRuns {
 public:
  // `folds`: 1 to the number of flashers; all but the last few have as many.
  HeldOutRuns(const FlasherData& data, const Detector& detector, int folds);

  int folds() const { return folds_; }
  bool holds(std::size_t run, int fold) const { return fold_of_run_[run] == fold; }
  // By fold, by run: whether it is held out.
  std::vector<std::vector<char>> left_out() const;
  // The other folds' runs of the same data.
  FlasherData rest(const FlasherData& data, int fold) const;

 private:
  int folds_;
  std::vector<int> fold_of_run_;
};

}  // namespace floe
