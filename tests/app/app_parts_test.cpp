// The pieces of the command line that have rules of their own.
#include <gtest/gtest.h>

#include "apps/command_line.h"
#include "apps/help_formatter.h"
#include "apps/option_values.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "apps/text_table.h"
#include "data/base/error.h"
#include "data/base/words.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

TEST(NearestWord, FindsTypingMistakesOnly) {
  const std::vector<std::string> words{"--photons", "--seed", "--ice"};
  EXPECT_EQ(nearest_word("--photon", words), "--photons");
  EXPECT_EQ(nearest_word("--sead", words), "--seed");
  EXPECT_EQ(nearest_word("--completely-different", words), "");
}

TEST(CommandLine, IsQuotedForAShell) {
  std::string words[] = {"floe", "info", "--ice", "my ice", "it's", ""};
  char* argv[6];
  for (int i = 0; i < 6; ++i) argv[i] = words[i].data();
  EXPECT_EQ(quoted_command_line(6, argv), "floe info --ice 'my ice' 'it'\\''s' ''");
}

TEST(OptionNumber, IsReadWhole) {
  EXPECT_EQ(parse_option_number("--n", "2e9", positive), 2e9);
  EXPECT_EQ(parse_option_number("--n", "-0.2", any_number), -0.2);
  for (const char* bad : {"", " 1", "1 ", "1e", "0x10", "1,5", "nan", "inf", "-1", "0"})
    EXPECT_THROW(parse_option_number("--n", bad, positive), UsageError) << bad;
}

TEST(OptionNumber, KeepsItsRange) {
  EXPECT_EQ(parse_option_number("--n", "1", {1, 100}), 1);
  EXPECT_EQ(parse_option_number("--n", "100", {1, 100}), 100);
  EXPECT_THROW(parse_option_number("--n", "100.1", {1, 100}), UsageError);
  EXPECT_EQ(message_of<UsageError>([] {
              parse_option_number("--oversize", "0", {1, 100});
            }),
            "--oversize: found \"0\"; expected a number of at least 1 and at most 100");
}

TEST(OptionInteger, IsWholeAndFits) {
  EXPECT_EQ(parse_option_integer("--n", "9223372036854775807", 0, INT64_MAX), INT64_MAX);
  for (const char* bad : {"9223372036854775808", "1.0", "1e3", "-1", ""})
    EXPECT_THROW(parse_option_integer("--n", bad, 0, INT64_MAX), UsageError) << bad;
}

TEST(SplitList, KeepsEmptyParts) {
  EXPECT_EQ(split_list("a,b"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(split_list("a,,b,"), (std::vector<std::string>{"a", "", "b", ""}));
}

TEST(TextTable, AlignsColumns) {
  TextTable table({"name", "a", "long"});
  table.add({"x", "10.5", "1"});
  EXPECT_EQ(table.str(), "name     a  long\nx     10.5     1\n");
}

TEST(HelpText, IsBrokenAtBlanks) {
  EXPECT_EQ(wrapped("one two three four", 12, 2), "one two\n  three four");
}

TEST(ProgressLine, ShowsStagePercentAndTimeLeft) {
  EXPECT_EQ(progress_line(0.25, "fitting", 30, 80),
            "[======                  ]  25%  1:30 min left  fitting");
  EXPECT_EQ(progress_line(0.5, "fitting", 3, 80), "[============            ]  50%  3 s left  fitting");
}

TEST(ProgressLine, SaysNoTimeLeftTooEarlyAndNeverWraps) {
  EXPECT_EQ(progress_line(0.01, "seed", 3, 80).find("left"), std::string::npos);
  EXPECT_EQ(progress_line(0.5, std::string(200, 'x'), 3, 80).size(), 79u);
  EXPECT_EQ(progress_log_line(0.25, "fitting", 30), " 25%  1:30 min left  fitting");
}

TEST(PlannedOutput, AppearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "out.json").string();
  {
    PlannedOutput output(file);
    output.write("text");
    EXPECT_FALSE(std::filesystem::exists(file));
  }
  EXPECT_EQ(folder.file_count(), 0u);
  PlannedOutput output(file);
  output.write(json_text({{"x", 1.5}, {"missing", std::numeric_limits<double>::quiet_NaN()}}));
  output.commit();
  EXPECT_EQ(bytes_of(file), "{\n  \"x\": 1.5,\n  \"missing\": null\n}\n");
}

TEST(PlannedOutput, FindsAMissingFolderBeforeTheWork) {
  EXPECT_THROW(PlannedOutput("/no/such/folder/out.json"), OutputError);
  EXPECT_NO_THROW(PlannedOutput(std::nullopt));
}

}  // namespace
}  // namespace floe::test
