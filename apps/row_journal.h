// Results of a long run, kept row by row so that nothing is lost when it is killed.
#pragma once

#include <filesystem>
#include <mutex>
#include <vector>

#include "apps/planned_output.h"

namespace floe {

// A text file: a heading that says what the run is, then one row a line, each JSON. A row is appended with a
// single write and brought to the disk before append() returns. A line without its end, as a run killed
// while it wrote leaves it, is cut off when the file is opened again.
class RowJournal {
 public:
  enum class Mismatch { error, start_again };
  // Opens or creates. Rows of a run with another heading are not mixed: a UsageError that names the file and
  // the first setting that differs, or a new beginning, with a warning when rows are lost by it. Throws
  // InputError for a file that is no journal and OutputError when it cannot be written, or is in use by
  // another run.
  RowJournal(std::filesystem::path path, const Json& heading, Mismatch mismatch);
  ~RowJournal();
  RowJournal(const RowJournal&) = delete;
  RowJournal& operator=(const RowJournal&) = delete;

  const std::vector<Json>& rows() const { return rows_; }  // found when it was opened, in order of writing
  void append(const Json& row);                            // from any thread
  void remove();                                           // the file, when its rows stand elsewhere

 private:
  void begin(const Json& heading);

  std::filesystem::path path_;
  int file_ = -1;
  std::vector<Json> rows_;
  std::mutex mutex_;
};

}  // namespace floe
