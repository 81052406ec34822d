#include "apps/row_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "data/base/error.h"

namespace floe {
namespace {

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

void write_all(int file, const std::string& text, const std::filesystem::path& path) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n <= 0) throw OutputError(path.string() + ": could not be written; is the disk full?");
    done += static_cast<std::size_t>(n);
  }
  if (::fsync(file) != 0) throw OutputError(path.string() + ": could not be written; is the disk full?");
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

// What two headings differ in, in words.
std::string difference(const Json& found, const Json& expected) {
  for (const auto& [key, value] : expected.items())
    if (!found.contains(key) || found[key] != value)
      return fmt::format("{} {}, not {}", key, found.contains(key) ? found[key].dump() : "unknown",
                         value.dump());
  return "settings that this run does not have";
}

}  // namespace

RowJournal::RowJournal(std::filesystem::path path, const Json& asked, Mismatch mismatch)
    : path_(std::move(path)) {
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0)
    throw OutputError(path_.string() + ": could not be opened; does its folder exist, may it be written?");
  try {
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0)
      throw OutputError(path_.string() + ": another run is writing here; wait for it, or name another file");
    const Json heading = Json::parse(line_of(asked));  // as it would be read: no infinities
    const std::string content = content_of(path_);
    std::size_t end = 0;
    long line = 0;
    Json found;
    for (std::size_t next; (next = content.find('\n', end)) != std::string::npos; end = next + 1) {
      ++line;
      Json json = Json::parse(content.substr(end, next - end), nullptr, false);
      if (!json.is_object() || (line == 1 && !json.contains("journal")))
        throw InputError({path_.string(), line}, "text that is no row", "a journal of floe",
                         "Name another file, or remove this one");
      if (line == 1)
        found = std::move(json);
      else
        rows_.push_back(std::move(json));
    }
    if (line == 0) {
      begin(heading);
    } else if (found != heading) {
      if (mismatch == Mismatch::error)
        throw UsageError(
            fmt::format("{}: found rows of a run with {}; expected the same settings. Name "
                        "another file, or remove this one",
                        path_.string(), difference(found, heading)));
      rows_.clear();
      begin(heading);
    } else if (end < content.size() && ::ftruncate(file_, static_cast<off_t>(end)) != 0) {
      throw OutputError(path_.string() + ": could not be written");
    }
  } catch (...) {
    ::close(file_);
    throw;
  }
}

RowJournal::~RowJournal() {
  ::close(file_);
}

void RowJournal::begin(const Json& heading) {
  if (::ftruncate(file_, 0) != 0) throw OutputError(path_.string() + ": could not be written");
  write_all(file_, line_of(heading), path_);
}

void RowJournal::append(const Json& row) {
  const std::lock_guard lock(mutex_);
  write_all(file_, line_of(row), path_);
}

void RowJournal::remove() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace floe
