#include "apps/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "data/base/error.h"
#include "data/base/words.h"

namespace floe {

namespace {

std::string quoted(const std::string& word) {
  const auto harmless = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("-_./,=:+@%", c);
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), harmless)) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::string unknown_word(const CLI::App& app, bool is_command, const std::string& word) {
  const bool is_option = word.size() > 1 && word.front() == '-';
  const std::string bare = word.substr(0, word.find('='));
  std::string message = fmt::format("{} {}",
                                    is_option    ? "unknown option"
                                    : is_command ? "unexpected argument"
                                                 : "unknown command",
                                    is_option ? bare : word);
  if (is_option || !is_command) {
    const std::string meant = nearest_word(bare, is_option ? option_names(app) : command_names(app));
    if (!meant.empty()) message += fmt::format("; did you mean {}?", meant);
  }
  return message;
}

bool is_output(const CLI::Option& option) {
  constexpr std::string_view outputs[] = {"output",         "json", "picture", "skymap",
                                          "skymap-picture", "rows", "into"};
  return std::ranges::any_of(option.get_lnames(),
                             [&](const std::string& name) { return std::ranges::count(outputs, name) > 0; });
}

std::filesystem::path place_of(const std::string& file) {
  std::error_code failed;
  const std::filesystem::path place =
      std::filesystem::weakly_canonical(std::filesystem::absolute(file), failed);
  return failed ? std::filesystem::path(file) : place;
}

// `output` is given at most once.
bool name_one_file(const CLI::Option& output, const CLI::Option& other) {
  return !output.empty() && std::ranges::any_of(other.results(), [&](const std::string& value) {
    return !value.empty() && place_of(value) == place_of(output.results().front());
  });
}

}  // namespace

void expect_outputs_apart(const CLI::App& command) {
  const std::vector<const CLI::Option*> options = command.get_options();
  for (const CLI::Option* output : options)
    for (const CLI::Option* other : options)
      if (other != output && is_output(*output) && name_one_file(*output, *other))
        throw UsageError(fmt::format("{} and {} are the same file, {}. Give the output a name of its own",
                                     output->get_name(), other->get_name(), output->results().front()));
}

std::string quoted_command(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line.append(line.empty() ? "" : " ").append(quoted(word));
  return line;
}

std::string quoted_command_line(int argc, char** argv) {
  std::vector<std::string> words = {"floe"};
  words.insert(words.end(), argv + 1, argv + argc);
  return quoted_command(words);
}

int report_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
  const auto commands = app.get_subcommands();
  const CLI::App& used = commands.empty() ? app : *commands.front();
  // An option that is missing is often one that was mistyped: say that first.
  const auto unknown = used.remaining();
  std::string message =
      unknown.empty() ? error.what() : unknown_word(used, !commands.empty(), unknown.front());
  if (const std::size_t twice = message.find(": At Most 1 required but received"); twice != message.npos)
    message = message.substr(0, twice) + " is given more than once";
  if (unknown.empty() && commands.empty()) message = "no command given";
  const std::string called = commands.empty() ? "floe" : "floe " + used.get_name();
  fmt::print(stderr, "floe: error: {}\nSee {} --help\n", message, called);
  return static_cast<int>(ExitCode::usage);
}

}  // namespace floe
