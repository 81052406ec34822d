#include "data/hdf5_reader.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <unordered_set>

#include "data/base/text.h"
#include "data/event_stream.h"
#include "data/hdf5_input.h"
#include "data/hdf5_readout_schema.h"
#include "data/hdf5_schema.h"
#include "data/hdf5_table_reader.h"

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

// The sums of a weighted simulation's events must be what their hits add up to.
void check_sums(const TableReader<WeightRow>& table, const std::vector<Event>& events) {
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

// Rows of tables that have at most one for an event go by event. `next` is the first that may follow.
void expect_next(const Location& where, const char* table, hsize_t index, std::uint64_t event,
                 std::uint64_t& next, std::size_t events) {
  if (event < next || event >= events)
    throw InputError(where, fmt::format("event {} in row {} of '{}'", event, index, table),
                     fmt::format("a row of 'events' below {}, above that of the row before", events));
  next = event + 1;
}

// Rows are found by their event (rows_of), which takes that they go by it.
template <typename Row>
void expect_rows_by_event(const TableReader<Row>& table, std::size_t events) {
  std::uint64_t last = 0;
  table.for_each([&](const Row& row, hsize_t index) {
    if (row.event < last || row.event >= events)
      throw InputError(table.where(),
                       fmt::format("event {} in row {} of '{}'", row.event, index, Table<Row>::name),
                       fmt::format("a row of 'events' below {}, not below that of the row before", events));
    last = row.event;
  });
}

// Gives each flasher run to its event. Rows go by event, and an event has one at most.
void read_flashers(const TableReader<FlasherRow>& table, std::vector<Event>& events) {
  const Location& where = table.where();
  std::uint64_t next = 0;  // the first event that may follow
  table.for_each([&](const FlasherRow& row, hsize_t index) {
    expect_next(where, "flashers", index, row.event, next, events.size());
    const std::optional<FlasherRun> run = flasher_of(row);
    const Problem unknown_leds{
        "LEDs " + in_quotes(std::string_view(row.leds, strnlen(row.leds, sizeof(row.leds)))),
        std::string(known_led_patterns)};
    if (const auto problem = run ? problem_of(*run) : unknown_leds)
      throw_problem(where, *problem, Table<FlasherRow>::name, index);
    events[row.event].flasher = run;
  });
}

// The same of readouts, all with the file's modules.
void read_readouts(const TableReader<ReadoutRow>& table, const TableReader<ModuleRow>& modules,
                   std::vector<Event>& events) {
  const Location& where = table.where();
  RecordingModules list;
  modules.for_each([&](const ModuleRow& row, hsize_t index) {
    if (const auto problem = problem_of(row)) throw_problem(where, *problem, "modules", index);
    list.push_back(module_of(row));
  });
  const auto shared = std::make_shared<const RecordingModules>(std::move(list));
  std::uint64_t next = 0;
  table.for_each([&](const ReadoutRow& row, hsize_t index) {
    expect_next(where, "readouts", index, row.event, next, events.size());
    if (const auto problem = problem_of(row)) throw_problem(where, *problem, "readouts", index);
    events[row.event].readout = readout_of(row);
    events[row.event].readout->modules = shared;
  });
}

}  // namespace

bool is_hdf5(const std::filesystem::path& path) {
  constexpr std::array<char, 8> signature = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  expect_readable_file(path);
  std::array<char, 8> begin{};
  std::ifstream(path, std::ios::binary).read(begin.data(), begin.size());
  return begin == signature;
}

struct EventFileReader::Impl {
  explicit Impl(const std::filesystem::path& path) : where{path.string()} {
    expect_hdf5(path, "an HDF5 event file as 'floe simulate' and 'floe import' write it");
    guarded([&] { open(path); });
  }
  ~Impl() {
    const Hdf5Silence silence;
    events.reset(), particles.reset(), hits.reset(), weights.reset(), unusable.reset(), delays.reset();
    photons.reset(), photoelectrons.reset(), waveforms.reset(), samples.reset();
    file = {};
  }

