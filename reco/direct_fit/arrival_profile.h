// How the light of one module is spread over time, as a smooth cumulative curve.
#pragma once

#include <vector>

namespace floe {

// Times are binned and the density is interpolated linearly between bin centres, so that the cumulative
// curve has a continuous slope, which fits of the time need.
class ArrivalProfile {
 public:
  ArrivalProfile() = default;
  // Cells of `step` ns cover [begin, end]; what lies outside is counted in the outermost cells.
  ArrivalProfile(double begin, double end, double step);
  void add(double time, double weight);
  void add(const ArrivalProfile& other, double factor);  // of the same begin, end and step
  void close();                                          // after the last add()

  // Weight before `time`, and its derivative [1/ns]. Any time, also infinite.
  double cumulative(double time) const;
  double density(double time) const;
  double total() const { return before_.empty() ? 0 : before_.back(); }

 private:
  double begin_ = 0, step_ = 1;
  std::vector<double> weight_;  // of each cell
  std::vector<double> before_;  // weight before each cell's centre; the last: all
};

}  // namespace floe
