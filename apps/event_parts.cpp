#include "apps/event_parts.h"

#include <fmt/format.h>

#include "data/base/atomic_file.h"
#include "data/base/error.h"

namespace floe {

namespace fs = std::filesystem;

namespace {

void create_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directory(folder, failed);
  if (failed)
    throw OutputError(fmt::format("{}: cannot be made: {}. Choose a folder that can be written",
                                  folder.string(), failed.message()));
}

}  // namespace

EventParts::EventParts(fs::path file, const Json& heading, std::size_t events)
    : file_(std::move(file)), folder_(file_.string() + ".parts"), rows_(events) {
  { const AtomicFile writable(file_); }  // says what is wrong where it is not
  create_folder(folder_);
  journal_.emplace(folder_ / "journal", heading, RowJournal::Mismatch::start_again);
  for (const Json& row : journal_->rows()) {
    const auto event = row.at("event_row").get<std::size_t>();
    if (event >= events || rows_[event] || !fs::exists(part(event))) continue;
    rows_[event] = row;
    ++found_;
  }
}

EventParts::~EventParts() {
  for (const auto& row : rows_)
    if (row) return;
  journal_.reset();
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

fs::path EventParts::part(std::size_t event) const {
  return folder_ / fmt::format("{:06}.h5", event);
}

void EventParts::add(std::size_t event, const Provenance& provenance,
                     const std::function<void(EventFileWriter&)>& write, const Json& row) {
  const auto locked = lock();
  EventFileWriter writer(part(event), provenance);
  write(writer);
  writer.close();
  Json numbered = row;
  numbered["event_row"] = event;
  journal_->append(numbered);
  rows_[event] = std::move(numbered);
}

void EventParts::finish(const Provenance& provenance,
                        const std::function<void(const fs::path&, EventFileWriter&)>& copy) {
  const auto locked = lock();
  EventFileWriter writer(file_, provenance);
  for (std::size_t event = 0; event < rows_.size(); ++event) copy(part(event), writer);
  writer.close();
  journal_.reset();
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace floe
