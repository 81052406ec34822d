#include "apps/progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace floe {

namespace {

constexpr double quiet_seconds = 2;      // shorter work shows no bar
constexpr double seconds_a_frame = 0.1;  // fast enough to look alive, slow enough to cost nothing
constexpr double seconds_a_log_line = 60;

int terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string duration(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole % 3600 / 60);
}

double share_of(double fraction) {
  return std::clamp(std::isfinite(fraction) ? fraction : 0.0, 0.0, 1.0);
}

std::string percent_and_stage(double fraction, const std::string& stage, double seconds) {
  // Too early a guess is worse than none.
  const std::string left = fraction > 0.02 ? duration(seconds * (1 - fraction) / fraction) + " left  " : "";
  return fmt::format("{:3.0f}%  {}{}", 100 * fraction, left, stage);
}

}  // namespace

std::string progress_line(double fraction, const std::string& stage, double seconds, int columns) {
  constexpr int width = 24;
  fraction = share_of(fraction);
  const int full = static_cast<int>(fraction * width);
  const std::string line = fmt::format("[{}{}] {}", std::string(full, '='), std::string(width - full, ' '),
                                       percent_and_stage(fraction, stage, seconds));
  return line.substr(0, std::max(0, columns - 1));
}

std::string progress_log_line(double fraction, const std::string& stage, double seconds) {
  return percent_and_stage(share_of(fraction), stage, seconds);
}

ProgressBar::ProgressBar(bool quiet)
    : active_(!quiet), on_terminal_(isatty(STDERR_FILENO) == 1), start_(Clock::now()), last_shown_(start_) {}

ProgressBar::~ProgressBar() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
}

Progress ProgressBar::callback() {
  if (!active_) return {};
  return [this](double fraction, const std::string& stage) { update(fraction, stage); };
}

void ProgressBar::update(double fraction, const std::string& stage) {
  const auto now = Clock::now();
  const auto since = [now](Clock::time_point then) {
    return std::chrono::duration<double>(now - then).count();
  };
  if (since(start_) < quiet_seconds ||
      since(last_shown_) < (on_terminal_ ? seconds_a_frame : seconds_a_log_line))
    return;
  if (on_terminal_) {
    fmt::print(stderr, "\r\033[K{}", progress_line(fraction, stage, since(start_), terminal_columns()));
    drawn_ = true;
  } else {
    fmt::print(stderr, "{}\n", progress_log_line(fraction, stage, since(start_)));
  }
  std::fflush(stderr);
  last_shown_ = now;
}

}  // namespace floe
