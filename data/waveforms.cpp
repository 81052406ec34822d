#include "data/waveforms.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstring>

#include "data/base/error.h"
#include "data/hdf5_input.h"
#include "data/hdf5_schema.h"

namespace floe {

using namespace hdf5;

namespace {

struct Trace {
  std::uint64_t event;
  std::int32_t repeat, string, dom;
  char digitiser[8];
  double time_ns, sample_ns, millivolt_per_count, baseline;
  std::uint64_t first_sample, sample_count;
};

#define FLOE_COLUMN(member, kind)                                             \
  Column {                                                                    \
#member, ColumnKind::kind, offsetof(Trace, member), sizeof(Trace::member) \
  }
constexpr Column trace_columns[] = {
    FLOE_COLUMN(event, uint64),        FLOE_COLUMN(repeat, int32),
    FLOE_COLUMN(string, int32),        FLOE_COLUMN(dom, int32),
    FLOE_COLUMN(digitiser, text),      FLOE_COLUMN(time_ns, float64),
    FLOE_COLUMN(sample_ns, float64),   FLOE_COLUMN(millivolt_per_count, float64),
    FLOE_COLUMN(baseline, float64),    FLOE_COLUMN(first_sample, uint64),
    FLOE_COLUMN(sample_count, uint64),
};
#undef FLOE_COLUMN
constexpr Column count_columns[] = {{"counts", ColumnKind::int32, 0, sizeof(std::int32_t)}};

// A table of compounds of which some columns are wanted, read in parts.
class Rows {
 public:
  Rows(hid_t file, const char* name, std::span<const Column> columns, std::size_t row_size,
       const Location& where)
      : table_(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose, "open a table") {
    const Hdf5Handle type(H5Dget_type(table_), H5Tclose, "read a table's columns");
    for (const Column& column : columns)
      if (H5Tget_class(type) != H5T_COMPOUND || H5Tget_member_index(type, column.name) < 0)
        throw InputError(where, fmt::format("no column '{}' in '{}'", column.name, name),
                         "the columns of docs/formats.md");
    row_type_ = row_type_in_memory(columns, row_size);
    const Hdf5Handle space(H5Dget_space(table_), H5Sclose, "read a table's size");
    checked(H5Sget_simple_extent_dims(space, &size_, nullptr), "read a table's size");
  }

  hsize_t size() const { return size_; }
  void read(hsize_t begin, hsize_t count, void* rows) const {
    const Hdf5Handle in_file(H5Dget_space(table_), H5Sclose, "select rows");
    checked(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, &begin, nullptr, &count, nullptr), "select rows");
    const Hdf5Handle in_memory(H5Screate_simple(1, &count, nullptr), H5Sclose, "select rows");
    checked(H5Dread(table_, row_type_, in_memory, in_file, H5P_DEFAULT, rows), "read rows");
  }

 private:
  Hdf5Handle table_, row_type_;
  hsize_t size_ = 0;
};

Waveform waveform_of(const Trace& trace, const Rows& samples, const Location& where) {
  if (trace.first_sample > samples.size() || trace.sample_count > samples.size() - trace.first_sample)
    throw InputError(where,
                     fmt::format("samples {} to {} of a waveform", trace.first_sample,
                                 trace.first_sample + trace.sample_count),
                     fmt::format("rows of 'samples', of which there are {}", samples.size()));
  Waveform waveform;
  waveform.module = {trace.string, trace.dom};
  waveform.digitiser.assign(trace.digitiser, strnlen(trace.digitiser, sizeof(trace.digitiser)));
  waveform.time = trace.time_ns;
  waveform.sample = trace.sample_ns;
  waveform.millivolt_per_count = trace.millivolt_per_count;
  waveform.baseline = trace.baseline;
  waveform.counts.resize(trace.sample_count);
  if (trace.sample_count > 0) samples.read(trace.first_sample, trace.sample_count, waveform.counts.data());
  return waveform;
}

std::vector<Waveform> read_open_file(hid_t file, std::uint64_t event, const Location& where) {
  std::vector<Waveform> waveforms;
  for (const char* name : {"waveforms", "samples"})
    if (checked(H5Lexists(file, name, H5P_DEFAULT), "look for a table") == 0) return waveforms;
  const Rows traces(file, "waveforms", trace_columns, sizeof(Trace), where);
  const Rows samples(file, "samples", count_columns, sizeof(std::int32_t), where);
  constexpr hsize_t portion = 4096;
  std::vector<Trace> rows(portion);
  for (hsize_t begin = 0; begin < traces.size(); begin += portion) {
    const hsize_t count = std::min(portion, traces.size() - begin);
    traces.read(begin, count, rows.data());
    for (hsize_t i = 0; i < count; ++i)
      if (rows[i].event == event && rows[i].repeat == 0)
        waveforms.push_back(waveform_of(rows[i], samples, where));
  }
  return waveforms;
}

}  // namespace

std::vector<Waveform> read_waveforms(const std::filesystem::path& path, std::uint64_t event) {
  if (!is_hdf5(path)) return {};
  const Location where{path.string()};
  const Hdf5Silence silence;
  try {
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open the file");
    return read_open_file(file, event, where);
  } catch (const Hdf5Failure& failure) {
    throw InputError(where, fmt::format("HDF5 that cannot be read ({})", failure.what()),
                     "a whole HDF5 file");
  }
}

}  // namespace floe
