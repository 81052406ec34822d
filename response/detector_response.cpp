#include "response/detector_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/base/error.h"
#include "response/draws.h"

namespace floe {

namespace {

constexpr std::uint64_t draws_of_hits = std::uint64_t{1} << 40;  // streams of hits begin here, modules below

// Detectors say in one of two ways which modules have a high quantum efficiency.
double noise_factor(const Module& module, const ResponseSettings& settings) {
  const bool high_efficiency = module.high_qe_spectrum || module.relative_efficiency > 1.2;
  return high_efficiency ? settings.noise.high_efficiency_factor : 1;
}

int whole_repeats(const Event& event) {
  if (event.repeats == std::floor(event.repeats) && event.repeats <= 1e6)
    return static_cast<int>(event.repeats);
  throw InputError({"event " + event.id, 0}, fmt::format("an average over {} repeats", event.repeats),
                   "a whole number, up to 1000000: each is digitised");
}

// Times that overlap or touch become one, module by module and reason by reason.
void join(std::vector<UnusableTimes>& times) {
  std::sort(times.begin(), times.end(), [](const UnusableTimes& a, const UnusableTimes& b) {
    return std::tie(a.module, a.reason, a.begin) < std::tie(b.module, b.reason, b.begin);
  });
  std::vector<UnusableTimes> joined;
  for (const UnusableTimes& time : times) {
    const bool goes_on = !joined.empty() && joined.back().module == time.module &&
                         joined.back().reason == time.reason && time.begin <= joined.back().end;
    if (goes_on)
      joined.back().end = std::max(joined.back().end, time.end);
    else
      joined.push_back(time);
  }
  times = std::move(joined);
}

}  // namespace

struct DetectorResponse::Part {
  std::vector<TubeOutput> tubes;  // by module of the detector, as the rest
  std::vector<std::vector<Launch>> launches;
  std::vector<ModuleRecord> records;
};

DetectorResponse::DetectorResponse(const Detector& detector, const ResponseSettings& settings,
                                   std::uint64_t seed, const std::vector<ModuleId>& off)
    : detector_(detector),
      settings_(settings),
      electronics_(settings),
      seed_(seed),
      unit_(PhotoelectronCharge(settings.charge).mean()) {
  check(settings);
  const double noise = electronics_.noise_charge() / unit_;
  RecordingModules modules;
  for (const Module& module : detector.modules())
    modules.push_back({module.id, module.on, module.on ? noise * noise_factor(module, settings) : 0});
  for (const ModuleId id : off) modules[detector.index_of(id)] = {id, false, 0};
  modules_ = std::make_shared<const RecordingModules>(std::move(modules));
}

std::vector<DetectorResponse::Photon> DetectorResponse::photons_of(const Event& event) const {
  const int repeats = whole_repeats(event);
  const std::uint64_t source = stream_of(event.id);
  std::vector<Photon> photons;
  photons.reserve(event.hits.size());
  for (std::size_t i = 0; i < event.hits.size(); ++i) {
    const Hit& hit = event.hits[i];
    if (std::isnan(hit.wavelength))
      throw InputError({"event " + event.id, 0}, "hits without a wavelength, which are no photons",
                       "detected photons, as floe simulate writes them",
                       "Pulses have been through the electronics already; dark noise, which the effect "
                       "noise.rate adds to photons, is added here by the settings of the response");
    const std::size_t module = detector_.index_of(hit.module);
    if (!(*modules_)[module].on) continue;
    RandomStream stream(seed_, source, draws_of_hits + i);
    const double worth = hit.charge * event.repeats;
    // Charges are floats: 1/R times R is 1 only nearly.
    double copies = std::floor(worth + 1e-6);
    if (stream.uniform() < worth - copies) ++copies;
    for (; copies > 0; --copies) {
      const int repeat = repeats == 1 ? 0 : static_cast<int>(double(stream.bits()) * 0x1p-32 * repeats);
      photons.push_back({repeat, static_cast<std::uint32_t>(module), hit.time});
    }
  }
  std::sort(photons.begin(), photons.end(), [](const Photon& a, const Photon& b) {
    return std::tie(a.repeat, a.module, a.time) < std::tie(b.repeat, b.module, b.time);
  });
  return photons;
}

// Around the median of the light, so that a few stray photons do not matter.
DetectorResponse::Window DetectorResponse::window_of(const std::vector<Photon>& photons) const {
  std::vector<double> times;
  for (const Photon& photon : photons) times.push_back(photon.time);
  double middle = 0;
  if (!times.empty()) {
    const auto median = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), median, times.end());
    middle = *median;
  }
  return {middle - settings_.readout.before, middle + settings_.readout.after};
}

