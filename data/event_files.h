// Event files: floe's own HDF5 (docs/formats.md) and the texts that other tools write.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/event.h"

namespace floe {

// Writes events one after the other, hits in any number of portions, in constant memory. The file
// appears under its name only when close() has succeeded. Throws OutputError when the file cannot be
// written, UsageError for values that no event may hold (data/event_rules.h) and for event names that
// occur twice. One thread at a time may use event files: HDF5 allows no more.
class EventFileWriter {
 public:
  EventFileWriter(std::filesystem::path path, const Provenance& provenance);
  ~EventFileWriter();
  EventFileWriter(const EventFileWriter&) = delete;
  EventFileWriter& operator=(const EventFileWriter&) = delete;

  void begin_event(const std::string& id, const std::vector<Particle>& truth, double repeats = 1,
                   const std::optional<FlasherRun>& flasher = {});
  // The same with all that is known of the event besides its hits; a readout only in files of pulses.
  void begin_event(const Event& event);
  void append(std::span<const Hit> hits);  // to the event begun last, as all that follow
  // What stands beside pulses; a file to which even an empty list was appended has the table.
  void append_photons(std::span<const Hit> photons);
  void append_photoelectrons(std::span<const ModulePhotoelectron> photoelectrons);
  void append_waveforms(std::span<const ModuleWaveform> waveforms);
  void close();  // after at least one event

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

struct EventFile {
  std::vector<Event> events;
  std::optional<Provenance> provenance;  // only floe's own files know it
};

// Reads .h5 (floe's own, and pulses as IceTray's HDF5 writer has them: data/icetray_tables.h), .hits or .txt
// ("HIT" lines), .dat (charge list), each text also gzipped. A text file holds one event, named after the
// file; among the "HIT" lines "EM ..." / "TR ..." lines of f2k may stand, which become its truth. Throws
// InputError: missing, truncated, malformed, not finite, a text without hits, an HDF5 file without events (a
// simulated event may well have no hits).
EventFile read_event_file(const std::filesystem::path& path);

// Formats of export; chosen by suffix (.hits, .dat, .csv, each also with .gz; .i3.h5 is icetray).
enum class EventFormat { hits, dat, csv, icetray };
EventFormat event_format_of(const std::filesystem::path& path);  // throws UsageError

// Writes one file of text for all events; more than one event in a format that cannot tell them apart (.dat;
// .hits unless all are flasher runs, each with its FLASHER line) is a UsageError that says what to do, and so
// are hits that the format cannot express (.hits: unknown direction or wavelength, a line that would not be
// one photon). Text is exact to 1e-3 ns / 1e-6 rad.
void export_events(const std::filesystem::path& path, EventFormat format, std::span<const Event> events);

// f2k text: one "TR gen igen NAME x y z zenith azimuth length energy time" a line (degrees); "EM"
// lines separate events; other f2k keywords (V, TBEGIN, EE, ...) are passed over. Several TR lines
// without EM belong to one event. Throws InputError.
std::vector<Event> read_f2k(const std::filesystem::path& path);

}  // namespace floe
