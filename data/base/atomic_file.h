// Output files are written whole or not at all: to a temporary name beside the final one, renamed
// when complete, removed when the writer dies with an exception.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

namespace floe {

class AtomicFile {
 public:
  // Creates the temporary file, empty, beside the final one. Throws OutputError when the folder does
  // not exist or cannot be written, or when the final name is taken by something that is not a file.
  explicit AtomicFile(std::filesystem::path final_path);
  ~AtomicFile();  // removes the temporary file unless commit() was called
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  void commit();  // brings the content to the disk and renames; throws OutputError

 private:
  std::filesystem::path final_, temporary_;
  bool committed_ = false;
};

// Text written in portions, gzipped when the name ends in .gz; appears under its name with close().
class TextFileWriter {
 public:
  explicit TextFileWriter(const std::filesystem::path& path);  // throws OutputError, as all members do
  ~TextFileWriter();
  TextFileWriter(const TextFileWriter&) = delete;
  TextFileWriter& operator=(const TextFileWriter&) = delete;

  void append(std::string_view text);
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Writes `content` under `path`, gzipped when the name ends in .gz. Throws OutputError.
void write_whole_file(const std::filesystem::path& path, std::string_view content);

}  // namespace floe
