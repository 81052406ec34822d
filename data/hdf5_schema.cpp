#include "data/hdf5_schema.h"

#include <array>
#include <cstddef>
#include <cstring>

namespace floe::hdf5 {

namespace {

#define FLOE_COLUMN(Row, member, kind)                                    \
  Column {                                                                \
#member, ColumnKind::kind, offsetof(Row, member), sizeof(Row::member) \
  }

constexpr std::array event_columns = {
    FLOE_COLUMN(EventRow, id, text),
    FLOE_COLUMN(EventRow, repeats, float64),
    FLOE_COLUMN(EventRow, first_hit, uint64),
    FLOE_COLUMN(EventRow, hit_count, uint64),
    FLOE_COLUMN(EventRow, first_particle, uint64),
    FLOE_COLUMN(EventRow, particle_count, uint64),
};
constexpr std::array particle_columns = {
    FLOE_COLUMN(ParticleRow, name, text),          FLOE_COLUMN(ParticleRow, x, float64),
    FLOE_COLUMN(ParticleRow, y, float64),          FLOE_COLUMN(ParticleRow, z, float64),
    FLOE_COLUMN(ParticleRow, zenith_deg, float64), FLOE_COLUMN(ParticleRow, azimuth_deg, float64),
    FLOE_COLUMN(ParticleRow, length_m, float64),   FLOE_COLUMN(ParticleRow, energy_gev, float64),
    FLOE_COLUMN(ParticleRow, time_ns, float64),
};
constexpr std::array all_hit_columns = {
    FLOE_COLUMN(HitRow, string, int32),          FLOE_COLUMN(HitRow, dom, int32),
    FLOE_COLUMN(HitRow, time_ns, float64),       FLOE_COLUMN(HitRow, charge_pe, float32),
    FLOE_COLUMN(HitRow, wavelength_nm, float32), FLOE_COLUMN(HitRow, direction_x, float32),
    FLOE_COLUMN(HitRow, direction_y, float32),   FLOE_COLUMN(HitRow, direction_z, float32),
    FLOE_COLUMN(HitRow, inward_x, float32),      FLOE_COLUMN(HitRow, inward_y, float32),
    FLOE_COLUMN(HitRow, inward_z, float32),      FLOE_COLUMN(HitRow, width_ns, float32),
};
constexpr std::array weight_columns = {
    FLOE_COLUMN(WeightRow, event, uint64),       FLOE_COLUMN(WeightRow, string, int32),
    FLOE_COLUMN(WeightRow, dom, int32),          FLOE_COLUMN(WeightRow, hit_count, uint64),
    FLOE_COLUMN(WeightRow, weight_sum, float64), FLOE_COLUMN(WeightRow, squared_weight_sum, float64),
};
constexpr std::array flasher_columns = {
    FLOE_COLUMN(FlasherRow, event, uint64),
    FLOE_COLUMN(FlasherRow, string, int32),
    FLOE_COLUMN(FlasherRow, dom, int32),
    FLOE_COLUMN(FlasherRow, leds, text),
    FLOE_COLUMN(FlasherRow, orientation_deg, float64),
    FLOE_COLUMN(FlasherRow, wavelength_nm, float64),
    FLOE_COLUMN(FlasherRow, width_deg, float64),
    FLOE_COLUMN(FlasherRow, pulse_width_ns, float64),
    FLOE_COLUMN(FlasherRow, photons, float64),
    FLOE_COLUMN(FlasherRow, oversize, float64),
};
#undef FLOE_COLUMN

Hdf5Handle padded_text_type(std::size_t size) {
  // The type that numpy gives to bytes ("S128"), so that files made with h5py fit too.
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  checked(H5Tset_size(type, size), "set the size of a text type");
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "set the padding of a text type");
  return type;
}

hid_t number_in_memory(ColumnKind kind) {
  switch (kind) {
    case ColumnKind::uint8:
      return H5T_NATIVE_UINT8;
    case ColumnKind::int32:
      return H5T_NATIVE_INT32;
    case ColumnKind::uint32:
      return H5T_NATIVE_UINT32;
    case ColumnKind::int64:
      return H5T_NATIVE_INT64;
    case ColumnKind::uint64:
      return H5T_NATIVE_UINT64;
    case ColumnKind::float32:
      return H5T_NATIVE_FLOAT;
    default:
      return H5T_NATIVE_DOUBLE;
  }
}

hid_t number_in_file(ColumnKind kind) {
  switch (kind) {
    case ColumnKind::uint8:
      return H5T_STD_U8LE;
    case ColumnKind::int32:
      return H5T_STD_I32LE;
    case ColumnKind::uint32:
      return H5T_STD_U32LE;
    case ColumnKind::int64:
      return H5T_STD_I64LE;
    case ColumnKind::uint64:
      return H5T_STD_U64LE;
    case ColumnKind::float32:
      return H5T_IEEE_F32LE;
    default:
      return H5T_IEEE_F64LE;
  }
}

void insert_column(const Hdf5Handle& row, const Column& column, std::size_t offset, hid_t number) {
  if (column.kind == ColumnKind::text)
    checked(H5Tinsert(row, column.name, offset, padded_text_type(column.size)), "describe a column");
  else
    checked(H5Tinsert(row, column.name, offset, number), "describe a column");
}

}  // namespace

