// Wrong uses of the program, one row each in a table of a parameterised test.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "tests/app/floe_runner.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {

struct WrongCase {
  std::string name, arguments;
  int code;
  std::string said;
};

inline std::ostream& operator<<(std::ostream& stream, const WrongCase& wrong) {
  return stream << "floe " << wrong.arguments;
}

inline std::string name_of_case(const testing::TestParamInfo<WrongCase>& given) {
  return given.param.name;
}

// The same cases with `command` in front of their arguments, so that a table need not repeat it.
inline std::vector<WrongCase> cases_of(const std::string& command, std::span<const WrongCase> cases) {
  std::vector<WrongCase> whole(cases.begin(), cases.end());
  for (WrongCase& wrong : whole) wrong.arguments = command + wrong.arguments;
  return whole;
}

// One readable event, so that a wrong option cannot hide behind a missing file.
inline void write_readable_event(const std::filesystem::path& file) {
  write_bytes(file, "HIT 20 30 100.0 400.0 1.5 0.5 1.5 0.5\n");
}

// Run in `folder`, it fails as it should, and the folder holds the same files as before.
inline void expect_said_and_nothing_left(const std::filesystem::path& folder, const WrongCase& wrong) {
  const auto before = files_in(folder);
  const Outcome outcome = run_floe(folder, wrong.arguments);
  expect_error(outcome, wrong.code, wrong.said);
  EXPECT_EQ(files_in(folder), before);
}

}  // namespace floe::test
