#include "reco/direct_fit/arrival_profile.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace floe {

// An empty cell at either end lets the density go to 0 inside the covered range.
ArrivalProfile::ArrivalProfile(double begin, double end, double step)
    : begin_(begin - step),
      step_(step),
      weight_(static_cast<std::size_t>(std::ceil((end - begin) / step)) + 2, 0.0) {}

void ArrivalProfile::add(double time, double weight) {
  const double place = std::clamp(std::floor((time - begin_) / step_), 1.0, double(weight_.size()) - 2);
  weight_[static_cast<std::size_t>(place)] += weight;
}

void ArrivalProfile::add(const ArrivalProfile& other, double factor) {
  assert(weight_.size() == other.weight_.size() && begin_ == other.begin_ && step_ == other.step_);
  for (std::size_t i = 0; i < weight_.size(); ++i) weight_[i] += factor * other.weight_[i];
}

// Between two centres the density is linear: the weight there is the mean of the two cells.
void ArrivalProfile::close() {
  before_.assign(weight_.size(), 0);
  for (std::size_t i = 1; i < weight_.size(); ++i)
    before_[i] = before_[i - 1] + 0.5 * (weight_[i - 1] + weight_[i]);
}

double ArrivalProfile::cumulative(double time) const {
  const double place = (time - begin_) / step_ - 0.5;  // in cells, from the first centre
  if (!(place > 0)) return 0;
  if (place >= double(weight_.size() - 1)) return total();
  const auto cell = static_cast<std::size_t>(place);
  const double x = place - double(cell);
  return before_[cell] + x * (weight_[cell] + 0.5 * x * (weight_[cell + 1] - weight_[cell]));
}

double ArrivalProfile::density(double time) const {
  const double place = (time - begin_) / step_ - 0.5;
  if (!(place > 0) || place >= double(weight_.size() - 1)) return 0;
  const auto cell = static_cast<std::size_t>(place);
  const double x = place - double(cell);
  return (weight_[cell] + x * (weight_[cell + 1] - weight_[cell])) / step_;
}

}  // namespace floe