  // Does `work` without messages from HDF5 itself; what HDF5 cannot read is an InputError.
  template <typename Work>
  void guarded(const Work& work) const {
    const Hdf5Silence silence;
    try {
      work();
    } catch (const Hdf5Failure& failure) {
      throw_input_error(where.file, failure);
    }
  }

  void open(const std::filesystem::path& path) {
    file = open_for_reading(path);
    const AttributeReader attributes(file, where);
    expect_format(attributes, where, format_name, format_version);
    provenance = read_provenance(attributes, where);
    events.emplace(file, where), particles.emplace(file, where);
    provenance.pulses = has_table(file, "hits") && has_column(file, "hits", "width_ns");
    hits.emplace(file, where, provenance.pulses ? pulse_columns() : Table<HitRow>::columns());
    ranges = read_ranges(*events, hits->size(), particles->size());
    provenance.weighted = open_if_there(weights);
    if (has_table(file, "flashers")) read_flashers(TableReader<FlasherRow>(file, where), ranges.events);
    if (has_table(file, "readouts"))
      read_readouts(TableReader<ReadoutRow>(file, where), TableReader<ModuleRow>(file, where), ranges.events);
    open_if_there(unusable), open_if_there(delays), open_if_there(photons), open_if_there(photoelectrons);
    if (open_if_there(waveforms)) samples.emplace(file, where);
  }

  template <typename Row>
  bool open_if_there(std::optional<TableReader<Row>>& table) {
    if (!has_table(file, Table<Row>::name)) return false;
    table.emplace(file, where);
    expect_rows_by_event(*table, ranges.events.size());
    return true;
  }

  // Values of rows [begin, end), each checked.
  template <typename Row, typename Convert>
  auto values(const TableReader<Row>& table, std::pair<hsize_t, hsize_t> rows, const Convert& convert) const {
    std::vector<decltype(convert(std::declval<const Row&>()))> result;
    result.reserve(rows.second - rows.first);
    table.for_each(rows.first, rows.second, [&](const Row& row, hsize_t index) {
      result.push_back(convert(row));
      if (const auto problem = problem_of(result.back()))
        throw_problem(where, *problem, Table<Row>::name, index);
    });
    return result;
  }

  // Values of an event's rows, of a table that the file may not have; `convert` finds none in rows with names
  // that are not known.
  template <typename Row, typename Value, typename Convert>
  void add_values(const std::optional<TableReader<Row>>& table, std::size_t event, const Convert& convert,
                  std::vector<Value>& result) const {
    if (!table) return;
    const auto [begin, end] = table->rows_of(event);
    table->for_each(begin, end, [&](const Row& row, hsize_t index) {
      const std::optional<Value> value = convert(row);
      if (!value)
        throw InputError(where, fmt::format("an unknown name in row {} of '{}'", index, Table<Row>::name),
                         "the names of docs/formats.md");
      result.push_back(*value);
    });
  }

  // Rows of an event as they are, each checked.
  template <typename Row>
  std::vector<Row> rows(const TableReader<Row>& table, std::size_t event) const {
    return values(table, table.rows_of(event), [](const Row& row) { return row; });
  }

  std::vector<ExpectedDelay> delays_of(std::size_t event) const {
    std::vector<ExpectedDelay> list;
    double sum = 0;
    for (const DelayRow& row : rows(*delays, event)) {
      list.push_back(delay_of(row));
      sum += row.share;
    }
    if (sum > 1)
      throw InputError(where, fmt::format("shares of event {} in 'delays' with a sum of {:g}", event, sum),
                       "1 at most", remake_advice);
    return list;
  }

  std::pair<hsize_t, hsize_t> range(const std::vector<hsize_t>& ends, std::size_t event) const {
    return {event == 0 ? 0 : ends[event - 1], ends[event]};
  }

