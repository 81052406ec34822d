// EventFileWriter: events into floe's HDF5, in constant memory.
#include <fmt/format.h>

#include <stdexcept>
#include <unordered_set>

#include "data/base/atomic_file.h"
#include "data/base/error.h"
#include "data/event_files.h"
#include "data/hdf5_output.h"
#include "data/hdf5_schema.h"

namespace floe {

using namespace hdf5;

namespace {

void write_provenance(hid_t file, const Provenance& provenance) {
  write_attribute(file, "format", format_name);
  write_attribute(file, "format_version", format_version);
  write_attribute(file, "version", provenance.version);
  write_attribute(file, "command", provenance.command);
  write_attribute(file, "configuration", provenance.configuration);
  write_attribute(file, "ice_name", provenance.ice_name);
  write_attribute(file, "ice_hash", provenance.ice_hash);
  write_attribute(file, "detector_name", provenance.detector_name);
  write_attribute(file, "detector_hash", provenance.detector_hash);
  write_attribute(file, "seed", std::uint64_t{provenance.seed});
  write_attribute(file, "oversize", provenance.oversize);
}

// One table of the file, to which rows are appended; a chunk's worth of them is kept in memory.
template <typename Row>
class TableWriter {
 public:
  explicit TableWriter(hid_t file) : row_type_(row_type_in_memory(Table<Row>::columns(), sizeof(Row))) {
    const hsize_t none = 0, unlimited = H5S_UNLIMITED, chunk = Table<Row>::rows_per_chunk;
    const Hdf5Handle space(H5Screate_simple(1, &none, &unlimited), H5Sclose, "describe a table");
    const Hdf5Handle layout = compressed_layout({&chunk, 1});
    table_ = Hdf5Handle(H5Dcreate2(file, Table<Row>::name, row_type_in_file(Table<Row>::columns()), space,
                                   H5P_DEFAULT, layout, H5P_DEFAULT),
                        H5Dclose, "create a table");
    rows_.reserve(chunk);
  }

  void append(const Row& row) {
    rows_.push_back(row);
    if (rows_.size() == Table<Row>::rows_per_chunk) write_rows();
  }
  hsize_t size() const { return written_ + rows_.size(); }
  void close() {
    write_rows();
    table_.close("close a table");
  }

 private:
  void write_rows() {
    if (rows_.empty()) return;
    const hsize_t count = rows_.size(), end = written_ + count;
    checked(H5Dset_extent(table_, &end), "extend a table");
    const Hdf5Handle in_file(H5Dget_space(table_), H5Sclose, "select rows");
    checked(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, &written_, nullptr, &count, nullptr), "select rows");
    const Hdf5Handle in_memory(H5Screate_simple(1, &count, nullptr), H5Sclose, "select rows");
    checked(H5Dwrite(table_, row_type_, in_memory, in_file, H5P_DEFAULT, rows_.data()), "write rows");
    written_ = end;
    rows_.clear();
  }

  Hdf5Handle row_type_, table_;
  std::vector<Row> rows_;
  hsize_t written_ = 0;
};

void expect_valid(const std::optional<Problem>& problem, const std::string& event) {
  if (problem)
    throw UsageError(fmt::format("event '{}' cannot be stored: found {}; expected {}", event, problem->found,
                                 problem->expected));
}

}  // namespace

struct EventFileWriter::Impl {
  explicit Impl(std::filesystem::path name) : path(std::move(name)), target(path) {}
  ~Impl() {
    const Hdf5Silence silence;  // what an unfinished file complains about is no news
    hits.reset(), particles.reset(), events.reset(), weights.reset(), flashers.reset();
    file = {};
  }

  void create(const Provenance& provenance) {
    file = create_file(target.temporary());
    write_provenance(file, provenance);
    events.emplace(file), particles.emplace(file), hits.emplace(file);
    if (provenance.weighted) weights.emplace(file);
  }

  void finish_event() {
    if (!current) return;
    current->hit_count = hits->size() - current->first_hit;
    if (weights)
      for (const auto& module : module_weights) weights->append(row_of(events->size(), module));
    module_weights.clear();
    if (current_flasher) {
      if (!flashers) flashers.emplace(file);
      flashers->append(row_of(events->size(), *current_flasher));
    }
    events->append(*current);
    current.reset();
  }

  std::filesystem::path path;
  AtomicFile target;
  Hdf5Handle file;
  std::optional<TableWriter<EventRow>> events;
  std::optional<TableWriter<ParticleRow>> particles;
  std::optional<TableWriter<HitRow>> hits;
  std::optional<TableWriter<WeightRow>> weights;    // only in weighted simulations
  std::optional<TableWriter<FlasherRow>> flashers;  // only after an event that is a flasher run
  ModuleWeights module_weights;                     // of the event begun last
  std::optional<EventRow> current;                  // the event begun last
  std::optional<FlasherRun> current_flasher;
  std::string current_id;
  std::unordered_set<std::string> ids;
};

EventFileWriter::EventFileWriter(std::filesystem::path path, const Provenance& provenance)
    : impl_(std::make_unique<Impl>(std::move(path))) {
  guarded(impl_->path, [&] { impl_->create(provenance); });
}

EventFileWriter::~EventFileWriter() = default;

void EventFileWriter::begin_event(const std::string& id, const std::vector<Particle>& truth, double repeats,
                                  const std::optional<FlasherRun>& flasher) {
  if (!impl_->file.open()) throw std::logic_error("EventFileWriter::begin_event after close");
  expect_valid(problem_of_event(id, repeats), id);
  for (const Particle& particle : truth) expect_valid(problem_of(particle), id);
  if (flasher) expect_valid(problem_of(*flasher), id);
  if (!impl_->ids.insert(id).second)
    throw UsageError(fmt::format("{}: two events are named '{}'; the names in a file must differ",
                                 impl_->path.string(), id));
  guarded(impl_->path, [&] {
    impl_->finish_event();
    EventRow row{{}, repeats, impl_->hits->size(), 0, impl_->particles->size(), truth.size()};
    id.copy(row.id, sizeof(row.id));
    for (const Particle& particle : truth) impl_->particles->append(row_of(particle));
    impl_->current = row;
    impl_->current_id = id;
    impl_->current_flasher = flasher;
  });
}

void EventFileWriter::append(std::span<const Hit> hits) {
  if (!impl_->current) throw std::logic_error("EventFileWriter::append without begin_event");
  for (const Hit& hit : hits) expect_valid(problem_of(hit), impl_->current_id);
  guarded(impl_->path, [&] {
    for (const Hit& hit : hits) impl_->hits->append(row_of(hit));
    if (impl_->weights) add_weights(impl_->module_weights, hits);
  });
}

void EventFileWriter::close() {
  if (impl_->ids.empty()) throw std::logic_error("EventFileWriter::close without an event");
  guarded(impl_->path, [&] {
    impl_->finish_event();
    impl_->hits->close(), impl_->particles->close(), impl_->events->close();
    if (impl_->weights) impl_->weights->close();
    if (impl_->flashers) impl_->flashers->close();
    impl_->file.close("close the file");
  });
  impl_->target.commit();
}

}  // namespace floe
