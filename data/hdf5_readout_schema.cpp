#include "data/hdf5_readout_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>

namespace floe {

std::string_view name_of(UnusableTimes::Reason reason) {
  return reason == UnusableTimes::Reason::saturated ? "saturated" : "dead";
}

namespace hdf5 {

namespace {

#define FLOE_COLUMN(Row, member, kind)                                    \
  Column {                                                                \
#member, ColumnKind::kind, offsetof(Row, member), sizeof(Row::member) \
  }

constexpr std::array module_columns = {
    FLOE_COLUMN(ModuleRow, string, int32),
    FLOE_COLUMN(ModuleRow, dom, int32),
    FLOE_COLUMN(ModuleRow, on, int32),
    FLOE_COLUMN(ModuleRow, noise_hz, float64),
};
constexpr std::array readout_columns = {
    FLOE_COLUMN(ReadoutRow, event, uint64),
    FLOE_COLUMN(ReadoutRow, begin_ns, float64),
    FLOE_COLUMN(ReadoutRow, end_ns, float64),
    FLOE_COLUMN(ReadoutRow, afterpulse_share, float64),
    FLOE_COLUMN(ReadoutRow, afterpulse_begin_ns, float64),
    FLOE_COLUMN(ReadoutRow, afterpulse_end_ns, float64),
};
constexpr std::array unusable_columns = {
    FLOE_COLUMN(UnusableRow, event, uint64),   FLOE_COLUMN(UnusableRow, string, int32),
    FLOE_COLUMN(UnusableRow, dom, int32),      FLOE_COLUMN(UnusableRow, begin_ns, float64),
    FLOE_COLUMN(UnusableRow, end_ns, float64), FLOE_COLUMN(UnusableRow, reason, text),
};
constexpr std::array delay_columns = {
    FLOE_COLUMN(DelayRow, event, uint64),
    FLOE_COLUMN(DelayRow, share, float64),
    FLOE_COLUMN(DelayRow, begin_ns, float64),
    FLOE_COLUMN(DelayRow, end_ns, float64),
};
constexpr std::array photoelectron_columns = {
    FLOE_COLUMN(PhotoelectronRow, event, uint64),    FLOE_COLUMN(PhotoelectronRow, repeat, int32),
    FLOE_COLUMN(PhotoelectronRow, string, int32),    FLOE_COLUMN(PhotoelectronRow, dom, int32),
    FLOE_COLUMN(PhotoelectronRow, time_ns, float64), FLOE_COLUMN(PhotoelectronRow, charge_pe, float32),
    FLOE_COLUMN(PhotoelectronRow, origin, text),
};
constexpr std::array waveform_columns = {
    FLOE_COLUMN(WaveformRow, event, uint64),
    FLOE_COLUMN(WaveformRow, repeat, int32),
    FLOE_COLUMN(WaveformRow, string, int32),
    FLOE_COLUMN(WaveformRow, dom, int32),
    FLOE_COLUMN(WaveformRow, launch, int32),
    FLOE_COLUMN(WaveformRow, digitiser, text),
    FLOE_COLUMN(WaveformRow, time_ns, float64),
    FLOE_COLUMN(WaveformRow, sample_ns, float64),
    FLOE_COLUMN(WaveformRow, millivolt_per_count, float64),
    FLOE_COLUMN(WaveformRow, baseline, float64),
    FLOE_COLUMN(WaveformRow, first_sample, uint64),
    FLOE_COLUMN(WaveformRow, sample_count, uint64),
};
constexpr std::array sample_columns = {FLOE_COLUMN(SampleRow, counts, int32)};
#undef FLOE_COLUMN

template <std::size_t size>
void put(std::string_view name, char (&text)[size]) {
  name.copy(text, size);
}

// The place of a padded text among names.
template <std::size_t size, std::size_t count>
std::optional<int> place_of(const char (&text)[size], const std::string_view (&names)[count]) {
  const auto found =
      std::find(std::begin(names), std::end(names), std::string_view(text, strnlen(text, size)));
  if (found == std::end(names)) return {};
  return static_cast<int>(found - std::begin(names));
}

constexpr std::string_view reasons[] = {"saturated", "dead"};

std::optional<Problem> range_problem(double begin, double end) {
  if (std::isfinite(begin) && std::isfinite(end) && begin < end) return {};
  return Problem{fmt::format("times from {} to {}", begin, end), "finite times, rising [ns]"};
}

}  // namespace

std::span<const Column> Table<ModuleRow>::columns() {
  return module_columns;
}
std::span<const Column> Table<ReadoutRow>::columns() {
  return readout_columns;
}
std::span<const Column> Table<UnusableRow>::columns() {
  return unusable_columns;
}
std::span<const Column> Table<DelayRow>::columns() {
  return delay_columns;
}
std::span<const Column> Table<PhotoelectronRow>::columns() {
  return photoelectron_columns;
}
std::span<const Column> Table<WaveformRow>::columns() {
  return waveform_columns;
}
std::span<const Column> Table<SampleRow>::columns() {
  return sample_columns;
}
// The event, then what a hit has.
std::span<const Column> Table<PhotonRow>::columns() {
  static const std::vector<Column> columns = [] {
    std::vector<Column> list = {
        {"event", ColumnKind::uint64, offsetof(PhotonRow, event), sizeof(PhotonRow::event)}};
    for (Column column : Table<HitRow>::columns()) {
      column.offset += offsetof(PhotonRow, hit);
      list.push_back(column);
    }
    return list;
  }();
  return columns;
}

ModuleRow row_of(const RecordingModule& module) {
  return {module.id.string, module.id.dom, module.on, module.noise_rate};
}
RecordingModule module_of(const ModuleRow& row) {
  return {{row.string, row.dom}, row.on != 0, row.noise_hz};
}

ReadoutRow row_of(std::uint64_t event, const Readout& readout) {
  const ExpectedAfterpulses& after = readout.afterpulses;
  return {event, readout.begin, readout.end, after.share, after.begin, after.end};
}
Readout readout_of(const ReadoutRow& row) {
  return {row.begin_ns, row.end_ns, {row.afterpulse_share, row.afterpulse_begin_ns, row.afterpulse_end_ns},
          {},           nullptr,    {}};
}

UnusableRow row_of(std::uint64_t event, const UnusableTimes& times) {
  UnusableRow row{event, times.module.string, times.module.dom, times.begin, times.end, {}};
  put(name_of(times.reason), row.reason);
  return row;
}
std::optional<UnusableTimes> unusable_of(const UnusableRow& row) {
  const auto reason = place_of(row.reason, reasons);
  if (!reason) return {};
  return UnusableTimes{
      {row.string, row.dom}, row.begin_ns, row.end_ns, static_cast<UnusableTimes::Reason>(*reason)};
}

DelayRow row_of(std::uint64_t event, const ExpectedDelay& delay) {
  return {event, delay.share, delay.begin, delay.end};
}
ExpectedDelay delay_of(const DelayRow& row) {
  return {row.share, row.begin_ns, row.end_ns};
}

PhotoelectronRow row_of(std::uint64_t event, const ModulePhotoelectron& pe) {
  PhotoelectronRow row{event, pe.repeat, pe.module.string, pe.module.dom, pe.time, pe.charge, {}};
  put(photoelectron_origins[static_cast<std::size_t>(pe.origin)], row.origin);
  return row;
}
std::optional<ModulePhotoelectron> photoelectron_of(const PhotoelectronRow& row) {
  const auto origin = place_of(row.origin, photoelectron_origins);
  if (!origin) return {};
  return ModulePhotoelectron{{row.time_ns, row.charge_pe, static_cast<PhotoelectronOrigin>(*origin)},
                             row.repeat,
                             {row.string, row.dom}};
}

WaveformRow row_of(std::uint64_t event, const ModuleWaveform& w, std::uint64_t first_sample) {
  WaveformRow row{event,  w.repeat, w.module.string,       w.module.dom, w.launch,     {},
                  w.time, w.step,   w.millivolt_per_count, w.baseline,   first_sample, w.counts.size()};
  put(digitiser_names[static_cast<std::size_t>(w.digitiser)], row.digitiser);
  return row;
}
std::optional<ModuleWaveform> waveform_of(const WaveformRow& row) {
  const auto digitiser = place_of(row.digitiser, digitiser_names);
  if (!digitiser) return {};
  return ModuleWaveform{{static_cast<Digitiser>(*digitiser),
                         row.time_ns,
                         row.sample_ns,
                         row.millivolt_per_count,
                         row.baseline,
                         {}},
                        row.repeat,
                        row.launch,
                        {row.string, row.dom}};
}

std::optional<Problem> problem_of(const ModuleRow& row) {
  if (row.on != 0 && row.on != 1) return Problem{fmt::format("on {}", row.on), "0 or 1"};
  if (row.noise_hz >= 0 && row.noise_hz <= 1e6) return {};
  return Problem{fmt::format("noise {}", row.noise_hz), "0 to 1e6 [1/s]"};
}
std::optional<Problem> problem_of(const ReadoutRow& row) {
  if (!(row.afterpulse_share >= 0 && row.afterpulse_share <= 1))
    return Problem{fmt::format("a share {} of afterpulses", row.afterpulse_share), "0 to 1"};
  if (!(row.afterpulse_begin_ns > 0))
    return Problem{fmt::format("afterpulses from {} ns", row.afterpulse_begin_ns), "a time above 0 [ns]"};
  if (auto problem = range_problem(row.begin_ns, row.end_ns)) return problem;
  return range_problem(row.afterpulse_begin_ns, row.afterpulse_end_ns);
}
std::optional<Problem> problem_of(const UnusableRow& row) {
  if (auto problem = range_problem(row.begin_ns, row.end_ns)) return problem;
  if (unusable_of(row)) return {};
  return Problem{"a reason of another name", "saturated or dead"};
}

std::optional<Problem> problem_of(const DelayRow& row) {
  if (!(row.share >= 0 && row.share <= 1)) return Problem{fmt::format("a share {}", row.share), "0 to 1"};
  return range_problem(row.begin_ns, row.end_ns);
}

}  // namespace hdf5
}  // namespace floe
