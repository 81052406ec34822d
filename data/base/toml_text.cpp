#include "data/base/toml_text.h"

#include <fmt/format.h>

#include <sstream>
#include <string_view>

#include "data/base/text.h"

namespace floe {

namespace {

std::string without_indent(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t");
  return begin == text.npos ? "" : text.substr(begin);
}

// "[error] toml::parse_array: a reason\n --> ..." is told as "a reason".
std::string reason_of(const toml::exception& error) {
  std::string reason = error.what();
  reason = reason.substr(0, reason.find('\n'));
  for (const std::string_view before_reason : {"[error] ", ": "})
    if (const auto found = reason.find(before_reason); found != reason.npos)
      reason = reason.substr(found + before_reason.size());
  return reason;
}

}  // namespace

toml::value read_toml(const std::string& file, const std::string& advice) {
  std::istringstream text(read_whole_file(file));
  try {
    return toml::parse(text, file);
  } catch (const toml::exception& error) {
    const auto place = error.location();
    throw InputError({file, static_cast<long>(place.line())}, in_quotes(without_indent(place.line_str())),
                     fmt::format("TOML ({})", reason_of(error)), advice);
  } catch (const std::exception& error) {  // e.g. a number that no number type holds
    throw InputError({file}, "what cannot be read as TOML", fmt::format("TOML ({})", error.what()));
  }
}

Location place_of(const std::string& file, const toml::value& value) {
  return {file, static_cast<long>(value.location().line())};
}

std::string quoted_line(const toml::value& value) {
  return in_quotes(without_indent(value.location().line_str()));
}

}  // namespace floe