  Location where;
  Hdf5Handle file;
  Provenance provenance;
  std::optional<TableReader<EventRow>> events;
  std::optional<TableReader<ParticleRow>> particles;
  std::optional<TableReader<HitRow>> hits;
  std::optional<TableReader<WeightRow>> weights;
  std::optional<TableReader<UnusableRow>> unusable;
  std::optional<TableReader<DelayRow>> delays;
  std::optional<TableReader<PhotonRow>> photons;
  std::optional<TableReader<PhotoelectronRow>> photoelectrons;
  std::optional<TableReader<WaveformRow>> waveforms;
  std::optional<TableReader<SampleRow>> samples;
  EventRanges ranges;  // events without hits and particles
};

EventFileReader::EventFileReader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
EventFileReader::~EventFileReader() = default;
EventFileReader::EventFileReader(EventFileReader&&) noexcept = default;
EventFileReader& EventFileReader::operator=(EventFileReader&&) noexcept = default;

const Provenance& EventFileReader::provenance() const {
  return impl_->provenance;
}
std::size_t EventFileReader::size() const {
  return impl_->ranges.events.size();
}
const std::string& EventFileReader::id(std::size_t event) const {
  return impl_->ranges.events[event].id;
}
std::size_t EventFileReader::hit_count(std::size_t event) const {
  const auto [begin, end] = impl_->range(impl_->ranges.hit_end, event);
  return end - begin;
}

Event EventFileReader::read(std::size_t event) const {
  Event result = impl_->ranges.events[event];
  impl_->guarded([&] {
    result.truth =
        impl_->values(*impl_->particles, impl_->range(impl_->ranges.particle_end, event), particle_of);
    result.hits = impl_->values(*impl_->hits, impl_->range(impl_->ranges.hit_end, event), hit_of);
    if (!result.readout) return;
    if (impl_->unusable)
      for (const UnusableRow& row : impl_->rows(*impl_->unusable, event))
        result.readout->unusable.push_back(*unusable_of(row));
    if (impl_->delays) result.readout->delays = impl_->delays_of(event);
  });
  return result;
}

std::vector<Hit> EventFileReader::photons(std::size_t event) const {
  std::vector<Hit> result;
  impl_->guarded([&] {
    if (!impl_->photons) return;
    result = impl_->values(*impl_->photons, impl_->photons->rows_of(event),
                           [](const PhotonRow& row) { return hit_of(row.hit); });
  });
  return result;
}

std::vector<ModulePhotoelectron> EventFileReader::photoelectrons(std::size_t event) const {
  std::vector<ModulePhotoelectron> result;
  impl_->guarded([&] { impl_->add_values(impl_->photoelectrons, event, photoelectron_of, result); });
  return result;
}

std::vector<ModuleWaveform> EventFileReader::waveforms(std::size_t event) const {
  std::vector<ModuleWaveform> result;
  impl_->guarded([&] {
    const auto with_samples = [this](const WaveformRow& row) {
      std::optional<ModuleWaveform> waveform = waveform_of(row);
      const hsize_t size = impl_->samples->size();
      if (row.first_sample > size || row.sample_count > size - row.first_sample)
        throw InputError(impl_->where, "a waveform whose samples are not there", "rows of 'samples'",
                         remake_advice);
      if (waveform)
        impl_->samples->for_each(
            row.first_sample, row.first_sample + row.sample_count,
            [&](const SampleRow& sample, hsize_t) { waveform->counts.push_back(sample.counts); });
      return waveform;
    };
    impl_->add_values(impl_->waveforms, event, with_samples, result);
  });
  return result;
}

void EventFileReader::check_weights(const std::vector<Event>& events) const {
  impl_->guarded([&] {
    if (impl_->weights) check_sums(*impl_->weights, events);
  });
}

EventFile read_hdf5_events(const std::filesystem::path& path) {
  const EventFileReader reader(path);
  EventFile result;
  result.provenance = reader.provenance();
  for (std::size_t i = 0; i < reader.size(); ++i) result.events.push_back(reader.read(i));
  reader.check_weights(result.events);
  return result;
}

}  // namespace floe
