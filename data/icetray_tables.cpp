#include "data/icetray_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "data/base/atomic_file.h"
#include "data/base/error.h"
#include "data/event_rules.h"
#include "data/hdf5_reader.h"
#include "data/hdf5_table_reader.h"
#include "data/hdf5_table_writer.h"

namespace floe {

using namespace hdf5;

namespace {

constexpr const char* index_group = "__I3Index__";

// What every row of such files begins with.
struct EventNumber {
  std::uint32_t run = 0, event = 0, sub_event = 0, stream = 0;
  auto operator<=>(const EventNumber&) const = default;
};
struct PulseRow {
  EventNumber number;
  std::uint8_t exists;
  std::int32_t string;
  std::uint32_t om;
  std::uint8_t pmt;
  std::uint32_t vector_index;
  double time, width, charge;
};
struct IndexRow {
  EventNumber number;
  std::uint8_t exists;
  std::int64_t start, stop;
};

}  // namespace

template <>
struct hdf5::Table<PulseRow> {
  static constexpr const char* name = usual_icetray_table;
  static constexpr hsize_t rows_per_chunk = 16384;
};
template <>
struct hdf5::Table<IndexRow> {
  static constexpr const char* name = usual_icetray_table;
  static constexpr hsize_t rows_per_chunk = 256;
};

namespace {

template <typename Row>
constexpr std::array<Column, 5> first_columns() {
  constexpr std::size_t at = offsetof(Row, number);
  return {Column{"Run", ColumnKind::uint32, at + offsetof(EventNumber, run), 4},
          Column{"Event", ColumnKind::uint32, at + offsetof(EventNumber, event), 4},
          Column{"SubEvent", ColumnKind::uint32, at + offsetof(EventNumber, sub_event), 4},
          Column{"SubEventStream", ColumnKind::uint32, at + offsetof(EventNumber, stream), 4},
          Column{"exists", ColumnKind::uint8, offsetof(Row, exists), 1}};
}

std::vector<Column> pulse_row_columns() {
  constexpr auto first = first_columns<PulseRow>();
  std::vector<Column> columns(first.begin(), first.end());
  columns.insert(columns.end(), {{"string", ColumnKind::int32, offsetof(PulseRow, string), 4},
                                 {"om", ColumnKind::uint32, offsetof(PulseRow, om), 4},
                                 {"pmt", ColumnKind::uint8, offsetof(PulseRow, pmt), 1},
                                 {"vector_index", ColumnKind::uint32, offsetof(PulseRow, vector_index), 4},
                                 {"time", ColumnKind::float64, offsetof(PulseRow, time), 8},
                                 {"width", ColumnKind::float64, offsetof(PulseRow, width), 8},
                                 {"charge", ColumnKind::float64, offsetof(PulseRow, charge), 8}});
  return columns;
}

std::vector<Column> index_columns() {
  constexpr auto first = first_columns<IndexRow>();
  std::vector<Column> columns(first.begin(), first.end());
  columns.insert(columns.end(), {{"start", ColumnKind::int64, offsetof(IndexRow, start), 8},
                                 {"stop", ColumnKind::int64, offsetof(IndexRow, stop), 8}});
  return columns;
}

Hdf5Handle open_file(const std::filesystem::path& path) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "set up the file");
  checked(H5Pset_file_locking(access, false, true), "set up the file");
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose, "open the file"};
}

// Does `work`; what HDF5 cannot read is an InputError.
template <typename Work>
auto guarded_read(const std::filesystem::path& path, const Work& work) {
  const Hdf5Silence silence;
  try {
    return work();
  } catch (const Hdf5Failure& failure) {
    throw InputError({path.string()}, fmt::format("HDF5 that cannot be read ({})", failure.what()),
                     "a whole HDF5 file", "The file is truncated or damaged: copy it again or make it again");
  }
}

// Tables with an index, of modules' times and charges.
std::vector<std::string> pulse_tables(hid_t file) {
  const Hdf5Handle group(H5Gopen2(file, index_group, H5P_DEFAULT), H5Gclose, "open the index");
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* into) -> herr_t {
    static_cast<std::vector<std::string>*>(into)->emplace_back(name);
    return 0;
  };
  checked(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "list the tables");
  std::erase_if(names, [file](const std::string& name) {
    if (!has_table(file, name.c_str())) return true;
    for (const char* column : {"string", "om", "time", "charge"})
      if (!has_column(file, name.c_str(), column)) return true;
    return false;
  });
  return names;
}

std::string table_to_read(hid_t file, const Location& where, const std::optional<std::string>& asked) {
  const std::vector<std::string> names = pulse_tables(file);
  if (names.empty())
    throw InputError(where, "no table with the columns string, om, time and charge", "a table of pulses");
  if (asked) {
    if (std::find(names.begin(), names.end(), *asked) != names.end()) return *asked;
    throw InputError(where, fmt::format("no table '{}'", *asked),
                     fmt::format("one of {}", fmt::join(names, ", ")));
  }
  if (names.size() > 1)
    throw InputError(where, fmt::format("{} tables of pulses: {}", names.size(), fmt::join(names, ", ")),
                     "one", "floe import FILE --table NAME -o EVENTS.h5 takes the one that you name");
  return names.front();
}

std::string id_of(const EventNumber& number) {
  if (number.sub_event == 0 && number.stream == 0) return fmt::format("{}-{}", number.run, number.event);
  return fmt::format("{}-{}-{}-{}", number.run, number.event, number.sub_event, number.stream);
}

