#include "data/hdf5_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <unordered_set>

#include "data/base/text.h"
#include "data/hdf5_input.h"
#include "data/hdf5_schema.h"

namespace floe {

using namespace hdf5;

namespace {

[[noreturn]] void throw_problem(const Location& where, const Problem& problem, std::string_view table,
                                hsize_t row) {
  throw InputError(where, fmt::format("{} in row {} of '{}'", problem.found, row, table), problem.expected);
}

Provenance read_provenance(const AttributeReader& attributes, const Location& where) {
  Provenance provenance;
  provenance.version = attributes.text("version");
  provenance.command = attributes.text("command");
  provenance.configuration = attributes.text("configuration");
  provenance.ice_name = attributes.text("ice_name");
  provenance.ice_hash = attributes.text("ice_hash");
  provenance.detector_name = attributes.text("detector_name");
  provenance.detector_hash = attributes.text("detector_hash");
  provenance.seed = attributes.whole("seed");
  provenance.oversize = attributes.number("oversize");
  if (!(provenance.oversize > 0 && provenance.oversize < 1e6))
    throw InputError(where, fmt::format("oversize {}", provenance.oversize), "a finite number above 0");
  return provenance;
}

H5T_class_t class_of(ColumnKind kind) {
  switch (kind) {
    case ColumnKind::text:
      return H5T_STRING;
    case ColumnKind::int32:
    case ColumnKind::uint64:
      return H5T_INTEGER;
    default:
      return H5T_FLOAT;
  }
}

// HDF5 leaves a member that the file lacks as it is, so the columns are compared before reading.
void expect_columns(const Hdf5Handle& type, std::span<const Column> columns, const char* table,
                    const Location& where) {
  if (H5Tget_class(type) != H5T_COMPOUND)
    throw InputError(where, fmt::format("a data set '{}' of another kind", table), "a table of compounds");
  for (const Column& column : columns) {
    const int index = H5Tget_member_index(type, column.name);
    if (index < 0)
      throw InputError(where, fmt::format("no column '{}' in '{}'", column.name, table),
                       "the columns of docs/formats.md");
    if (H5Tget_member_class(type, static_cast<unsigned>(index)) != class_of(column.kind))
      throw InputError(where, fmt::format("a column '{}' of another kind in '{}'", column.name, table),
                       "the columns of docs/formats.md");
  }
  const int count = checked(H5Tget_nmembers(type), "read a table's columns");
  if (count != static_cast<int>(columns.size()))
    throw InputError(where, fmt::format("{} columns in '{}'", count, table),
                     fmt::format("the {} columns of docs/formats.md", columns.size()));
}

template <typename Row>
class TableReader {
 public:
  TableReader(hid_t file, const Location& where) : where_(where) {
    constexpr const char* name = Table<Row>::name;
    if (checked(H5Lexists(file, name, H5P_DEFAULT), "look for a table") == 0)
      throw InputError(where, fmt::format("no table '{}'", name), "the tables events, particles and hits");
    table_ = Hdf5Handle(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose, "open a table");
    const Hdf5Handle type(H5Dget_type(table_), H5Tclose, "read a table's columns");
    expect_columns(type, Table<Row>::columns(), name, where);
    row_type_ = row_type_in_memory(Table<Row>::columns(), sizeof(Row));
    const Hdf5Handle space(H5Dget_space(table_), H5Sclose, "read a table's size");
    if (H5Sget_simple_extent_ndims(space) != 1)
      throw InputError(where, fmt::format("a table '{}' that is no list of rows", name), "one dimension");
    checked(H5Sget_simple_extent_dims(space, &size_, nullptr), "read a table's size");
  }

  hsize_t size() const { return size_; }
  const Location& where() const { return where_; }

