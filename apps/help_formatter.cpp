#include "apps/help_formatter.h"

#include <fmt/format.h>

#include <sstream>

namespace floe {

namespace {
constexpr std::size_t line_columns = 100, text_column = 34;
}

std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent) {
  std::istringstream words(text);
  std::string result, word;
  std::size_t used = 0;
  while (words >> word) {
    if (used > 0 && indent + used + 1 + word.size() > columns) {
      result.append("\n").append(indent, ' ');
      used = 0;
    }
    if (used > 0) result.append(" ");
    result.append(word);
    used += word.size() + (used > 0 ? 1 : 0);
  }
  return result;
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  std::string names = "  " + option->get_name(is_positional, true);
  if (!is_positional && option->get_items_expected_max() > 0 && !option->get_type_name().empty())
    names += " " + option->get_type_name();
  std::string text = option->get_description();
  if (!option->get_default_str().empty()) text += fmt::format(" [default: {}]", option->get_default_str());
  if (option->get_required() && !is_positional) text += " (needed)";
  const bool fits = names.size() + 2 <= text_column;
  return fmt::format("{:<{}}{}\n", fits ? names : names + "\n" + std::string(text_column, ' '),
                     fits ? text_column : 0, wrapped(text, line_columns, text_column));
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
  return app->get_footer().empty() ? "" : app->get_footer() + "\n";
}

}  // namespace floe
