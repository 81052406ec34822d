// How far work is that takes longer than two seconds: a bar on the terminal, or a line a minute in the log of
// a batch job, each with stage, percent, time left.
#pragma once

#include <chrono>
#include <string>

#include "data/base/progress.h"

namespace floe {

// Writes to stderr unless `quiet` is set. Removes the bar when it goes out of scope; lines of a log stay.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // For the work that reports; empty when nothing is shown. Valid as long as the bar.
  Progress callback();

 private:
  using Clock = std::chrono::steady_clock;
  void update(double fraction, const std::string& stage);

  bool active_, on_terminal_, drawn_ = false;
  Clock::time_point start_, last_shown_;
};

// The line that the bar shows, `seconds` after the work began. At most `columns` wide.
std::string progress_line(double fraction, const std::string& stage, double seconds, int columns);
// The line that a log gets: without the bar, at its whole length.
std::string progress_log_line(double fraction, const std::string& stage, double seconds);

}  // namespace floe
