// Which part of a diagnosis is going on: its parts tell how far they are, and this how far the whole is.
#pragma once

#include <cmath>
#include <string>

#include "data/base/progress.h"

namespace floe {

class Stages {
 public:
  // Keeps a reference.
  explicit Stages(const Progress& progress) : progress_(progress) {}

  // What comes takes the whole from one fraction to another.
  void begin(double from, double to, const std::string& text) {
    from_ = from, to_ = to, text_ = text;
    if (progress_) progress_(from, text);
  }
  // The same in fractions of a step, counted from 0. Nobody knows how many there will be: each takes three
  // fifths of what is left.
  void begin_in_step(int step, double from, double to, const std::string& text) {
    const auto at = [](int steps) { return 0.03 + 0.87 * (1 - std::pow(0.4, steps)); };
    const double begin_of_step = at(step), length = at(step + 1) - begin_of_step;
    begin(begin_of_step + length * from, begin_of_step + length * to, text);
  }
  double from() const { return from_; }
  double to() const { return to_; }

  // Of this stage. Holds a reference to this.
  Progress part() const {
    return [this](double fraction, const std::string& what) {
      if (progress_) progress_(from_ + (to_ - from_) * fraction, text_ + ": " + what);
    };
  }

 private:
  const Progress& progress_;
  double from_ = 0, to_ = 1;
  std::string text_;
};

}  // namespace floe
