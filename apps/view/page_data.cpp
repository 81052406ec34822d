#include "apps/view/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace floe {

namespace {

constexpr std::size_t most_samples = 1'000'000;  // of waveforms in a page

// With so many digits as are worth their place in a page.
double short_number(double value, int digits = 5) {
  const std::string text = fmt::format("{:.{}g}", value, digits);
  double result = 0;
  std::from_chars(text.data(), text.data() + text.size(), result);
  return result;
}
double in_hundredths(double value) {
  return std::round(value * 100) / 100;
}

Json json_of(const Detector& detector) {
  Json json = {{"name", detector.name()}};
  for (const char* key : {"string", "dom", "x", "y", "z", "on"}) json[key] = Json::array();
  for (const Module& module : detector.modules()) {
    json["string"].push_back(module.id.string);
    json["dom"].push_back(module.id.dom);
    json["x"].push_back(in_hundredths(module.position.x()));
    json["y"].push_back(in_hundredths(module.position.y()));
    json["z"].push_back(in_hundredths(module.position.z()));
    json["on"].push_back(module.on ? 1 : 0);
  }
  return json;
}

Json json_of(const LightCurve& curve) {
  Json steps = Json::array(), charges = Json::array();
  std::uint32_t before = 0;
  for (const std::uint32_t bin : curve.bins) {
    steps.push_back(bin - before);
    before = bin;
  }
  for (const double charge : curve.charge_in_bin) charges.push_back(short_number(charge, 4));
  return {{"module", curve.module},
          {"hits", curve.hits},
          {"charge", short_number(curve.charge)},
          {"first", in_hundredths(curve.first)},
          {"bins", steps},
          {"charges", charges}};
}

Json json_of(const Particle& particle) {
  return {{"name", particle.name},
          {"x", particle.position.x()},
          {"y", particle.position.y()},
          {"z", particle.position.z()},
          {"time", particle.time},
          {"zenith_deg", particle.zenith / degree},
          {"azimuth_deg", particle.azimuth / degree},
          {"energy", particle.energy},
          {"length", particle.length}};
}

Json json_of(const FittedCascade& fit) {
  return {{"name", fit.label},
          {"x", fit.x},
          {"y", fit.y},
          {"z", fit.z},
          {"time", fit.time},
          {"zenith_deg", fit.zenith_deg},
          {"azimuth_deg", fit.azimuth_deg},
          {"energy", fit.energy},
          {"errors", fit.errors}};
}

Json marker(const Vec3& place, const std::string& label) {
  return {{"x", place.x()}, {"y", place.y()}, {"z", place.z()}, {"label", label}};
}

// Sources of light that are no particles: flashers and points.
Json lights_of(const EventToShow& shown, const Detector& detector) {
  Json lights = Json::array();
  const auto add_module = [&](ModuleId id) {
    if (const auto index = detector.find(id))
      lights.push_back(
          marker(detector.modules()[*index].position, fmt::format("flasher {},{}", id.string, id.dom)));
  };
  if (shown.event.flasher) {
    add_module(shown.event.flasher->module);
    return lights;
  }
  const Json source = shown.source.empty() ? Json() : Json::parse(shown.source, nullptr, false);
  if (!source.is_object()) return lights;
  if (const auto flasher = source.find("flasher"); flasher != source.end() && flasher->is_object())
    add_module({flasher->value("string", 0), flasher->value("dom", 0)});
  for (const char* kind : {"point", "standard-candle"})
    if (const auto point = source.find(kind); point != source.end() && point->is_object())
      lights.push_back(
          marker({point->value("x", 0.0), point->value("y", 0.0), point->value("z", 0.0)}, kind));
  return lights;
}

Json json_of(const Waveform& waveform, std::size_t module) {
  Json millivolts = Json::array();
  for (const int count : waveform.counts)
    millivolts.push_back(short_number((count - waveform.baseline) * waveform.millivolt_per_count, 4));
  return {{"module", module},
          {"digitiser", digitiser_names[static_cast<std::size_t>(waveform.digitiser)]},
          {"time", in_hundredths(waveform.time)},
          {"sample", waveform.step},
          {"millivolts", millivolts}};
}

// Those of the brightest modules, as long as there is room.
Json waveforms_of(const EventToShow& shown, const LightCurves& curves, const Detector& detector, bool& all) {
  std::vector<double> charge(detector.size(), 0);
  for (const LightCurve& curve : curves.modules) charge[curve.module] = curve.charge;
  std::vector<std::pair<std::size_t, const Waveform*>> traces;
  for (const ModuleWaveform& waveform : shown.waveforms)
    if (const auto module = detector.find(waveform.module)) traces.emplace_back(*module, &waveform);
  std::stable_sort(traces.begin(), traces.end(),
                   [&](const auto& a, const auto& b) { return charge[a.first] > charge[b.first]; });
  Json json = Json::array();
  std::size_t samples = 0;
  all = true;
  for (const auto& [module, waveform] : traces) {
    samples += waveform->counts.size();
    if (samples > most_samples) {
      all = false;
      break;
    }
    json.push_back(json_of(*waveform, module));
  }
  return json;
}

// From the top down to the bottom of the detector, and a little beyond: z of the layers' centres.
Json json_of(const IceModel& ice, const Detector& detector) {
  constexpr double wavelength = 400, margin = 60;
  const auto extent = detector.extent();
  Json z = Json::array(), absorption = Json::array(), scattering = Json::array();
  for (double centre = std::floor(extent.low.z() - margin); centre <= extent.high.z() + margin;
       centre += 10) {
    const int layer = ice.layer_at(centre);
    z.push_back(centre);
    absorption.push_back(short_number(ice.absorption(layer, wavelength), 4));
    scattering.push_back(short_number(ice.effective_scattering(layer, wavelength), 4));
  }
  return {{"name", ice.name()},
          {"flow_azimuth_deg", ice.flow_azimuth() / degree},
          {"z", z},
          {"step", 10},
          {"absorption", absorption},
          {"scattering", scattering}};
}

}  // namespace

Json page_data(const EventToShow& shown, const LightCurves& curves, const Detector& detector,
               const IceModel* ice) {
  Json json = {
      {"event", shown.event.id},
      {"file", shown.file},
      {"repeats", shown.event.repeats},
      {"hits", shown.event.hits.size()},
      {"detector", json_of(detector)},
      {"time",
       {{"begin", curves.begin}, {"end", in_hundredths(curves.end)}, {"bin_width", curves.bin_width}}}};
  for (const char* key : {"curves", "truth", "fits"}) json[key] = Json::array();
  for (const LightCurve& curve : curves.modules) json["curves"].push_back(json_of(curve));
  for (const Particle& particle : shown.event.truth) json["truth"].push_back(json_of(particle));
  json["light"] = lights_of(shown, detector);
  if (shown.fit) {
    json["fit_status"] = shown.fit->status;
    for (const FittedCascade& fit : shown.fit->fits) json["fits"].push_back(json_of(fit));
  }
  bool all = true;
  json["waveforms"] = waveforms_of(shown, curves, detector, all);
  json["all_waveforms"] = all;
  json["ice"] = ice ? json_of(*ice, detector) : Json();
  return json;
}

}  // namespace floe
