#include "apps/row_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "data/base/error.h"

namespace floe {
namespace {

std::string line_of(const Json& json) {
  return json_line(json) + '\n';
}

bool wrote_all(int file, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return ::fsync(file) == 0;
}

// All of it or nothing: on a full disk a part of a row would spoil the rows after it.
void append_whole(int file, const std::string& text, const std::filesystem::path& path) {
  const off_t end = ::lseek(file, 0, SEEK_END);
  if (end >= 0 && wrote_all(file, text)) return;
  const bool cut = end >= 0 && ::ftruncate(file, end) == 0;
  throw OutputError(path.string() + ": could not be written; is the disk full?" +
                    (cut ? "" : " Its last line is not whole"));
}

// Of the file that is locked: rows that could not be read must not be cut off as if they were none.
std::string content_of(int file, const std::filesystem::path& path) {
  const off_t size = ::lseek(file, 0, SEEK_END);
  std::string content(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  std::size_t done = 0;
  while (size >= 0 && done < content.size()) {
    const ssize_t n = ::pread(file, content.data() + done, content.size() - done, static_cast<off_t>(done));
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  if (size < 0 || done < content.size()) throw InputError(path.string() + ": could not be read");
  return content;
}

// Whether a run may have been killed while it wrote this as its first line.
bool may_be_heading(std::string_view text) {
  constexpr std::string_view begin = R"({"journal":)";
  return text.starts_with(begin) || begin.starts_with(text);
}

std::string shortened(const std::string& text) {
  constexpr std::size_t most = 60;
  return text.size() <= most ? text : text.substr(0, most) + "...";
}

// What two headings differ in first, in words; `name`: of the part that is looked at.
std::string difference(const Json& found, const Json& expected, const std::string& name = "") {
  const auto within = [&](const std::string& part) { return name.empty() ? part : name + "." + part; };
  if (found.is_object() && expected.is_object()) {
    for (const auto& [key, value] : expected.items()) {
      if (!found.contains(key)) return fmt::format("no {}", within(key));
      if (found[key] != value) return difference(found[key], value, within(key));
    }
    return "settings that this run does not have";
  }
  if (found.is_array() && expected.is_array() && found.size() == expected.size())
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i] != expected[i]) return difference(found[i], expected[i], within(fmt::format("{}", i + 1)));
  return fmt::format("{} {}, not {}", name, shortened(json_line(found)), shortened(json_line(expected)));
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
    const std::string content = content_of(file_, path_);
    std::size_t end = 0;
    long line = 0;
    const auto refuse = [&](long at) {
      throw InputError({path_.string(), at}, "text that is no row", "a journal of floe",
                       "Name another file, or remove this one");
    };
    Json found;
    for (std::size_t next; (next = content.find('\n', end)) != std::string::npos; end = next + 1) {
      ++line;
      Json json = Json::parse(content.substr(end, next - end), nullptr, false);
      if (!json.is_object() || (line == 1 && !json.contains("journal"))) refuse(line);
      if (line == 1)
        found = std::move(json);
      else
        rows_.push_back(std::move(json));
    }
    if (line == 0) {
      if (!may_be_heading(content)) refuse(1);
      begin(heading);
    } else if (found != heading) {
      if (mismatch == Mismatch::error)
        throw UsageError(
            fmt::format("{}: found rows of a run with {}; expected the same settings. Name "
                        "another file, or remove this one",
                        path_.string(), difference(found, heading)));
      if (!rows_.empty())
        fmt::print(stderr, "floe: warning: {}: {} of a run with {} {} dropped\n", path_.string(),
                   rows_.size() == 1 ? "a row" : fmt::format("{} rows", rows_.size()),
                   difference(found, heading), rows_.size() == 1 ? "is" : "are");
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
  append_whole(file_, line_of(heading), path_);
}

void RowJournal::append(const Json& row) {
  const std::lock_guard lock(mutex_);
  append_whole(file_, line_of(row), path_);
}

void RowJournal::remove() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace floe