  // Calls use(row, index) for each row, holding one chunk of them in memory.
  template <typename Use>
  void for_each(const Use& use) const {
    std::vector<Row> rows(Table<Row>::rows_per_chunk);
    for (hsize_t begin = 0; begin < size_; begin += rows.size()) {
      const hsize_t count = std::min<hsize_t>(rows.size(), size_ - begin);
      read_rows(begin, count, rows.data());
      for (hsize_t i = 0; i < count; ++i) use(rows[i], begin + i);
    }
  }

 private:
  void read_rows(hsize_t begin, hsize_t count, Row* rows) const {
    const Hdf5Handle in_file(H5Dget_space(table_), H5Sclose, "select rows");
    checked(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, &begin, nullptr, &count, nullptr), "select rows");
    const Hdf5Handle in_memory(H5Screate_simple(1, &count, nullptr), H5Sclose, "select rows");
    checked(H5Dread(table_, row_type_, in_memory, in_file, H5P_DEFAULT, rows), "read rows");
  }

  const Location& where_;
  Hdf5Handle row_type_, table_;
  hsize_t size_ = 0;
};

// Each event owns a range of rows; together the ranges cover a table without gap.
struct EventRanges {
  std::vector<Event> events;
  std::vector<hsize_t> hit_end, particle_end;  // one past the event's last row
};

void expect_range(const Location& where, const char* table, hsize_t event, hsize_t first, hsize_t count,
                  hsize_t expected_first, hsize_t rows) {
  if (first != expected_first)
    throw InputError(where, fmt::format("event {} whose rows of '{}' begin at {}", event, table, first),
                     fmt::format("{}, where those of the event before end", expected_first));
  if (count > rows - first)
    throw InputError(where, fmt::format("event {} with {} rows of '{}'", event, count, table),
                     fmt::format("at most the {} that are left", rows - first), remake_advice);
}

void expect_covered(const Location& where, const char* table, const std::vector<hsize_t>& ends,
                    hsize_t rows) {
  if (ends.back() != rows)
    throw InputError(where, fmt::format("{} rows of '{}' that belong to no event", rows - ends.back(), table),
                     "every row in one event");
}

EventRanges read_ranges(const TableReader<EventRow>& table, hsize_t hits, hsize_t particles) {
  const Location& where = table.where();
  EventRanges result;
  std::unordered_set<std::string> ids;
  hsize_t hit_end = 0, particle_end = 0;
  table.for_each([&](const EventRow& row, hsize_t index) {
    Event event;
    event.id.assign(row.id, strnlen(row.id, sizeof(row.id)));
    event.repeats = row.repeats;
    if (const auto problem = problem_of_event(event.id, event.repeats))
      throw_problem(where, *problem, "events", index);
    if (!ids.insert(event.id).second)
      throw InputError(where, fmt::format("a second event named '{}'", event.id), "names that differ");
    expect_range(where, "hits", index, row.first_hit, row.hit_count, hit_end, hits);
    expect_range(where, "particles", index, row.first_particle, row.particle_count, particle_end, particles);
    result.hit_end.push_back(hit_end += row.hit_count);
    result.particle_end.push_back(particle_end += row.particle_count);
    result.events.push_back(std::move(event));
  });
  if (result.events.empty()) throw InputError(where, "no events", "at least one event");
  expect_covered(where, "hits", result.hit_end, hits);
  expect_covered(where, "particles", result.particle_end, particles);
  return result;
}

// Gives each row's value, once checked, to the event whose range holds the row.
template <typename Row, typename Convert, typename Keep>
void distribute(const TableReader<Row>& table, EventRanges& ranges, const std::vector<hsize_t>& ends,
                const Convert& convert, const Keep& keep) {
  std::size_t event = 0;
  table.for_each([&](const Row& row, hsize_t index) {
    while (index >= ends[event]) ++event;
    auto value = convert(row);
    if (const auto problem = problem_of(value))
      throw_problem(table.where(), *problem, Table<Row>::name, index);
    keep(ranges.events[event], std::move(value));
  });
}

// The sums of a weighted simulation's events must be what their hits add up to.
void check_weights(const TableReader<WeightRow>& table, const std::vector<Event>& events) {
  std::vector<WeightRow> expected;
  for (std::size_t e = 0; e < events.size(); ++e) {
    ModuleWeights sums;
    add_weights(sums, events[e].hits);
    for (const auto& module : sums) expected.push_back(row_of(e, module));
  }
  if (table.size() != expected.size())
    throw InputError(table.where(), fmt::format("{} rows of 'weights'", table.size()),
                     fmt::format("{}, one for each module with hits in an event", expected.size()));
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-6 * b; };
  table.for_each([&](const WeightRow& row, hsize_t index) {
    const WeightRow& sums = expected[index];
    const bool fits = row.event == sums.event && row.string == sums.string && row.dom == sums.dom &&
                      row.hit_count == sums.hit_count && same(row.weight_sum, sums.weight_sum) &&
                      same(row.squared_weight_sum, sums.squared_weight_sum);
    if (!fits)
      throw InputError(
          table.where(),
          fmt::format("sums {} and {} of {} hits of module {},{} in row {} of 'weights'", row.weight_sum,
                      row.squared_weight_sum, row.hit_count, row.string, row.dom, index),
          fmt::format("{} and {} of {} hits of module {},{} in event {}", sums.weight_sum,
                      sums.squared_weight_sum, sums.hit_count, sums.string, sums.dom, sums.event),
          "The sums do not belong to the hits: make the file again");
  });
}

