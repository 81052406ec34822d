#include "data/base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "data/base/error.h"

namespace floe {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void throw_output_error(const fs::path& path, std::string_view problem,
                                     std::string_view advice) {
  throw OutputError(fmt::format("{}: cannot be written: {}. {}", path.string(), problem, advice));
}

// A link stays a link: its target is replaced.
fs::path followed(const fs::path& path) {
  std::error_code failed;
  const fs::path target = fs::is_symlink(path, failed) ? fs::canonical(path, failed) : path;
  return failed ? path : target;
}

void check_final_path(const fs::path& path) {
  std::error_code ignored;
  const auto status = fs::status(path, ignored);
  if (!path.has_filename() || fs::is_directory(status))
    throw_output_error(path, "it is a directory", "Name a file");
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw_output_error(path, "it is not a regular file", "Name a file");
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored))
    throw_output_error(path, fmt::format("the folder {} does not exist", folder.string()),
                       "Create the folder first");
}

// Creating the file is the one reliable test that the folder can be written. Names in use (by another
// writer of this process, or left by a killed run) are passed over.
fs::path create_temporary(const fs::path& final_path) {
  for (int attempt = 0;; ++attempt) {
    fs::path name = final_path;
    name += fmt::format(".partial-{}-{}", ::getpid(), attempt);
    const int file = ::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (file >= 0) {
      ::close(file);
      return name;
    }
    if (errno != EEXIST)
      throw_output_error(final_path, std::strerror(errno), "Choose a folder that can be written");
  }
}

// Without this a power cut after the rename could leave an empty file under the final name.
void bring_to_disk(const fs::path& temporary, const fs::path& final_path) {
  const int file = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = file >= 0 && ::fsync(file) == 0;
  const int problem = errno;
  if (file >= 0) ::close(file);
  if (!done) throw_output_error(final_path, std::strerror(problem), "Is the disk full?");
}

}  // namespace

AtomicFile::AtomicFile(fs::path final_path) : final_(followed(final_path)) {
  check_final_path(final_);
  temporary_ = create_temporary(final_);
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  bring_to_disk(temporary_, final_);
  std::error_code failed;
  fs::rename(temporary_, final_, failed);
  if (failed) throw_output_error(final_, failed.message(), "Choose another place");
  committed_ = true;
}

struct TextFileWriter::Impl {
  explicit Impl(const fs::path& path) : name(path), target(path) {
    // zlib writes plain text in its mode "T", so that both kinds share one code.
    file = gzopen(target.temporary().c_str(), path.extension() == ".gz" ? "wb6" : "wbT");
    if (!file) throw_output_error(name, std::strerror(errno), "Choose a folder that can be written");
    gzbuffer(file, 1 << 17);
  }
  ~Impl() {
    if (file) gzclose_w(file);
  }
  [[noreturn]] void fail() const { throw_output_error(name, std::strerror(errno), "Is the disk full?"); }

  fs::path name;
  AtomicFile target;
  gzFile file = nullptr;
};

TextFileWriter::TextFileWriter(const fs::path& path) : impl_(std::make_unique<Impl>(path)) {}
TextFileWriter::~TextFileWriter() = default;

void TextFileWriter::append(std::string_view text) {
  // gzwrite counts in int.
  constexpr std::size_t portion = std::size_t{1} << 30;
  for (; !text.empty(); text.remove_prefix(std::min(portion, text.size()))) {
    const auto size = static_cast<unsigned>(std::min(portion, text.size()));
    if (gzwrite(impl_->file, text.data(), size) != static_cast<int>(size)) impl_->fail();
  }
}

void TextFileWriter::close() {
  if (gzclose_w(std::exchange(impl_->file, nullptr)) != Z_OK) impl_->fail();
  impl_->target.commit();
}

void write_whole_file(const fs::path& path, std::string_view content) {
  TextFileWriter writer(path);
  writer.append(content);
  writer.close();
}

}  // namespace floe
