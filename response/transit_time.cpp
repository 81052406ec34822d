#include "response/transit_time.h"

#include <cmath>
#include <numbers>

#include "response/draws.h"

namespace floe {

double TransitTime::peak_mean() const {
  return std::sqrt(2 / std::numbers::pi) * (settings_.fall - settings_.rise);
}

double TransitTime::peak_density(double time) const {
  const double from_mode = time + peak_mean();
  const double z = from_mode / (from_mode < 0 ? settings_.rise : settings_.fall);
  return std::sqrt(2 / std::numbers::pi) / (settings_.rise + settings_.fall) * std::exp(-0.5 * z * z);
}

double TransitTime::peak_below(double time) const {
  const auto& s = settings_;
  const double from_mode = time + peak_mean(), early = s.rise / (s.rise + s.fall);
  if (from_mode < 0) return early * std::erfc(-from_mode / (s.rise * std::numbers::sqrt2));
  return early + (1 - early) * std::erf(from_mode / (s.fall * std::numbers::sqrt2));
}

double TransitTime::peak_share() const {
  const auto& s = settings_;
  return 1 - s.prepulse_share - s.shoulder_share - s.late_peak_share - s.tail_share;
}

std::vector<ExpectedDelay> TransitTime::expected_delays() const {
  constexpr double narrow = 0.5, far = 4;  // [ns]; widths of the peak's halves
  const auto& s = settings_;
  const double half = std::sqrt(3.0) * s.late_peak_width;  // of as wide a box
  std::vector<ExpectedDelay> all{{s.shoulder_share, s.shoulder_begin, s.shoulder_end},
                                 {s.late_peak_share, s.late_peak_time - half, s.late_peak_time + half},
                                 {s.tail_share, s.tail_begin, s.tail_end}};
  const double begin = -peak_mean() - far * s.rise, end = -peak_mean() + far * s.fall;
  const int boxes = static_cast<int>(std::ceil((end - begin) / narrow));
  const double width = (end - begin) / boxes;
  for (int i = 0; i < boxes; ++i) {
    const double low = begin + i * width;
    all.push_back({peak_share() * (peak_below(low + width) - peak_below(low)), low, low + width});
  }
  std::erase_if(all, [](const ExpectedDelay& delay) { return delay.share <= 0 || delay.begin >= delay.end; });
  return all;
}

TransitTime::Arrival TransitTime::draw(RandomStream& stream) const {
  const auto& s = settings_;
  double kind = stream.uniform();
  const auto is = [&kind](double share) { return (kind -= share) < 0; };
  if (is(s.prepulse_share)) return {s.prepulse_time, s.prepulse_charge, PhotoelectronOrigin::prepulse};
  const auto late = [](double delay) { return Arrival{delay, 1, PhotoelectronOrigin::late}; };
  if (is(s.shoulder_share))
    return late(s.shoulder_begin + (s.shoulder_end - s.shoulder_begin) * stream.uniform());
  if (is(s.late_peak_share)) return late(s.late_peak_time + s.late_peak_width * draw_gaussian(stream));
  if (is(s.tail_share)) return late(s.tail_begin + (s.tail_end - s.tail_begin) * stream.uniform());
  const bool early = stream.uniform() * (s.rise + s.fall) < s.rise;
  const double distance = std::abs(draw_gaussian(stream));
  return {(early ? -s.rise : s.fall) * distance - peak_mean(), 1, PhotoelectronOrigin::photon};
}

}  // namespace floe
