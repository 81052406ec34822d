// Output folders are written whole or not at all: under a temporary name beside the final one, renamed when
// complete, removed when the writer dies with an exception.
#pragma once

#include <filesystem>

namespace floe {

class AtomicFolder {
 public:
  // Creates the temporary folder. Throws OutputError when the folder above does not exist or cannot be
  // written, or when the final name is taken by anything but an empty folder.
  explicit AtomicFolder(std::filesystem::path final_path);
  ~AtomicFolder();  // removes the temporary folder unless commit() was called
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  void commit();  // renames; throws OutputError

 private:
  std::filesystem::path final_, temporary_;
  bool committed_ = false;
};

}  // namespace floe