DetectorResponse::Part DetectorResponse::part(const std::vector<Photon>& photons, std::uint64_t event,
                                              int repeat, const Window& window, const ResponseRecord& record,
                                              int threads) const {
  const std::size_t size = detector_.size();
  Part part{std::vector<TubeOutput>(size), {}, std::vector<ModuleRecord>(size)};
  const std::uint64_t source = event + 0x9e3779b97f4a7c15 * static_cast<std::uint64_t>(repeat);
  const auto before = [](const Photon& photon, std::pair<int, std::uint32_t> place) {
    return std::pair(photon.repeat, photon.module) < place;
  };
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads)
  for (std::size_t i = 0; i < size; ++i) {
    if (!(*modules_)[i].on) continue;
    const auto module = static_cast<std::uint32_t>(i);
    auto photon = std::lower_bound(photons.begin(), photons.end(), std::pair(repeat, module), before);
    std::vector<double> times;
    for (; photon != photons.end() && photon->repeat == repeat && photon->module == module; ++photon)
      times.push_back(photon->time);
    const Module& here = detector_.modules()[i];
    RandomStream stream(
        seed_, source,
        static_cast<std::uint64_t>(here.id.string) * 1024 + static_cast<std::uint64_t>(here.id.dom));
    part.tubes[i] = electronics_.tube_output(times, noise_factor(here, settings_), window.begin, window.end,
                                             record.photoelectrons, stream);
  }
  std::vector<ModuleCrossings> crossings;
  for (std::size_t i = 0; i < size; ++i)
    crossings.push_back({detector_.modules()[i].id, part.tubes[i].crossings});
  part.launches = launches_of(settings_.launches, crossings);
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads)
  for (std::size_t i = 0; i < size; ++i)
    part.records[i] = electronics_.record(part.tubes[i], part.launches[i], record.waveforms);
  return part;
}

void DetectorResponse::add(Part part, const Window& window, int repeat, const ResponseRecord& record,
                           RespondedEvent& result) const {
  const double repeats = result.event.repeats;
  for (std::size_t i = 0; i < detector_.size(); ++i) {
    const ModuleId id = detector_.modules()[i].id;
    for (const ExtractedPulse& pulse : part.records[i].pulses) {
      if (pulse.time < window.begin || pulse.time >= window.end) continue;
      Hit& hit = result.event.hits.emplace_back();
      hit.module = id;
      hit.time = pulse.time;
      hit.charge = static_cast<float>(pulse.charge / unit_ / repeats);
      hit.width = static_cast<float>(pulse.width);
    }
    for (UnusableTimes times : part.records[i].unusable) {
      // In an average, dead times are those of a few repeats only.
      if (repeats > 1 && times.reason == UnusableTimes::Reason::dead) continue;
      times.module = id;
      times.begin = std::max(times.begin, window.begin);
      times.end = std::min(times.end, window.end);
      if (times.begin < times.end) result.event.readout->unusable.push_back(times);
    }
    if (record.photoelectrons)
      for (const Photoelectron& pe : part.tubes[i].before) result.photoelectrons.push_back({pe, repeat, id});
    for (std::size_t launch = 0; launch < part.launches[i].size(); ++launch) {
      ++result.launches;
      result.hard_launches += part.launches[i][launch].hard;
      if (record.waveforms)
        for (Waveform& trace : part.records[i].traces[launch])
          result.waveforms.push_back({std::move(trace), repeat, static_cast<int>(launch), id});
    }
  }
}

RespondedEvent DetectorResponse::respond(const Event& event, const ResponseRecord& record,
                                         int threads) const {
  const std::vector<Photon> photons = photons_of(event);
  const int repeats = whole_repeats(event);
  const Window window = window_of(photons);
  RespondedEvent result;
  result.event = {event.id, {}, event.truth, event.repeats, event.flasher, {}};
  result.event.readout = Readout{window.begin, window.end, settings_.afterpulses,
                                 {},           modules_,   TransitTime(settings_.time).expected_delays()};
  const std::uint64_t source = stream_of(event.id);
  // As many repeats at a time as there are threads, so that memory does not grow with their number.
  const int together = repeats > 1 ? std::max(1, threads) : 1;
  for (int first = 0; first < repeats; first += together) {
    const int count = std::min(together, repeats - first);
    std::vector<Part> parts(static_cast<std::size_t>(count));
#pragma omp parallel for schedule(dynamic) num_threads(together)
    for (int i = 0; i < count; ++i)
      parts[static_cast<std::size_t>(i)] =
          part(photons, source, first + i, window, record, repeats > 1 ? 1 : std::max(1, threads));
    for (int i = 0; i < count; ++i)
      add(std::move(parts[static_cast<std::size_t>(i)]), window, first + i, record, result);
  }
  join(result.event.readout->unusable);
  return result;
}

}  // namespace floe
