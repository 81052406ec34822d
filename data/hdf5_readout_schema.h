// The tables that stand beside pulses in event files; docs/formats.md explains every field.
#pragma once

#include "data/hdf5_schema.h"
#include "data/readout.h"

namespace floe::hdf5 {

struct ModuleRow {
  std::int32_t string, dom, on;
  double noise_hz;
};
struct ReadoutRow {
  std::uint64_t event;
  double begin_ns, end_ns, afterpulse_share, afterpulse_begin_ns, afterpulse_end_ns;
};
struct UnusableRow {
  std::uint64_t event;
  std::int32_t string, dom;
  double begin_ns, end_ns;
  char reason[16];
};
struct DelayRow {
  std::uint64_t event;
  double share, begin_ns, end_ns;
};
struct PhotonRow {
  std::uint64_t event;
  HitRow hit;
};
struct PhotoelectronRow {
  std::uint64_t event;
  std::int32_t repeat, string, dom;
  double time_ns;
  float charge_pe;
  char origin[16];
};
struct WaveformRow {
  std::uint64_t event;
  std::int32_t repeat, string, dom, launch;
  char digitiser[8];
  double time_ns, sample_ns, millivolt_per_count, baseline;
  std::uint64_t first_sample, sample_count;
};
struct SampleRow {
  std::int32_t counts;
};

#define FLOE_TABLE(Row, table, chunk)                \
  template <>                                        \
  struct Table<Row> {                                \
    static constexpr const char* name = table;       \
    static constexpr hsize_t rows_per_chunk = chunk; \
    static std::span<const Column> columns();        \
  };
FLOE_TABLE(ModuleRow, "modules", 4096)
FLOE_TABLE(ReadoutRow, "readouts", 256)
FLOE_TABLE(UnusableRow, "unusable", 2048)
FLOE_TABLE(DelayRow, "delays", 1024)
FLOE_TABLE(PhotonRow, "photons", 8192)
FLOE_TABLE(PhotoelectronRow, "photoelectrons", 8192)
FLOE_TABLE(WaveformRow, "waveforms", 1024)
FLOE_TABLE(SampleRow, "samples", 65536)
#undef FLOE_TABLE

ModuleRow row_of(const RecordingModule& module);
RecordingModule module_of(const ModuleRow& row);
ReadoutRow row_of(std::uint64_t event, const Readout& readout);
Readout readout_of(const ReadoutRow& row);  // without modules, unusable times, delays
UnusableRow row_of(std::uint64_t event, const UnusableTimes& times);
std::optional<UnusableTimes> unusable_of(const UnusableRow& row);  // none: the reason has no known name
DelayRow row_of(std::uint64_t event, const ExpectedDelay& delay);
ExpectedDelay delay_of(const DelayRow& row);
PhotoelectronRow row_of(std::uint64_t event, const ModulePhotoelectron& photoelectron);
std::optional<ModulePhotoelectron> photoelectron_of(const PhotoelectronRow& row);
WaveformRow row_of(std::uint64_t event, const ModuleWaveform& waveform, std::uint64_t first_sample);
std::optional<ModuleWaveform> waveform_of(const WaveformRow& row);  // without its counts

// What is wrong with a row, in the two parts that an error message needs.
std::optional<Problem> problem_of(const ModuleRow& row);
std::optional<Problem> problem_of(const ReadoutRow& row);
std::optional<Problem> problem_of(const UnusableRow& row);
std::optional<Problem> problem_of(const DelayRow& row);

}  // namespace floe::hdf5