std::span<const Column> Table<EventRow>::columns() {
  return event_columns;
}
std::span<const Column> Table<ParticleRow>::columns() {
  return particle_columns;
}
std::span<const Column> Table<WeightRow>::columns() {
  return weight_columns;
}
std::span<const Column> Table<FlasherRow>::columns() {
  return flasher_columns;
}
std::span<const Column> Table<HitRow>::columns() {
  return std::span(all_hit_columns).first(all_hit_columns.size() - 1);
}
std::span<const Column> pulse_columns() {
  return all_hit_columns;
}

Hdf5Handle row_type_in_memory(std::span<const Column> columns, std::size_t row_size) {
  Hdf5Handle row(H5Tcreate(H5T_COMPOUND, row_size), H5Tclose, "make a row type");
  for (const Column& column : columns)
    insert_column(row, column, column.offset, number_in_memory(column.kind));
  return row;
}

Hdf5Handle row_type_in_file(std::span<const Column> columns) {
  std::size_t size = 0;
  for (const Column& column : columns) size += column.size;
  Hdf5Handle row(H5Tcreate(H5T_COMPOUND, size), H5Tclose, "make a row type");
  std::size_t offset = 0;
  for (const Column& column : columns) {
    insert_column(row, column, offset, number_in_file(column.kind));
    offset += column.size;
  }
  return row;
}

Hdf5Handle utf8_type(std::size_t size) {
  Hdf5Handle type = padded_text_type(size);
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "set the encoding of a text type");
  return type;
}

WeightRow row_of(std::uint64_t event, const ModuleWeights::value_type& module) {
  const auto& [id, sums] = module;
  return {event, id.string, id.dom, sums.hits, sums.sum, sums.squares};
}

FlasherRow row_of(std::uint64_t event, const FlasherRun& run) {
  FlasherRow row{
      event,          run.module.string,       run.module.dom,  {},          run.orientation / degree,
      run.wavelength, run.beam_width / degree, run.pulse_width, run.photons, run.oversize};
  name_of(run.leds).copy(row.leds, sizeof(row.leds));
  return row;
}

std::optional<FlasherRun> flasher_of(const FlasherRow& row) {
  const auto leds = led_pattern_of({row.leds, strnlen(row.leds, sizeof(row.leds))});
  if (!leds) return {};
  return FlasherRun{{row.string, row.dom},
                    *leds,
                    row.orientation_deg * degree,
                    row.wavelength_nm,
                    row.width_deg * degree,
                    row.pulse_width_ns,
                    row.photons,
                    row.oversize};
}

HitRow row_of(const Hit& hit) {
  return {hit.module.string, hit.module.dom,    hit.time,          hit.charge,
          hit.wavelength,    hit.direction.x(), hit.direction.y(), hit.direction.z(),
          hit.inward.x(),    hit.inward.y(),    hit.inward.z(),    hit.width};
}

Hit hit_of(const HitRow& row) {
  return {{row.string, row.dom},
          row.time_ns,
          row.charge_pe,
          row.wavelength_nm,
          {row.direction_x, row.direction_y, row.direction_z},
          {row.inward_x, row.inward_y, row.inward_z},
          row.width_ns};
}

ParticleRow row_of(const Particle& particle) {
  ParticleRow row{{},
                  particle.position.x(),
                  particle.position.y(),
                  particle.position.z(),
                  particle.zenith / degree,
                  particle.azimuth / degree,
                  particle.length,
                  particle.energy,
                  particle.time};
  particle.name.copy(row.name, sizeof(row.name));
  return row;
}

Particle particle_of(const ParticleRow& row) {
  return {std::string(row.name, strnlen(row.name, sizeof(row.name))),
          {row.x, row.y, row.z},
          row.zenith_deg * degree,
          row.azimuth_deg * degree,
          row.length_m,
          row.energy_gev,
          row.time_ns};
}

}  // namespace floe::hdf5
