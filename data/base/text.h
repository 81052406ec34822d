// Reading plain-text tables strictly: every malformed line is an InputError with file, line, what
// was found and what was expected.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "data/base/error.h"

namespace floe {

// One non-empty line of a text file, split at blanks, with its comment ('#' to the end) removed.
struct TextLine {
  Location where;
  std::string text;                 // without comment, trimmed
  std::vector<std::string> fields;  // at least one
};

// All lines that hold something. Reads gzipped files too (by content, not by name).
// Throws InputError when the file is missing, unreadable, truncated (gzip) or larger than 4 GiB.
std::vector<TextLine> read_text_lines(const std::filesystem::path& file);

// The same lines one after the other, for tables too long to keep; the line lives until `use` returns.
void for_each_text_line(const std::filesystem::path& file, const std::function<void(const TextLine&)>& use);

// Throws InputError, with the reason, unless `file` exists, is no directory and can be opened.
void expect_readable_file(const std::filesystem::path& file);

// The whole of a file as it is, gunzipped when it is gzipped. Errors as above.
std::string read_whole_file(const std::filesystem::path& file);

// The number that a field holds, whole and finite; `what` names it in the error ("depth [m]").
double parse_number(const TextLine& line, std::size_t field, std::string_view what);
long parse_integer(const TextLine& line, std::size_t field, std::string_view what);

// Throws InputError unless the line has between `least` and `most` fields.
void expect_fields(const TextLine& line, std::size_t least, std::size_t most, std::string_view layout);

// Throws InputError unless low <= value <= high; `what` as in parse_number.
void expect_range(const TextLine& line, double value, double low, double high, std::string_view what);

// Text from a file as error messages show it: in quotes, at most 60 characters, unprintable ones escaped.
std::string in_quotes(std::string_view text);

}  // namespace floe
