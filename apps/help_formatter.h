// How --help looks: one option an entry, text wrapped, defaults in words.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace floe {

class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_footer(const CLI::App* app) const override;
};

// `text` broken at blanks so that no line is longer than `columns`; lines after the first begin with
// `indent` blanks.
std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent);

}  // namespace floe
