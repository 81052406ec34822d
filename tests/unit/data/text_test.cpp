#include "data/base/text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "data/base/atomic_file.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe {

using test::message_of;
using test::TemporaryFolder;
using test::write_bytes;
using ::testing::Test;

namespace {

TextLine line_of(std::vector<std::string> fields) {
  std::string text;
  for (const std::string& field : fields) text += (text.empty() ? "" : " ") + field;
  return {{"table.dat", 3}, text, std::move(fields)};
}

class TextTest : public Test {
 protected:
  std::filesystem::path file(std::string_view content, const char* name = "table.dat") const {
    write_bytes(folder.path() / name, content);
    return folder.path() / name;
  }
  TemporaryFolder folder;
};

}  // namespace

TEST_F(TextTest, SplitsLinesAtBlanksWithoutComments) {
  const auto lines = read_text_lines(file("# head\n\n 1\t2.5  x # tail\r\n   \n4#5\nlast"));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].where.line, 3);
  EXPECT_EQ(lines[0].text, "1\t2.5  x");
  EXPECT_EQ(lines[0].fields, (std::vector<std::string>{"1", "2.5", "x"}));
  EXPECT_EQ(lines[1].where.line, 5);
  EXPECT_EQ(lines[1].fields, (std::vector<std::string>{"4"}));
  EXPECT_EQ(lines[2].where.line, 6);
  EXPECT_EQ(lines[2].fields, (std::vector<std::string>{"last"}));
  EXPECT_EQ(lines[2].where.file, (folder.path() / "table.dat").string());
}

TEST_F(TextTest, GunzipsByContent) {
  write_whole_file(folder.path() / "a.gz", "1 2\n3 4\n");
  std::filesystem::rename(folder.path() / "a.gz", folder.path() / "a.dat");
  EXPECT_EQ(test::bytes_of(folder.path() / "a.dat").substr(0, 2), "\x1f\x8b");
  EXPECT_EQ(read_whole_file(folder.path() / "a.dat"), "1 2\n3 4\n");
}

TEST_F(TextTest, ReadsPlainTextUnderAGzipName) {
  EXPECT_EQ(read_whole_file(file("1 2\n", "plain.gz")), "1 2\n");
}

TEST_F(TextTest, ReadsMoreThanOnePortion) {
  std::string content;
  for (int i = 0; content.size() < 5'000'000; ++i) content += std::to_string(i) + "\n";
  EXPECT_EQ(read_whole_file(file(content)), content);
  EXPECT_EQ(read_text_lines(file(content)).back().where.line,
            static_cast<long>(std::count(content.begin(), content.end(), '\n')));
}

TEST_F(TextTest, AnEmptyFileHasNoLines) {
  EXPECT_TRUE(read_text_lines(file("")).empty());
  EXPECT_TRUE(read_text_lines(file("# only\n#comments")).empty());
}

TEST_F(TextTest, TruncatedGzipIsAnErrorAtEveryLength) {
  std::string content;
  for (int i = 0; i < 5000; ++i) content += std::to_string(i * 7919 % 5003) + "\n";
  write_whole_file(folder.path() / "whole.gz", content);
  const std::string whole = test::bytes_of(folder.path() / "whole.gz");
  for (const std::size_t length : {std::size_t{10}, std::size_t{100}, whole.size() / 2, whole.size() - 9,
                                   whole.size() - 8, whole.size() - 1}) {
    SCOPED_TRACE(length);
    const auto cut = file(whole.substr(0, length), "cut.gz");
    EXPECT_NE(message_of<InputError>([&] { read_whole_file(cut); }).find("truncated"), std::string::npos);
  }
}

TEST_F(TextTest, DamagedGzipIsAnError) {
  write_whole_file(folder.path() / "whole.gz", "some text that is long enough to be worth it\n");
  std::string damaged = test::bytes_of(folder.path() / "whole.gz");
  damaged[damaged.size() - 6] ^= 0x55;  // in the checksum
  EXPECT_NE(message_of<InputError>([&] { read_whole_file(file(damaged, "bad.gz")); }).find("damaged gzip"),
            std::string::npos);
}

