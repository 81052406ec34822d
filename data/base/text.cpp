#include "data/base/text.h"

#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>

namespace floe {

namespace {

constexpr std::size_t largest_file = std::size_t{4} << 30;  // [bytes], after gunzip
constexpr std::string_view blanks = " \t\r\v\f";

struct CloseGzip {
  void operator()(gzFile file) const { gzclose_r(file); }
};
using GzipInput = std::unique_ptr<gzFile_s, CloseGzip>;

GzipInput open_input(const std::filesystem::path& file) {
  expect_readable_file(file);
  GzipInput input(gzopen(file.c_str(), "rb"));
  if (!input) throw InputError({file.string()}, std::strerror(errno), "a file that can be read");
  gzbuffer(input.get(), 1 << 17);
  return input;
}

[[noreturn]] void throw_unreadable(const std::filesystem::path& file, gzFile input) {
  int code = Z_OK;
  const char* message = gzerror(input, &code);
  const Location where{file.string()};
  if (code == Z_BUF_ERROR)
    throw InputError(where, "a gzip file that ends too early", "a whole gzip file",
                     "It is truncated: copy or make it again");
  if (code == Z_ERRNO) throw InputError(where, std::strerror(errno), "a file that can be read");
  throw InputError(where, fmt::format("damaged gzip data ({})", message), "a whole gzip file",
                   "Copy or make it again");
}

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(blanks);
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

// Splits into the strings that `fields` has already, so that a long table does not allocate per line.
void split(std::string_view text, std::vector<std::string>& fields) {
  std::size_t count = 0;
  for (auto begin = text.find_first_not_of(blanks); begin != text.npos;) {
    const auto end = std::min(text.find_first_of(blanks, begin), text.size());
    if (count == fields.size()) fields.emplace_back();
    fields[count++].assign(text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, end);
  }
  fields.resize(count);
}

[[noreturn]] void throw_bad_field(const TextLine& line, std::size_t field, std::string_view kind,
                                  std::string_view what, std::string_view because = "") {
  throw InputError(line.where, in_quotes(line.fields[field]) + std::string(because),
                   fmt::format("{} for {} in field {}", kind, what, field + 1));
}

void expect_field(const TextLine& line, std::size_t field, std::string_view what) {
  if (field >= line.fields.size())
    throw InputError(line.where, fmt::format("{} fields", line.fields.size()),
                     fmt::format("{} in field {}", what, field + 1));
}

// from_chars takes no plus sign, which tables do hold; "+-1" stays an error.
std::string_view without_plus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

}  // namespace

void expect_readable_file(const std::filesystem::path& file) {
  const Location where{file.string()};
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  if (!std::filesystem::exists(status))
    throw InputError(where, "no file of this name", "a file", "Check the spelling of the path");
  if (std::filesystem::is_directory(status)) throw InputError(where, "a directory", "a file");
  if (::access(file.c_str(), R_OK) != 0)
    throw InputError(where, std::strerror(errno), "a file that can be read");
}

std::string read_whole_file(const std::filesystem::path& file) {
  const GzipInput input = open_input(file);
  std::string content;
  constexpr std::size_t portion = 1 << 20;
  for (;;) {
    const std::size_t before = content.size();
    content.resize(before + portion);
    const int got = gzread(input.get(), content.data() + before, portion);
    if (got < 0) throw_unreadable(file, input.get());
    content.resize(before + static_cast<std::size_t>(got));
    if (content.size() > largest_file)
      throw InputError({file.string()}, "more than 4 GiB", "at most 4 GiB of text", "Split the file");
    if (got == 0) break;
  }
  int code = Z_OK;
  gzerror(input.get(), &code);
  if (code != Z_OK) throw_unreadable(file, input.get());
  return content;
}

void for_each_text_line(const std::filesystem::path& file, const std::function<void(const TextLine&)>& use) {
  const std::string content = read_whole_file(file);
  TextLine line{{file.string()}, {}, {}};
  for (std::string_view rest = content; !rest.empty();) {
    const auto end = std::min(rest.find('\n'), rest.size());
    std::string_view text = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++line.where.line;
    text = trimmed(text.substr(0, text.find('#')));
    if (text.empty()) continue;
    line.text.assign(text);
    split(text, line.fields);
    use(line);
  }
}

std::vector<TextLine> read_text_lines(const std::filesystem::path& file) {
  std::vector<TextLine> lines;
  for_each_text_line(file, [&](const TextLine& line) { lines.push_back(line); });
  return lines;
}

double parse_number(const TextLine& line, std::size_t field, std::string_view what) {
  expect_field(line, field, what);
  const std::string_view text = without_plus(line.fields[field]);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range)
    throw_bad_field(line, field, "a number", what, " (too large or too small for a number)");
  if (error != std::errc{} || end != text.data() + text.size())
    throw_bad_field(line, field, "a number", what);
  if (!std::isfinite(value)) throw_bad_field(line, field, "a number", what, " (not finite)");
  return value;
}

long parse_integer(const TextLine& line, std::size_t field, std::string_view what) {
  expect_field(line, field, what);
  const std::string_view text = without_plus(line.fields[field]);
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw_bad_field(line, field, "a whole number", what);
  return value;
}

void expect_fields(const TextLine& line, std::size_t least, std::size_t most, std::string_view layout) {
  const std::size_t count = line.fields.size();
  if (count >= least && count <= most) return;
  const std::string allowed = least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
  throw InputError(line.where, fmt::format("{} fields in {}", count, in_quotes(line.text)),
                   fmt::format("{}: {}", allowed, layout));
}

void expect_range(const TextLine& line, double value, double low, double high, std::string_view what) {
  if (value >= low && value <= high) return;
  throw InputError(line.where, fmt::format("{} for {}", value, what),
                   fmt::format("a value from {} to {}", low, high));
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t most = 60;
  std::string result = "'";
  for (const char c : text.substr(0, most)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f)
      result += fmt::format("\\x{:02x}", byte);
    else
      result += c;
  }
  return result + (text.size() > most ? "...'" : "'");
}

}  // namespace floe
