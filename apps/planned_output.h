// Output files of a command: their folders are checked before any work is done, so that a long run
// does not end in an error that was there from the beginning.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "data/base/atomic_file.h"

namespace floe {

// A file that may not have been asked for: then nothing happens anywhere.
class PlannedOutput {
 public:
  // Throws OutputError when it cannot be written.
  explicit PlannedOutput(const std::optional<std::string>& file);

  void write(std::string_view content);  // to the temporary file
  void commit();                         // gives it its name, when it was written

 private:
  std::optional<AtomicFile> file_;
  bool written_ = false;
};

// JSON with its keys in the order in which they were written.
using Json = nlohmann::ordered_json;
// Indented; numbers that are not finite become null.
std::string json_text(const Json& json);
// The same in one line, for attributes and journals. Names of files that are no UTF-8 are mended in both.
std::string json_line(const Json& json);

// Does `work`. Where it comes to no result, the JSON, if it was asked for, says why: `status` "no_result" and
// `reason`. The error goes on.
void say_why_no_result(const std::optional<std::string>& json, const std::function<void()>& work);

}  // namespace floe
