// A bar on the terminal for work that takes longer than two seconds: stage, percent, time left.
#pragma once

#include <chrono>
#include <string>

#include "data/base/progress.h"

namespace floe {

// Draws on stderr, only when that is a terminal and `quiet` is not set. Removes the bar when it goes
// out of scope.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // For the work that reports; empty when nothing is drawn. Valid as long as the bar.
  Progress callback();

 private:
  using Clock = std::chrono::steady_clock;
  void update(double fraction, const std::string& stage);

  bool active_, drawn_ = false;
  Clock::time_point start_, last_drawn_;
};

// The line that the bar shows, `seconds` after the work began. At most `columns` wide.
std::string progress_line(double fraction, const std::string& stage, double seconds, int columns);

}  // namespace floe
