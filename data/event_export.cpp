// Events as the texts that other tools read (docs/formats.md).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "data/base/atomic_file.h"
#include "data/base/error.h"
#include "data/event_files.h"
#include "data/event_rules.h"
#include "data/flasher_text.h"
#include "data/icetray_tables.h"

namespace floe {

namespace {

constexpr std::size_t portion = 1 << 20;  // text gathered before it is written [bytes]

struct Angles {
  double theta, phi;
};

// The arc tangent keeps full precision near the poles, where the arc cosine of a float loses it.
Angles angles_of(const Vec3f& direction) {
  const Vec3 d = direction.cast<double>();
  return {std::atan2(std::hypot(d.x(), d.y()), d.z()), std::atan2(d.y(), d.x())};
}

// What the charge of a photon is in the event. Of a flasher run, whose FLASHER line says how many flashes
// there were, the text holds the photons of all of them.
float photon_charge(const Event& event) {
  const bool flashes = event.flasher && event.repeats >= 1;  // a share of one flash is no number of flashes
  return flashes ? static_cast<float>(1 / event.repeats) : 1;
}

void append_hit(fmt::memory_buffer& text, const Event& event, const Hit& hit) {
  if (!hit.has_direction() || std::isnan(hit.inward.x()) || std::isnan(hit.wavelength))
    throw UsageError(
        fmt::format("event '{}' has hits of unknown direction or wavelength, which a .hits file cannot say. "
                    "Export it as .dat (module, time and charge)",
                    event.id));
  if (hit.charge != photon_charge(event))
    throw UsageError(fmt::format(
        "event '{}' has hits of {} photoelectrons (or photons of that weight), which a .hits file "
        "cannot say: each of its lines is one photon. Export it as .dat (module, time and charge)",
        event.id, hit.charge));
  const Angles p = angles_of(hit.direction), d = angles_of(hit.inward);
  fmt::format_to(std::back_inserter(text), "HIT {} {} {:.3f} {:.3f} {:.6f} {:.6f} {:.6f} {:.6f}\n",
                 hit.module.string, hit.module.dom, hit.time, hit.wavelength, p.theta, p.phi, d.theta, d.phi);
}

void append_charge(fmt::memory_buffer& text, const Event&, const Hit& hit) {
  fmt::format_to(std::back_inserter(text), "{} {} {:.3f} {}\n", hit.module.string, hit.module.dom, hit.time,
                 hit.charge);
}

// RFC 4180: a field that holds a comma or a quote stands in quotes, its quotes doubled.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"") == text.npos) return text;
  std::string result = "\"";
  for (const char c : text) result.append(c == '"' ? 2 : 1, c);
  return result + '"';
}

void append_optional(fmt::memory_buffer& text, float value) {
  text.push_back(',');
  if (!std::isnan(value)) fmt::format_to(std::back_inserter(text), "{}", value);
}

void append_csv(fmt::memory_buffer& text, const Event& event, const Hit& hit) {
  fmt::format_to(std::back_inserter(text), "{},{},{},{:.3f},{}", csv_field(event.id), hit.module.string,
                 hit.module.dom, hit.time, hit.charge);
  append_optional(text, hit.wavelength);
  for (const Vec3f& v : {hit.direction, hit.inward})
    for (const float component : v) append_optional(text, component);
  text.push_back('\n');
}

constexpr std::string_view csv_header =
    "event,string,dom,time_ns,charge_pe,wavelength_nm,direction_x,direction_y,direction_z,inward_x,inward_y,"
    "inward_z\n";

using AppendHit = void (*)(fmt::memory_buffer&, const Event&, const Hit&);
AppendHit line_of(EventFormat format) {
  switch (format) {
    case EventFormat::hits:
      return append_hit;
    case EventFormat::dat:
      return append_charge;
    case EventFormat::csv:
    case EventFormat::icetray:  // which is no text
      break;
  }
  return append_csv;
}

bool are_flasher_runs(std::span<const Event> events) {
  return std::all_of(events.begin(), events.end(),
                     [](const Event& event) { return event.flasher.has_value(); });
}

}  // namespace

EventFormat event_format_of(const std::filesystem::path& path) {
  const std::string suffix = text_suffix_of(path);
  if (path.string().ends_with(".i3.h5")) return EventFormat::icetray;
  if (suffix == ".hits") return EventFormat::hits;
  if (suffix == ".dat") return EventFormat::dat;
  if (suffix == ".csv") return EventFormat::csv;
  throw UsageError(fmt::format(
      "{}: the suffix '{}' names no format of export. Use .hits, .dat or .csv, each also with .gz, "
      "or .i3.h5",
      path.string(), suffix));
}

void export_events(const std::filesystem::path& path, EventFormat format, std::span<const Event> events) {
  if (events.empty()) throw UsageError(path.string() + ": there is no event to export");
  if (format == EventFormat::icetray) return write_icetray_pulses(path, events);
  const bool runs = format == EventFormat::hits && are_flasher_runs(events);
  if (events.size() > 1 && format != EventFormat::csv && !runs)
    throw UsageError(fmt::format(
        "{}: a .hits or .dat file holds one event, not {} (a .hits file also a set of flasher runs). "
        "Export one event, or all of them as .csv, which names the event of each hit",
        path.string(), events.size()));
  const AppendHit append = line_of(format);
  TextFileWriter writer(path);
  fmt::memory_buffer text;
  if (format == EventFormat::csv) writer.append(csv_header);
  for (const Event& event : events) {
    if (runs) text.append(flasher_line(event));
    for (const Hit& hit : event.hits) {
      append(text, event, hit);
      if (text.size() < portion) continue;
      writer.append({text.data(), text.size()});
      text.clear();
    }
  }
  writer.append({text.data(), text.size()});
  writer.close();
}

}  // namespace floe
