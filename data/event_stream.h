// floe's own event files read one event at a time, so that memory does not grow with their number.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "data/event_files.h"

namespace floe {

// One thread at a time may use event files: HDF5 allows no more.
class EventFileReader {
 public:
  // Throws InputError: not HDF5, truncated or damaged, another format or version, a column missing or
  // unknown, rows that do not fit together. So do all members, and for values that no event may hold
  // (data/event_rules.h).
  explicit EventFileReader(const std::filesystem::path& path);
  ~EventFileReader();
  EventFileReader(EventFileReader&&) noexcept;
  EventFileReader& operator=(EventFileReader&&) noexcept;

  const Provenance& provenance() const;
  std::size_t size() const;                        // events
  const std::string& id(std::size_t event) const;  // event < size()
  std::size_t hit_count(std::size_t event) const;

  Event read(std::size_t event) const;
  // What stands beside an event's pulses; empty where the file does not have it.
  std::vector<Hit> photons(std::size_t event) const;
  std::vector<ModulePhotoelectron> photoelectrons(std::size_t event) const;
  std::vector<ModuleWaveform> waveforms(std::size_t event) const;

  // Throws InputError unless the sums of weights of the whole file, whose events are `events`, are those of
  // their hits. Of a file without weights nothing is asked.
  void check_weights(const std::vector<Event>& events) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace floe
