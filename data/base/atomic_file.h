// Output files are written whole or not at all: to a temporary name beside the final one, renamed
// when complete, removed when the writer dies with an exception.
#pragma once

#include <filesystem>
#include <string_view>

namespace floe {

class AtomicFile {
 public:
  // Checks that the folder exists and can be written, throws OutputError otherwise.
  explicit AtomicFile(std::filesystem::path final_path);
  ~AtomicFile();  // removes the temporary file unless commit() was called
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  void commit();  // rename to the final name; throws OutputError

 private:
  std::filesystem::path final_, temporary_;
  bool committed_ = false;
};

// Writes `content` under `path`, gzipped when the name ends in .gz. Throws OutputError.
void write_whole_file(const std::filesystem::path& path, std::string_view content);

}  // namespace floe
