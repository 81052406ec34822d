// The layout of floe's event files, shared by reader and writer; docs/formats.md explains every field.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "data/event.h"
#include "data/event_rules.h"
#include "data/hdf5_handle.h"
#include "data/weights.h"

namespace floe::hdf5 {

inline constexpr const char* format_name = "floe-events";
inline constexpr std::uint64_t format_version = 1;

// Rows of the three tables as they are in memory.
struct EventRow {
  char id[longest_event_id];  // filled up with NUL
  double repeats;
  std::uint64_t first_hit, hit_count, first_particle, particle_count;
};
struct ParticleRow {
  char name[16];
  double x, y, z, zenith_deg, azimuth_deg, length_m, energy_gev, time_ns;
};
struct HitRow {
  std::int32_t string, dom;
  double time_ns;
  float charge_pe, wavelength_nm;
  float direction_x, direction_y, direction_z, inward_x, inward_y, inward_z;
  float width_ns = Hit::unknown;  // only of pulses
};

// Text is NUL-padded bytes (UTF-8), numbers little endian.
enum class ColumnKind { text, uint8, int32, uint32, int64, uint64, float32, float64 };
struct Column {
  const char* name;
  ColumnKind kind;
  std::size_t offset, size;  // in the row [bytes]
};

// A module's hits in an event of a weighted simulation.
struct WeightRow {
  std::uint64_t event;  // its row of the table of events
  std::int32_t string, dom;
  std::uint64_t hit_count;
  double weight_sum, squared_weight_sum;
};

// What is known of an event that is a flasher run.
struct FlasherRow {
  std::uint64_t event;  // its row of the table of events
  std::int32_t string, dom;
  char leds[16];  // filled up with NUL
  double orientation_deg, wavelength_nm, width_deg, pulse_width_ns, photons, oversize;
};

// A table is a one-dimensional data set of compounds.
template <typename Row>
struct Table;  // has: name, rows_per_chunk, columns()
template <>
struct Table<EventRow> {
  static constexpr const char* name = "events";
  static constexpr hsize_t rows_per_chunk = 256;
  static std::span<const Column> columns();
};
template <>
struct Table<ParticleRow> {
  static constexpr const char* name = "particles";
  static constexpr hsize_t rows_per_chunk = 1024;
  static std::span<const Column> columns();
};
template <>
struct Table<WeightRow> {
  static constexpr const char* name = "weights";
  static constexpr hsize_t rows_per_chunk = 4096;
  static std::span<const Column> columns();
};
template <>
struct Table<FlasherRow> {
  static constexpr const char* name = "flashers";
  static constexpr hsize_t rows_per_chunk = 256;
  static std::span<const Column> columns();
};
template <>
struct Table<HitRow> {
  static constexpr const char* name = "hits";
  static constexpr hsize_t rows_per_chunk = 16384;
  static std::span<const Column> columns();
};

// Of `hits` in files of pulses: one more than those of the table, the width.
std::span<const Column> pulse_columns();

// The compound type of a row in memory, and, packed and little endian, in the file.
Hdf5Handle row_type_in_memory(std::span<const Column> columns, std::size_t row_size);
Hdf5Handle row_type_in_file(std::span<const Column> columns);

// The type of a text attribute: `size` > 0 bytes of UTF-8.
Hdf5Handle utf8_type(std::size_t size);

WeightRow row_of(std::uint64_t event, const ModuleWeights::value_type& module);
FlasherRow row_of(std::uint64_t event, const FlasherRun& run);
// None where the row's LEDs have no known name.
std::optional<FlasherRun> flasher_of(const FlasherRow& row);
HitRow row_of(const Hit& hit);
Hit hit_of(const HitRow& row);
ParticleRow row_of(const Particle& particle);
Particle particle_of(const ParticleRow& row);

}  // namespace floe::hdf5
