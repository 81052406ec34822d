#include "response/pulse_shape.h"

#include <algorithm>
#include <cmath>

namespace floe {

namespace {

constexpr double nothing = 1e-4;  // of the peak

// Where a falling or rising function crosses `level` between low and high.
template <typename Function>
double crossing(const Function& function, double level, double low, double high) {
  const bool rising = function(high) > function(low);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((function(middle) < level) == rising ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double PulseShape::raw(double time) const {
  const double sum = std::exp(-time / b1_) + std::exp(time / b2_);
  const double square = sum * sum, fourth = square * square;
  return 1 / (fourth * fourth);
}

// With y = 1/(1 + exp((1/b1 + 1/b2) t)) the integral is Euler's beta function.
PulseShape::PulseShape(double b1, double b2) : b1_(b1), b2_(b2) {
  const double rate = 1 / b1 + 1 / b2;
  norm_ = rate / std::beta(8 / (b1 * rate), 8 / (b2 * rate));
  const double peak_at = std::log(b2 / b1) / rate, height = raw(peak_at);
  const auto value = [this](double time) { return raw(time); };
  half_rise_ = crossing(value, 0.5 * height, peak_at - 8 * b1, peak_at);
  begin_ = crossing(value, nothing * height, peak_at - 8 * b1, peak_at) - half_rise_;
  end_ = crossing(value, nothing * height, peak_at, peak_at + 8 * b2) - half_rise_;
  peak_time_ = peak_at - half_rise_;
}

double PulseShape::operator()(double time) const {
  return time < begin_ || time > end_ ? 0 : norm_ * raw(time + half_rise_);
}

double sum_of_pulses(const PulseShape& shape, std::span<const Photoelectron> photoelectrons, double time) {
  auto pe = std::lower_bound(photoelectrons.begin(), photoelectrons.end(), time - shape.end(),
                             [](const Photoelectron& p, double t) { return p.time < t; });
  double sum = 0;
  for (; pe != photoelectrons.end() && pe->time < time - shape.begin(); ++pe)
    sum += pe->charge * shape(time - pe->time);
  return sum;
}

}  // namespace floe
