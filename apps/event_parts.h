// An event file that is made event by event, and goes on where a killed run was.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/row_journal.h"
#include "data/event_files.h"

namespace floe {

// Each event, or a few where there are very many, is kept in a file of its own in the folder FILE.parts, with
// a row in its journal, until all are there; then they are written to FILE one after the other, and the
// folder goes. Memory does not grow with their number. One thread at a time may use HDF5: whoever reads other
// event files meanwhile does it under lock().
class EventParts {
 public:
  // `heading` says what the run is (see RowJournal): parts of another are thrown away. Throws OutputError.
  EventParts(std::filesystem::path file, const Json& heading, std::size_t events);
  ~EventParts();  // a folder without any event goes

  std::unique_lock<std::mutex> lock() { return std::unique_lock(mutex_); }

  std::size_t found() const { return found_; }  // events that an earlier run has left
  const std::optional<Json>& row(std::size_t event) const { return rows_[event]; }  // none: not done

  // From any thread: writes the event's part with `write`, brings it to the disk and then its row.
  void add(std::size_t event, const Provenance& provenance,
           const std::function<void(EventFileWriter&)>& write, const Json& row);

  // When all events are done. `copy(part, writer)` appends one part's event to the file.
  void finish(const Provenance& provenance,
              const std::function<void(const std::filesystem::path& part, EventFileWriter&)>& copy);

 private:
  std::filesystem::path part(std::size_t event) const;

  std::filesystem::path file_, folder_;
  std::optional<RowJournal> journal_;
  std::vector<std::optional<Json>> rows_;
  std::size_t found_ = 0;
  std::mutex mutex_;
};

}  // namespace floe
