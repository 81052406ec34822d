// Errors as part of the product: what went wrong, where, what was expected, what to do.
//
// Every error that a user can cause is one of these; the command line turns each into its exit
// code (see ExitCode) and prints what() on stderr. Programming mistakes are asserts, not errors.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace floe {

enum class ExitCode { done = 0, disagreement = 1, usage = 2, bad_input = 3, no_result = 4, bad_output = 5 };

class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

// Wrong use of the command line or of a function: an unknown option, key or value.
struct UsageError : Error {
  explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

// A place in a text file; line 0 means the file as a whole.
struct Location {
  std::string file;
  long line = 0;
};

// Input that is missing, malformed or unphysical. The message reads
// "FILE:LINE: found FOUND; expected EXPECTED[. ADVICE]".
struct InputError : Error {
  explicit InputError(const std::string& message) : Error(ExitCode::bad_input, message) {}
  InputError(const Location& where, std::string_view found, std::string_view expected,
             std::string_view advice = "");
};

// Valid input from which no result follows: not enough light, no convergence, event outside.
struct NoResult : Error {
  explicit NoResult(const std::string& message) : Error(ExitCode::no_result, message) {}
};

// A comparison that was asked for has found that two things do not agree.
struct Disagreement : Error {
  explicit Disagreement(const std::string& message) : Error(ExitCode::disagreement, message) {}
};

// Output that could not be written.
struct OutputError : Error {
  explicit OutputError(const std::string& message) : Error(ExitCode::bad_output, message) {}
};

}  // namespace floe
