// Runs the floe program as a shell would, in a folder of the test's own.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <set>
#include <string>

namespace floe::test {

struct Outcome {
  int code = -1;         // exit code; 128 + signal when it was killed
  std::string out, err;  // what it printed
};

// Runs "floe ARGUMENTS" in `folder`; the arguments are read by the shell.
Outcome run_floe(const std::filesystem::path& folder, const std::string& arguments);

// Starts "floe ARGUMENTS" in `folder` and does not wait for it: for tests that kill or measure it. What it
// prints goes nowhere unless the arguments say where.
pid_t start_floe(const std::filesystem::path& folder, const std::string& arguments);

// Names of everything in a folder, with what is in folders below it.
std::set<std::string> files_in(const std::filesystem::path& folder);

// The failed run left one clear message: its exit code, one "floe: error: " with `said` in it, and no
// other trouble.
void expect_error(const Outcome& outcome, int code, const std::string& said);

}  // namespace floe::test
