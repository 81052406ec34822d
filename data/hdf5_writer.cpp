// EventFileWriter: events into floe's HDF5, in constant memory.
#include <fmt/format.h>

#include <stdexcept>
#include <unordered_set>

#include "data/base/atomic_file.h"
#include "data/base/error.h"
#include "data/event_files.h"
#include "data/hdf5_output.h"
#include "data/hdf5_readout_schema.h"
#include "data/hdf5_schema.h"
#include "data/hdf5_table_writer.h"

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
    readouts.reset(), unusable.reset(), delays.reset();
    photons.reset(), photoelectrons.reset(), waveforms.reset(), samples.reset();
    file = {};
  }

  void create(const Provenance& provenance) {
    file = create_file(target.temporary());
    write_provenance(file, provenance);
    events.emplace(file), particles.emplace(file);
    hits.emplace(file, provenance.pulses ? pulse_columns() : Table<HitRow>::columns());
    if (provenance.pulses) readouts.emplace(file), unusable.emplace(file), delays.emplace(file);
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

  // Of the event begun last.
  void add_readout(const Readout& readout) {
    if (!readouts || !readout.modules)
      throw std::logic_error("EventFileWriter: a readout in a file of photons");
    if (modules && modules != readout.modules && *modules != *readout.modules)
      throw UsageError(
          fmt::format("{}: event '{}' was recorded by other modules than those before it; "
                      "keep them in another file",
                      path.string(), current_id));
    modules = readout.modules;
    readouts->append(row_of(events->size(), readout));
    for (const UnusableTimes& times : readout.unusable) unusable->append(row_of(events->size(), times));
    for (const ExpectedDelay& delay : readout.delays) delays->append(row_of(events->size(), delay));
  }
  void write_modules() {
    TableWriter<ModuleRow> table(file);
    if (modules)
      for (const RecordingModule& module : *modules) table.append(row_of(module));
    table.close();
  }

  std::filesystem::path path;
  AtomicFile target;
  Hdf5Handle file;
  std::optional<TableWriter<EventRow>> events;
  std::optional<TableWriter<ParticleRow>> particles;
  std::optional<TableWriter<HitRow>> hits;
  std::optional<TableWriter<WeightRow>> weights;    // only in weighted simulations
  std::optional<TableWriter<FlasherRow>> flashers;  // only after an event that is a flasher run
  std::optional<TableWriter<ReadoutRow>> readouts;  // only in files of pulses, as the next
  std::optional<TableWriter<UnusableRow>> unusable;
  std::optional<TableWriter<DelayRow>> delays;
  std::shared_ptr<const RecordingModules> modules;
  std::optional<TableWriter<PhotonRow>> photons;  // only when they were appended, as the rest
  std::optional<TableWriter<PhotoelectronRow>> photoelectrons;
  std::optional<TableWriter<WaveformRow>> waveforms;
  std::optional<TableWriter<SampleRow>> samples;
  ModuleWeights module_weights;     // of the event begun last
  std::optional<EventRow> current;  // the event begun last
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

void EventFileWriter::begin_event(const Event& event) {
  begin_event(event.id, event.truth, event.repeats, event.flasher);
  guarded(impl_->path, [&] {
    if (event.readout) impl_->add_readout(*event.readout);
  });
}

void EventFileWriter::append_photons(std::span<const Hit> photons) {
  guarded(impl_->path, [&] {
    if (!impl_->photons) impl_->photons.emplace(impl_->file);
    for (const Hit& photon : photons) impl_->photons->append({impl_->events->size(), row_of(photon)});
  });
}

void EventFileWriter::append_photoelectrons(std::span<const ModulePhotoelectron> photoelectrons) {
  guarded(impl_->path, [&] {
    if (!impl_->photoelectrons) impl_->photoelectrons.emplace(impl_->file);
    for (const auto& pe : photoelectrons) impl_->photoelectrons->append(row_of(impl_->events->size(), pe));
  });
}

void EventFileWriter::append_waveforms(std::span<const ModuleWaveform> waveforms) {
  guarded(impl_->path, [&] {
    if (!impl_->waveforms) impl_->waveforms.emplace(impl_->file), impl_->samples.emplace(impl_->file);
    for (const ModuleWaveform& waveform : waveforms) {
      impl_->waveforms->append(row_of(impl_->events->size(), waveform, impl_->samples->size()));
      for (const int counts : waveform.counts) impl_->samples->append({counts});
    }
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
    if (impl_->readouts)
      impl_->write_modules(), impl_->readouts->close(), impl_->unusable->close(), impl_->delays->close();
    if (impl_->photons) impl_->photons->close();
    if (impl_->photoelectrons) impl_->photoelectrons->close();
    if (impl_->waveforms) impl_->waveforms->close(), impl_->samples->close();
    impl_->file.close("close the file");
  });
  impl_->target.commit();
}

}  // namespace floe
