#include "data/base/atomic_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include "data/base/error.h"
#include "data/base/text.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe {

using test::bytes_of;
using test::message_of;
using test::TemporaryFolder;
using test::write_bytes;

TEST(AtomicFileTest, AppearsWithCommitOnly) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "out.txt";
  {
    AtomicFile file(path);
    EXPECT_EQ(file.temporary().parent_path(), folder.path());
    write_bytes(file.temporary(), "new");
    EXPECT_FALSE(std::filesystem::exists(path));
    file.commit();
  }
  EXPECT_EQ(bytes_of(path), "new");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFileTest, LeavesTheOldFileWhenTheWriterFails) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "out.txt";
  write_bytes(path, "old");
  {
    AtomicFile file(path);
    write_bytes(file.temporary(), "half");
  }
  EXPECT_EQ(bytes_of(path), "old");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFileTest, WritersOfOneFileDoNotMeet) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "out.txt";
  AtomicFile first(path), second(path);
  EXPECT_NE(first.temporary(), second.temporary());
  write_bytes(first.temporary(), "first");
  write_bytes(second.temporary(), "second");
  first.commit();
  second.commit();
  EXPECT_EQ(bytes_of(path), "second");
}

TEST(AtomicFileTest, ReplacesTheTargetOfALink) {
  const TemporaryFolder folder;
  write_bytes(folder.path() / "target", "old");
  std::filesystem::create_symlink(folder.path() / "target", folder.path() / "link");
  write_whole_file(folder.path() / "link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
  EXPECT_EQ(bytes_of(folder.path() / "target"), "new");
}

TEST(AtomicFileTest, RefusesPlacesThatCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_NE(
      message_of<OutputError>([&] { AtomicFile(folder.path() / "none" / "out"); }).find("does not exist"),
      std::string::npos);
  EXPECT_NE(message_of<OutputError>([&] { AtomicFile file(folder.path()); }).find("directory"),
            std::string::npos);
  EXPECT_NE(message_of<OutputError>([&] { AtomicFile("/dev/null"); }).find("regular file"),
            std::string::npos);
  write_bytes(folder.path() / "file", "");
  EXPECT_THROW(AtomicFile(folder.path() / "file" / "out"), OutputError);
}

TEST(WriteWholeFileTest, WritesWhatIsReadBack) {
  const TemporaryFolder folder;
  const std::string content = "line\n" + std::string(3'000'000, 'x') + "\n";
  for (const char* name : {"plain.txt", "zipped.txt.gz"}) {
    write_whole_file(folder.path() / name, content);
    EXPECT_EQ(read_whole_file(folder.path() / name), content);
  }
  EXPECT_EQ(bytes_of(folder.path() / "plain.txt"), content);
  EXPECT_LT(std::filesystem::file_size(folder.path() / "zipped.txt.gz"), content.size() / 10);
}

TEST(WriteWholeFileTest, WritesNothingAtAllToo) {
  const TemporaryFolder folder;
  write_whole_file(folder.path() / "empty", "");
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "empty"), 0u);
}

// A limit on the size of files stands for a full disk.
TEST(WriteWholeFileTest, AFullDiskIsAnErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  const auto old_handler = signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit small{100'000, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(write_whole_file(folder.path() / "big.txt", std::string(1'000'000, 'x')), OutputError);
  setrlimit(RLIMIT_FSIZE, &old);
  signal(SIGXFSZ, old_handler);
  EXPECT_EQ(folder.file_count(), 0u);
}

}  // namespace floe
