#include "response/module_record.h"

#include <algorithm>

#include "response/afterpulses.h"

namespace floe {

ModuleElectronics::ModuleElectronics(const ResponseSettings& settings)
    : settings_(settings),
      charge_(settings.charge),
      time_(settings.time),
      digitisers_(settings.digitisers, charge_in_millivolt(settings.tube)) {}

// A photoelectron and its afterpulses, which have none of their own: 6% of 6%.
void ModuleElectronics::add_light(double photon, RandomStream& stream,
                                  std::vector<Photoelectron>& photoelectrons) const {
  const auto charge = [&](double share) { return static_cast<float>(share * charge_.draw(stream)); };
  const TransitTime::Arrival arrival = time_.draw(stream);
  photoelectrons.push_back({photon + arrival.delay, charge(arrival.charge_share), arrival.origin});
  const int afterpulses = draw_poisson(stream, settings_.afterpulses.share);
  for (int i = 0; i < afterpulses; ++i)
    photoelectrons.push_back({photon + draw_afterpulse_delay(settings_.afterpulses, stream), charge(1),
                              PhotoelectronOrigin::afterpulse});
}

TubeOutput ModuleElectronics::tube_output(std::span<const double> photons, double noise_factor, double begin,
                                          double end, bool keep_before, RandomStream& stream) const {
  TubeOutput tube;
  tube.clock_phase = settings_.digitisers.clock * stream.uniform();
  auto& photoelectrons = tube.photoelectrons;
  for (const double photon : photons) add_light(photon, stream, photoelectrons);
  for (const double time : draw_dark_noise(settings_.noise, noise_factor, begin, end, stream))
    photoelectrons.push_back({time, static_cast<float>(charge_.draw(stream)), PhotoelectronOrigin::noise});
  std::sort(photoelectrons.begin(), photoelectrons.end(),
            [](const Photoelectron& a, const Photoelectron& b) { return a.time < b.time; });
  if (keep_before) tube.before = photoelectrons;
  tube.saturated = saturate(settings_.tube, photoelectrons);
  tube.crossings = threshold_crossings(settings_.discriminator, digitisers_.atwd_shape(), photoelectrons);
  return tube;
}

void ModuleElectronics::add_dead_times(std::span<const Launch> launches, std::size_t launch, bool whole,
                                       double recorded_until, ModuleRecord& record) const {
  const LaunchSettings& s = settings_.launches;
  double free = launches[launch].time + (whole ? s.record + s.rearm : s.soft_busy);
  if (whole) {
    // With all chips digitising, the module waits for the one that began first.
    int digitising = 0;
    for (std::size_t k = launch + 1; k-- > 0;)
      if ((launches[k].hard || s.mode == CoincidenceMode::none) && ++digitising == s.chips)
        free = std::max(free, launches[k].time + s.chip_busy);
  }
  // Gaps as short as re-arming takes lose no light to speak of.
  if (free > recorded_until + s.rearm + settings_.digitisers.delay)
    record.unusable.push_back({{}, recorded_until, free, UnusableTimes::Reason::dead});
}

ModuleRecord ModuleElectronics::record(const TubeOutput& tube, std::span<const Launch> launches,
                                       bool keep_traces) const {
  ModuleRecord record;
  for (const TimeRange& range : tube.saturated)
    record.unusable.push_back({{}, range.begin, range.end, UnusableTimes::Reason::saturated});
  for (std::size_t i = 0; i < launches.size(); ++i) {
    const Launch& launch = launches[i];
    const double begin = digitisers_.record_begin(launch.time, tube.clock_phase);
    const bool whole = launch.hard || settings_.launches.mode == CoincidenceMode::none;
    if (!whole && settings_.launches.mode == CoincidenceMode::hard) {
      add_dead_times(launches, i, whole, begin, record);
      if (keep_traces) record.traces.emplace_back();
      continue;
    }
    std::vector<Waveform> traces = digitisers_.digitise(tube.photoelectrons, begin, whole);
    const Waveform& last = traces.back();
    add_dead_times(launches, i, whole, last.time + last.step * static_cast<double>(last.counts.size()),
                   record);
    const Extraction light = extract_pulses(settings_.pulses, digitisers_, traces);
    record.pulses.insert(record.pulses.end(), light.pulses.begin(), light.pulses.end());
    for (const TimeRange& range : light.clipped)
      record.unusable.push_back({{}, range.begin, range.end, UnusableTimes::Reason::saturated});
    if (keep_traces) record.traces.push_back(std::move(traces));
  }
  return record;
}

double ModuleElectronics::noise_charge() const {
  constexpr int windows = 200;
  constexpr double photoelectrons = 11000;  // of all windows together
  if (settings_.noise.rate() <= 0) return 0;
  const double window = 1e9 * photoelectrons / settings_.noise.rate() / windows;  // [ns]
  double charge = 0;
  for (int k = 0; k < windows; ++k) {
    RandomStream stream(0, stream_of("dark noise of one module"), static_cast<std::uint64_t>(k));
    const TubeOutput tube = tube_output({}, 1, 0, window, false, stream);
    const ModuleCrossings crossings{{1, 1}, tube.crossings};
    const auto launches = launches_of(settings_.launches, {&crossings, 1});
    for (const ExtractedPulse& pulse : record(tube, launches.front(), false).pulses) charge += pulse.charge;
  }
  return charge / (windows * window * 1e-9);
}

}  // namespace floe
