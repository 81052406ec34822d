// --help and --version, and the examples in every help text.
#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "tests/app/floe_runner.h"
#include "tests/app/model_directory.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

std::vector<std::string> commands() {
  const TemporaryFolder folder;
  std::istringstream help(run_floe(folder.path(), "--help").out);
  std::vector<std::string> names;
  bool listing = false;
  for (std::string line; std::getline(help, line);) {
    if (listing && line.empty()) break;
    if (listing) names.push_back(line.substr(2, line.find(' ', 2) - 2));
    if (line == "Subcommands:") listing = true;
  }
  return names;
}

std::vector<std::string> examples_of(const std::string& command) {
  const TemporaryFolder folder;
  std::istringstream help(run_floe(folder.path(), command + " --help").out);
  std::vector<std::string> examples;
  for (std::string line; std::getline(help, line);)
    if (line.starts_with("  floe ")) examples.push_back(line.substr(7));
  return examples;
}

TEST(Help, ListsTheCommandsThatUsersRelyOn) {
  const auto names = commands();
  for (const char* name :
       {"info", "effects", "simulate", "reconstruct", "compare", "import", "export", "merge", "validate"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
}

TEST(Help, OfEveryCommandHasExamplesAndIsNoWiderThanATerminal) {
  const TemporaryFolder folder;
  for (const std::string& command : commands()) {
    const Outcome outcome = run_floe(folder.path(), command + " --help");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("Examples:"), std::string::npos) << command;
    EXPECT_NE(outcome.out.find("--json"), std::string::npos) << command;
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
  }
}

TEST(Help, VersionIsANumber) {
  const TemporaryFolder folder;
  const Outcome outcome = run_floe(folder.path(), "--version");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.out.starts_with("floe 0.")) << outcome.out;
}

// The examples of these commands take no time and run one after the other in one folder.
TEST(Help, ExamplesRunAsPrinted) {
  const TemporaryFolder folder;
  write_model_directory(folder.path() / "my-ice");
  write_bytes(
      folder.path() / "events.f2k",
      "EM 1 1 1970 0 0 0\nTR 1 0 e- 20 -40 -300 70 130 0 100 0\nTR 2 0 hadr 20 -40 -300 70 130 0 50 10\n"
      "EM 2 1 1970 0 0 0\nTR 1 0 ph 0 0 -300 90 0 0 10000 0\n");
  write_bytes(
      folder.path() / "runs.toml",
      "[defaults]\nphotons = 1e7\n[[run]]\nmodule = [63, 20]\n[[run]]\nmodule = [63, 20]\nleds = 3\n");
  write_bytes(folder.path() / "fit.json",
              R"({"events": [{"event": "cascade", "status": "ok", "fit": {"x": 20, "y": -40, "z": -300,
              "time_ns": 0, "zenith_deg": 70, "azimuth_deg": 130, "energy_gev": 3000}}]})");
  for (const std::string command : {"info", "effects", "crystal", "simulate", "export", "import", "view"})
    for (const std::string& example : examples_of(command)) {
      const Outcome outcome = run_floe(folder.path(), example);
      EXPECT_EQ(outcome.code, 0) << "floe " << example << "\n" << outcome.err;
      EXPECT_EQ(outcome.err, "") << "floe " << example;
    }
}

// Fits take minutes; that their examples are understood shows in the complaint about the missing file.
TEST(Help, ExamplesOfFitsAreUnderstood) {
  const TemporaryFolder folder;
  for (const std::string command : {"reconstruct", "compare"})
    for (const std::string& example : examples_of(command)) {
      const Outcome outcome = run_floe(folder.path(), example);
      EXPECT_EQ(outcome.code, 3) << "floe " << example << "\n" << outcome.err;
    }
}

}  // namespace
}  // namespace floe::test
