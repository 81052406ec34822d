#include "data/base/atomic_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <string>
#include <system_error>
#include <utility>

#include "data/base/error.h"

namespace floe {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& path, const std::string& problem, const std::string& advice) {
  throw OutputError(fmt::format("{}: cannot be written: {}. {}", path.string(), problem, advice));
}

// "results/" and "results" are the same folder.
fs::path without_slash(fs::path path) {
  return path.has_filename() ? path : path.parent_path();
}

void expect_free(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return;
  if (!fs::is_directory(path, ignored)) refuse(path, "a file of this name exists", "Name a new folder");
  if (!fs::is_empty(path, ignored)) refuse(path, "the folder exists and is not empty", "Name a new folder");
}

}  // namespace

AtomicFolder::AtomicFolder(fs::path final_path) : final_(without_slash(std::move(final_path))) {
  expect_free(final_);
  const fs::path above = final_.has_parent_path() ? final_.parent_path() : fs::path(".");
  std::error_code problem;
  if (!fs::is_directory(above, problem))
    refuse(final_, fmt::format("the folder {} does not exist", above.string()), "Create the folder first");
  for (int attempt = 0;; ++attempt) {
    temporary_ = final_;
    temporary_ += fmt::format(".partial-{}-{}", ::getpid(), attempt);
    if (fs::create_directory(temporary_, problem)) return;
    if (problem) refuse(final_, problem.message(), "Choose a folder that can be written");
  }
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  if (!committed_) fs::remove_all(temporary_, ignored);
}

void AtomicFolder::commit() {
  std::error_code problem;
  fs::remove(final_, problem);  // when it is there and empty
  fs::rename(temporary_, final_, problem);
  if (problem)
    refuse(final_, problem.message(), "The folder above must stay writable while the command runs");
  committed_ = true;
}

}  // namespace floe
