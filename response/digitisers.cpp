#include "response/digitisers.h"

#include <algorithm>
#include <cmath>

namespace floe {

namespace {

constexpr double finest = 0.2;  // photoelectrons so near are taken for one in their middle [ns]

// The photoelectrons with those that no sample could tell apart put together, so that the brightest modules
// cost no more than some thousand.
std::vector<Photoelectron> put_together(std::span<const Photoelectron> photoelectrons) {
  std::vector<Photoelectron> result;
  double first = 0, moment = 0, charge = 0;
  const auto finish = [&] {
    if (charge > 0) result.push_back({first + moment / charge, static_cast<float>(charge)});
  };
  for (const Photoelectron& pe : photoelectrons) {
    if (charge > 0 && pe.time - first < finest) {
      moment += pe.charge * (pe.time - first);
      charge += pe.charge;
      continue;
    }
    finish();
    first = pe.time;
    moment = 0;
    charge = pe.charge;
  }
  finish();
  return result;
}

Waveform rounded(Digitiser digitiser, double time, double step, double millivolt_per_count, double baseline,
                 std::span<const double> voltages) {
  Waveform trace{digitiser, time, step, millivolt_per_count, baseline, {}};
  trace.counts.reserve(voltages.size());
  for (const double voltage : voltages)
    trace.counts.push_back(static_cast<int>(std::lround(std::clamp(
        baseline + voltage / millivolt_per_count, 0.0, double(DigitiserSettings::largest_count)))));
  return trace;
}

}  // namespace

Digitisers::Digitisers(const DigitiserSettings& settings, double charge)
    : settings_(settings),
      charge_(charge),
      atwd_shape_(settings.atwd_b1, settings.atwd_b2),
      fadc_shape_(settings.fadc_b1, settings.fadc_b2) {}

double Digitisers::record_begin(double launch, double phase) const {
  const double tick = phase + settings_.clock * std::ceil((launch - phase) / settings_.clock);
  return tick - settings_.delay;
}

std::vector<double> Digitisers::voltages(const PulseShape& shape,
                                         std::span<const Photoelectron> photoelectrons, double begin,
                                         double step, int samples) const {
  std::vector<double> result(static_cast<std::size_t>(samples), 0.0);
  for (const Photoelectron& pe : photoelectrons) {
    const double from = (pe.time + shape.begin() - begin) / step, to = (pe.time + shape.end() - begin) / step;
    const int first = std::max(0, static_cast<int>(std::ceil(std::max(from, -1.0))));
    const int last = std::min(samples - 1, static_cast<int>(std::floor(std::min(to, double(samples)))));
    for (int i = first; i <= last; ++i)
      result[static_cast<std::size_t>(i)] += charge_ * pe.charge * shape(begin + step * i - pe.time);
  }
  return result;
}

std::vector<Waveform> Digitisers::digitise(std::span<const Photoelectron> photoelectrons, double begin,
                                           bool whole) const {
  const auto& s = settings_;
  const double end = begin + std::max(s.fadc_step * s.fadc_samples, s.atwd_step * s.atwd_samples);
  const auto before = [](const Photoelectron& pe, double time) { return pe.time < time; };
  const auto from =
      std::lower_bound(photoelectrons.begin(), photoelectrons.end(), begin - fadc_shape_.end(), before);
  const auto to = std::lower_bound(from, photoelectrons.end(), end - fadc_shape_.begin(), before);
  const std::vector<Photoelectron> near = put_together({from, to});

  std::vector<Waveform> traces;
  const Waveform fadc =
      rounded(Digitiser::fadc, begin, s.fadc_step, s.fadc_count, s.fadc_baseline,
              voltages(fadc_shape_, near, begin, s.fadc_step, whole ? s.fadc_samples : s.stamp_samples));
  if (!whole) {
    const auto& counts = fadc.counts;
    auto place = std::max_element(counts.begin(), counts.end()) - counts.begin();
    place = std::clamp<std::ptrdiff_t>(place, 1, static_cast<std::ptrdiff_t>(counts.size()) - 2);
    Waveform stamp = fadc;
    stamp.time += stamp.step * static_cast<double>(place - 1);
    stamp.counts.assign(counts.begin() + place - 1, counts.begin() + place + 2);
    return {stamp};
  }
  const std::vector<double> voltage = voltages(atwd_shape_, near, begin, s.atwd_step, s.atwd_samples);
  for (int channel = 0; channel < 3; ++channel) {
    traces.push_back(rounded(static_cast<Digitiser>(channel), begin, s.atwd_step,
                             s.atwd_count / s.atwd_gain[static_cast<std::size_t>(channel)], s.atwd_baseline,
                             voltage));
    const auto& counts = traces.back().counts;
    if (*std::max_element(counts.begin(), counts.end()) < s.next_gain * DigitiserSettings::largest_count)
      break;
  }
  traces.push_back(fadc);
  return traces;
}

}  // namespace floe
