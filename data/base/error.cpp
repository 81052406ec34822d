#include "data/base/error.h"

#include <fmt/format.h>

namespace floe {

namespace {
std::string input_message(const Location& where, std::string_view found, std::string_view expected,
                          std::string_view advice) {
  std::string message = where.file;
  if (where.line > 0) message += fmt::format(":{}", where.line);
  message += fmt::format(": found {}; expected {}", found, expected);
  if (!advice.empty()) message += fmt::format(". {}", advice);
  return message;
}
}  // namespace

InputError::InputError(const Location& where, std::string_view found, std::string_view expected,
                       std::string_view advice)
    : Error(ExitCode::bad_input, input_message(where, found, expected, advice)) {}

}  // namespace floe