TEST_F(TextTest, MissingFilesAndFoldersAreErrors) {
  EXPECT_NE(message_of<InputError>([&] { read_whole_file(folder.path() / "none"); }).find("no file"),
            std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { read_text_lines(folder.path()); }).find("a directory"),
            std::string::npos);
}

TEST(ParseNumberTest, TakesWholeFields) {
  EXPECT_EQ(parse_number(line_of({"1.5"}), 0, "x"), 1.5);
  EXPECT_EQ(parse_number(line_of({"a", "+2"}), 1, "x"), 2);
  EXPECT_EQ(parse_number(line_of({"-1e-3"}), 0, "x"), -1e-3);
  EXPECT_EQ(parse_number(line_of({".5"}), 0, "x"), 0.5);
  EXPECT_EQ(parse_integer(line_of({"-12"}), 0, "x"), -12);
}

TEST(ParseNumberTest, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(message_of<InputError>([] {
              parse_number(line_of({"1", "2x"}), 1, "depth [m]");
            }),
            "table.dat:3: found '2x'; expected a number for depth [m] in field 2");
}

TEST(ParseNumberTest, RefusesEverythingElse) {
  for (const char* text :
       {"x", "1.5x", "1,5", "--1", "+-1", "++1", "+", "-", "", "0x10", "1e", "1 2", "1e999"})
    EXPECT_THROW(parse_number(line_of({text}), 0, "x"), InputError) << text;
  for (const char* text : {"1.0", "1e3", "x", "", "99999999999999999999", "0x1"})
    EXPECT_THROW(parse_integer(line_of({text}), 0, "x"), InputError) << text;
  for (const char* text : {"nan", "NaN", "-nan", "inf", "-inf", "infinity", "+inf"})
    EXPECT_NE(message_of<InputError>([&] { parse_number(line_of({text}), 0, "x"); }).find("not finite"),
              std::string::npos)
        << text;
  EXPECT_THROW(parse_number(line_of({"1"}), 1, "x"), InputError);
}

TEST(ExpectFieldsTest, CountsThem) {
  const TextLine line = line_of({"1", "2", "3"});
  EXPECT_NO_THROW(expect_fields(line, 3, 3, "a b c"));
  EXPECT_NO_THROW(expect_fields(line, 2, 4, "a b [c] [d]"));
  EXPECT_EQ(message_of<InputError>([&] { expect_fields(line, 4, 4, "a b c d"); }),
            "table.dat:3: found 3 fields in '1 2 3'; expected 4: a b c d");
  EXPECT_EQ(message_of<InputError>([&] { expect_fields(line, 1, 2, "a [b]"); }),
            "table.dat:3: found 3 fields in '1 2 3'; expected 1 to 2: a [b]");
}

TEST(ExpectRangeTest, IncludesItsLimits) {
  const TextLine line = line_of({"5"});
  EXPECT_NO_THROW(expect_range(line, 5, 5, 5, "x"));
  EXPECT_EQ(message_of<InputError>([&] { expect_range(line, 5.5, 0, 5, "x [m]"); }),
            "table.dat:3: found 5.5 for x [m]; expected a value from 0 to 5");
  EXPECT_THROW(expect_range(line, std::numeric_limits<double>::quiet_NaN(), 0, 5, "x"), InputError);
}

TEST(InQuotesTest, KeepsMessagesReadable) {
  EXPECT_EQ(in_quotes("a b"), "'a b'");
  EXPECT_EQ(in_quotes(std::string_view("a\0\n", 3)), "'a\\x00\\x0a'");
  EXPECT_EQ(in_quotes(std::string(100, 'x')), "'" + std::string(60, 'x') + "...'");
}

}  // namespace floe
