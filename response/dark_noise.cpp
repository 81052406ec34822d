#include "response/dark_noise.h"

#include <cmath>

#include "response/draws.h"

namespace floe {

namespace {

constexpr double second = 1e9;          // [ns]
constexpr double earliest_burst = 1e6;  // before the window [ns]: longer gaps are 2 in 10000

}  // namespace

std::vector<double> draw_dark_noise(const DarkNoiseSettings& settings, double factor, double begin,
                                    double end, RandomStream& stream) {
  std::vector<double> times;
  const auto keep = [&](double time) {
    if (time >= begin && time < end) times.push_back(time);
  };
  // Calls at random times, one after the other, so that any rate and any window will do.
  const auto at_random = [&](double rate, double from, const auto& happens) {
    const double mean_gap = second / rate;
    for (double time = from + mean_gap * stream.exponential(); time < end;
         time += mean_gap * stream.exponential())
      happens(time);
  };
  if (settings.single_rate * factor > 0) at_random(settings.single_rate * factor, begin, keep);
  if (settings.burst_rate * factor > 0)
    at_random(settings.burst_rate * factor, begin - earliest_burst, [&](double time) {
      const int size = draw_poisson(stream, settings.burst_size);
      for (int i = 0; i < size; ++i) {
        keep(time);
        time +=
            second * std::pow(10, settings.gap_log10_mean + settings.gap_log10_width * draw_gaussian(stream));
      }
    });
  return times;
}

}  // namespace floe
