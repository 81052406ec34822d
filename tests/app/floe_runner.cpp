#include "tests/app/floe_runner.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "tests/unit/data/temporary_folder.h"

namespace floe::test {

namespace fs = std::filesystem;

Outcome run_floe(const fs::path& folder, const std::string& arguments) {
  const TemporaryFolder said;
  const fs::path out = said.path() / "out", err = said.path() / "err";
  const std::string command = "cd '" + folder.string() + "' && { '" FLOE_PROGRAM "' " + arguments + "; } >'" +
                              out.string() + "' 2>'" + err.string() + "' </dev/null";
  const int status = std::system(command.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, bytes_of(out), bytes_of(err)};
}

pid_t start_floe(const fs::path& folder, const std::string& arguments) {
  // With exec the shell becomes floe: signals and measurements are of floe itself.
  const std::string command = "cd '" + folder.string() +
                              "' && exec '" FLOE_PROGRAM "' >/dev/null 2>/dev/null " + arguments +
                              " </dev/null";
  const pid_t process = ::fork();
  if (process == 0) {
    ::execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  return process;
}

std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.insert(fs::relative(entry.path(), folder).string());
  return names;
}

void expect_error(const Outcome& outcome, int code, const std::string& said) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  constexpr std::string_view prefix = "floe: error: ";
  const auto first = outcome.err.find(prefix);
  EXPECT_EQ(first, 0u) << outcome.err;
  EXPECT_EQ(outcome.err.find(prefix, 1), std::string::npos) << "more than one error:\n" << outcome.err;
  EXPECT_NE(outcome.err.find(said), std::string::npos) << "expected to read \"" << said << "\" in:\n"
                                                       << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

}  // namespace floe::test