// Gives each flasher run to its event. Rows go by event, and an event has one at most.
void read_flashers(const TableReader<FlasherRow>& table, std::vector<Event>& events) {
  const Location& where = table.where();
  std::uint64_t next = 0;  // the first event that may follow
  table.for_each([&](const FlasherRow& row, hsize_t index) {
    if (row.event < next || row.event >= events.size())
      throw InputError(
          where, fmt::format("event {} in row {} of 'flashers'", row.event, index),
          fmt::format("a row of 'events' below {}, above that of the row before", events.size()));
    const std::optional<FlasherRun> run = flasher_of(row);
    const Problem unknown_leds{
        "LEDs " + in_quotes(std::string_view(row.leds, strnlen(row.leds, sizeof(row.leds)))),
        std::string(known_led_patterns)};
    if (const auto problem = run ? problem_of(*run) : unknown_leds)
      throw_problem(where, *problem, Table<FlasherRow>::name, index);
    events[row.event].flasher = run;
    next = row.event + 1;
  });
}

bool has_table(hid_t file, const char* name) {
  return checked(H5Lexists(file, name, H5P_DEFAULT), "look for a table") > 0;
}

EventFile read_open_file(hid_t file, const Location& where) {
  const AttributeReader attributes(file, where);
  expect_format(attributes, where, format_name, format_version);
  EventFile result;
  result.provenance = read_provenance(attributes, where);
  const TableReader<EventRow> events(file, where);
  const TableReader<ParticleRow> particles(file, where);
  const TableReader<HitRow> hits(file, where);
  EventRanges ranges = read_ranges(events, hits.size(), particles.size());
  distribute(particles, ranges, ranges.particle_end, particle_of,
             [](Event& event, Particle particle) { event.truth.push_back(std::move(particle)); });
  distribute(hits, ranges, ranges.hit_end, hit_of,
             [](Event& event, const Hit& hit) { event.hits.push_back(hit); });
  result.events = std::move(ranges.events);
  result.provenance->weighted = has_table(file, Table<WeightRow>::name);
  if (result.provenance->weighted) check_weights(TableReader<WeightRow>(file, where), result.events);
  if (has_table(file, Table<FlasherRow>::name))
    read_flashers(TableReader<FlasherRow>(file, where), result.events);
  return result;
}

}  // namespace

EventFile read_hdf5_events(const std::filesystem::path& path) {
  return read_file(path, "an HDF5 event file as 'floe simulate' and 'floe import' write it", read_open_file);
}

}  // namespace floe
