#include "response/pulse_extraction.h"

#include <algorithm>
#include <cmath>

#include "response/nonnegative_least_squares.h"

namespace floe {

namespace {

// A measured voltage, in counts of the digitiser that measured it, which is how well it is known.
struct Sample {
  const PulseShape* shape;
  double time, counts, millivolt_per_count;
};

struct Samples {
  std::vector<Sample> list;
  std::vector<TimeRange> clipped;
  double atwd_begin = 0, atwd_end = 0;  // none: both are equal
};

bool is_clipped(int counts) {
  return counts >= DigitiserSettings::largest_count;
}

// Light within a pulse's width of a clipped sample is mistaken for what the sample hides.
void add_clipped(double time, double step, std::vector<TimeRange>& ranges) {
  constexpr double width = 10;  // [ns]
  const double begin = time - std::max(step, width), end = time + std::max(step, width);
  if (!ranges.empty() && begin <= ranges.back().end)
    ranges.back().end = end;
  else
    ranges.push_back({begin, end});
}

// Of the ATWD each sample in the highest gain that did not clip; then those of the FADC that did not. What
// clips in the FADC alone is lost only where there is no ATWD.
Samples samples_of(const Digitisers& digitisers, std::span<const Waveform> traces) {
  Samples samples;
  const Waveform& fadc = traces.back();
  const auto atwds = traces.first(traces.size() - 1);
  const auto add = [&](const Waveform& trace, std::size_t i) {
    samples.list.push_back({&digitisers.shape(trace.digitiser),
                            trace.time + trace.step * static_cast<double>(i),
                            trace.counts[i] - trace.baseline, trace.millivolt_per_count});
  };
  if (!atwds.empty()) {
    const Waveform& first = atwds.front();
    samples.atwd_begin = first.time;
    samples.atwd_end = first.time + first.step * static_cast<double>(first.counts.size());
    for (std::size_t i = 0; i < first.counts.size(); ++i) {
      const auto good = std::find_if(atwds.begin(), atwds.end(),
                                     [i](const Waveform& trace) { return !is_clipped(trace.counts[i]); });
      const double time = first.time + first.step * static_cast<double>(i);
      if (good != atwds.end())
        add(*good, i);
      else
        add_clipped(time, first.step, samples.clipped);
    }
  }
  for (std::size_t i = 0; i < fadc.counts.size(); ++i) {
    const double time = fadc.time + fadc.step * static_cast<double>(i);
    if (!is_clipped(fadc.counts[i]))
      add(fadc, i);
    else if (time > samples.atwd_end || atwds.empty())
      add_clipped(time, fadc.step, samples.clipped);
  }
  return samples;
}

// A pulse that is tried: of charge 1.
struct Trial {
  double time, width;
};

// Where pulses are tried: only where some sample near the pulse's peak is above 0, since all others can only
// come out as 0.
std::vector<Trial> trials(const ExtractionSettings& settings, const Digitisers& digitisers,
                          std::span<const Waveform> traces, const Samples& samples) {
  const Waveform& fadc = traces.back();
  std::vector<Trial> result;
  const auto try_at = [&](double begin, double end, double spacing, const Waveform& trace) {
    const PulseShape& shape = digitisers.shape(trace.digitiser);
    const auto size = static_cast<double>(trace.counts.size());
    for (double time = begin; time < end; time += spacing) {
      const double at = (time + shape.peak_time() - trace.time) / trace.step;
      const auto low = static_cast<std::size_t>(std::clamp(std::floor(at) - 1, 0.0, size - 1));
      const auto high = static_cast<std::size_t>(std::clamp(std::ceil(at) + 1, 0.0, size - 1));
      bool light = false;
      for (std::size_t i = low; i <= high; ++i) light |= trace.counts[i] > trace.baseline + 1;
      if (light) result.push_back({time, spacing});
    }
  };
  if (samples.atwd_begin < samples.atwd_end)
    try_at(samples.atwd_begin - settings.atwd_spacing, samples.atwd_end - traces.front().step,
           settings.atwd_spacing, traces.front());
  const double from =
      std::max(fadc.time - fadc.step,
               samples.atwd_end > samples.atwd_begin ? samples.atwd_end - traces.front().step : -1e300);
  // Three samples alone are enough for finer steps: their noise is that of rounding.
  const double spacing =
      samples.atwd_begin < samples.atwd_end ? settings.fadc_spacing : settings.fadc_spacing / 2;
  try_at(from, fadc.time + fadc.step * static_cast<double>(fadc.counts.size()), spacing, fadc);
  return result;
}

// Whether some sample sees a good part of the pulse. What clipped samples hide may be as large as it likes: a
// pulse of which only the far tail is seen would be given thousands of photoelectrons for a count.
bool is_seen(const Trial& trial, const std::vector<Sample>& samples) {
  constexpr double good_part = 0.01;  // of the height at its peak
  return std::any_of(samples.begin(), samples.end(), [&](const Sample& sample) {
    const PulseShape& shape = *sample.shape;
    return shape(sample.time - trial.time) > good_part * shape(shape.peak_time());
  });
}

Eigen::SparseMatrix<double> matrix_of(double charge, const std::vector<Trial>& tried,
                                      const std::vector<Sample>& samples) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < tried.size(); ++j)
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double height = (*samples[i].shape)(samples[i].time - tried[j].time);
      if (height > 0)
        entries.emplace_back(static_cast<int>(i), static_cast<int>(j),
                             charge * height / samples[i].millivolt_per_count);
    }
  Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(samples.size()),
                                     static_cast<Eigen::Index>(tried.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// A pulse between two that were tried comes out as both, sometimes as three: neighbours are put together.
std::vector<ExtractedPulse> put_together(const std::vector<Trial>& tried, const Eigen::VectorXd& charges,
                                         double least) {
  constexpr double nearest = 2.5;  // times their distance
  std::vector<ExtractedPulse> pulses;
  double first = 0;  // time of the first trial of the last pulse
  for (std::size_t j = 0; j < tried.size(); ++j) {
    const double charge = charges(static_cast<Eigen::Index>(j));
    if (charge <= 0) continue;
    const Trial& trial = tried[j];
    if (!pulses.empty() && trial.time - first < nearest * trial.width) {
      ExtractedPulse& before = pulses.back();
      before.time = (before.time * before.charge + trial.time * charge) / (before.charge + charge);
      before.charge += charge;
      before.width = std::max(before.width, trial.width);
    } else {
      pulses.push_back({trial.time, charge, trial.width});
      first = trial.time;
    }
  }
  std::erase_if(pulses, [least](const ExtractedPulse& pulse) { return pulse.charge < least; });
  return pulses;
}

// Non-negative solutions are spikes: light that lasts comes out as pulses about a pulse's width apart, which
// stand for all the light between them.
void spread_out(std::vector<ExtractedPulse>& pulses) {
  constexpr double least_charge = 1;  // of both neighbours: less is single photoelectrons
  // Closer than this, where there is an ATWD trace, and elsewhere, where trials are coarse [ns].
  constexpr double apart = 13, coarsely_apart = 50, coarse = 2;
  std::vector<double> reach(pulses.size(), 0);
  for (std::size_t i = 1; i < pulses.size(); ++i) {
    const ExtractedPulse &before = pulses[i - 1], &here = pulses[i];
    const double gap = here.time - before.time;
    const double close = std::max(before.width, here.width) > coarse ? coarsely_apart : apart;
    if (gap >= close || std::min(before.charge, here.charge) < least_charge) continue;
    reach[i - 1] += gap / 2, reach[i] += gap / 2;
  }
  for (std::size_t i = 0; i < pulses.size(); ++i) pulses[i].width = std::max(pulses[i].width, reach[i]);
}

}  // namespace

Extraction extract_pulses(const ExtractionSettings& settings, const Digitisers& digitisers,
                          std::span<const Waveform> traces) {
  const Samples samples = samples_of(digitisers, traces);
  std::vector<Trial> tried = trials(settings, digitisers, traces, samples);
  if (!samples.clipped.empty())
    std::erase_if(tried, [&](const Trial& trial) { return !is_seen(trial, samples.list); });
  Extraction result{{}, samples.clipped};
  if (tried.empty()) return result;
  Eigen::VectorXd counts(static_cast<Eigen::Index>(samples.list.size()));
  for (std::size_t i = 0; i < samples.list.size(); ++i)
    counts(static_cast<Eigen::Index>(i)) = samples.list[i].counts;
  const auto charges = nonnegative_least_squares(matrix_of(digitisers.charge(), tried, samples.list), counts,
                                                 settings.tolerance);
  result.pulses = put_together(tried, charges, settings.least_charge);
  spread_out(result.pulses);
  return result;
}

}  // namespace floe