EventNumber number_of(const std::string& id, std::size_t place) {
  EventNumber number;
  int end = -1;
  if (std::sscanf(id.c_str(), "%u-%u-%u-%u%n", &number.run, &number.event, &number.sub_event, &number.stream,
                  &end) == 4 &&
      end == static_cast<int>(id.size()))
    return number;
  number = {};
  if (std::sscanf(id.c_str(), "%u-%u%n", &number.run, &number.event, &end) == 2 &&
      end == static_cast<int>(id.size()))
    return number;
  return {0, static_cast<std::uint32_t>(place), 0, 0};
}

void add_pulse(const PulseRow& row, hsize_t index, const std::string& table, const Location& where,
               Event& event) {
  if (row.exists == 0 || row.charge == 0) return;
  Hit hit;
  hit.module = {row.string, static_cast<int>(row.om)};
  hit.time = row.time;
  hit.charge = static_cast<float>(row.charge);
  hit.width = static_cast<float>(row.width);
  if (const auto problem = problem_of(hit))
    throw InputError(where, fmt::format("{} in row {} of '{}'", problem->found, index, table),
                     problem->expected);
  event.hits.push_back(hit);
}

std::vector<Event> read_table(hid_t file, const Location& where, const std::string& name) {
  std::vector<Column> columns = pulse_row_columns();
  const auto optional = [&](const Column& column) {
    return std::string_view(column.name) == "width" || std::string_view(column.name) == "pmt" ||
           std::string_view(column.name) == "vector_index";
  };
  std::erase_if(columns, [&](const Column& column) {
    return optional(column) && !has_column(file, name.c_str(), column.name);
  });
  const TableReader<PulseRow> pulses(file, where, columns, name.c_str(), OtherColumns::allowed);
  const std::string index_name = std::string(index_group) + "/" + name;
  const TableReader<IndexRow> index(file, where, index_columns(), index_name.c_str(), OtherColumns::allowed);
  std::vector<Event> events;
  index.for_each([&](const IndexRow& row, hsize_t place) {
    if (row.start < 0 || row.stop < row.start || static_cast<hsize_t>(row.stop) > pulses.size())
      throw InputError(where,
                       fmt::format("rows {} to {} in row {} of '{}'", row.start, row.stop, place, index_name),
                       fmt::format("rows of '{}', which has {}", name, pulses.size()));
    Event event;
    event.id = id_of(row.number);
    pulses.for_each(static_cast<hsize_t>(row.start), static_cast<hsize_t>(row.stop),
                    [&](const PulseRow& pulse, hsize_t at) { add_pulse(pulse, at, name, where, event); });
    events.push_back(std::move(event));
  });
  if (events.empty()) throw InputError(where, "no events", "at least one event");
  return events;
}

std::vector<const Hit*> by_module(const Event& event) {
  std::vector<const Hit*> hits;
  for (const Hit& hit : event.hits) hits.push_back(&hit);
  std::stable_sort(hits.begin(), hits.end(), [](const Hit* a, const Hit* b) {
    return std::pair(a->module, a->time) < std::pair(b->module, b->time);
  });
  return hits;
}

void write_tables(hid_t file, std::span<const Event> events, const std::string& name) {
  Hdf5Handle group(H5Gcreate2(file, index_group, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                   "make the index");
  TableWriter<PulseRow> pulses(file, pulse_row_columns(), name.c_str());
  TableWriter<IndexRow> index(group, index_columns(), name.c_str());
  for (std::size_t place = 0; place < events.size(); ++place) {
    const EventNumber number = number_of(events[place].id, place);
    const hsize_t start = pulses.size();
    ModuleId module;
    std::uint32_t vector_index = 0;
    for (const Hit* hit : by_module(events[place])) {
      vector_index = hit->module == module ? vector_index + 1 : 0;
      module = hit->module;
      pulses.append({number, 1, module.string, static_cast<std::uint32_t>(module.dom), 0, vector_index,
                     hit->time, std::isnan(hit->width) ? 0.0 : double(hit->width), double(hit->charge)});
    }
    index.append({number, static_cast<std::uint8_t>(pulses.size() > start), static_cast<std::int64_t>(start),
                  static_cast<std::int64_t>(pulses.size())});
  }
  pulses.close();
  index.close();
}

}  // namespace

bool is_icetray_file(const std::filesystem::path& path) {
  if (!is_hdf5(path)) return false;
  return guarded_read(path, [&] { return has_table(open_file(path), index_group); });
}

std::vector<Event> read_icetray_pulses(const std::filesystem::path& path,
                                       const std::optional<std::string>& table) {
  return guarded_read(path, [&] {
    const Location where{path.string()};
    const Hdf5Handle file = open_file(path);
    return read_table(file, where, table_to_read(file, where, table));
  });
}

void write_icetray_pulses(const std::filesystem::path& path, std::span<const Event> events,
                          const std::string& table) {
  for (const Event& event : events)
    if (event.repeats != 1)
      throw UsageError(
          fmt::format("event '{}' is an average over {} events, which IceTray's tables cannot say. "
                      "Export it as .dat or .csv",
                      event.id, event.repeats));
  AtomicFile target(path);
  guarded(path, [&] {
    Hdf5Handle file = create_file(target.temporary());
    write_tables(file, events, table);
    file.close("close the file");
  });
  target.commit();
}

}  // namespace floe
