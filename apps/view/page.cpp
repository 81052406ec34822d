#include "apps/view/page.h"

#include <string_view>

#include "reco/figures/svg.h"

namespace floe {

extern const std::string_view page_html, page_css, page_js;  // page.html, page.css, page.js

namespace {

// The page's text with each {{name}} replaced, in one go: what is put in may itself hold what looks like a
// mark.
template <typename Text>
std::string filled(std::string_view page, Text text_of) {
  std::string result;
  for (std::size_t at = page.find("{{"); at != page.npos; at = page.find("{{")) {
    const std::size_t end = page.find("}}", at);
    result += page.substr(0, at);
    result += text_of(page.substr(at + 2, end - at - 2));
    page.remove_prefix(end + 2);
  }
  return result += page;
}

// JSON inside a script element: no "</" may end it, no "<!--" may hide what follows.
std::string script_data(const Json& data) {
  std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != text.npos; at = text.find('<', at))
    text.replace(at, 1, "\\u003c");
  return text;
}

}  // namespace

std::string event_page(const std::string& title, const Json& data) {
  return filled(page_html, [&](std::string_view name) -> std::string {
    if (name == "title") return markup_escaped(title);
    if (name == "style") return std::string(page_css);
    if (name == "program") return std::string(page_js);
    return script_data(data);
  });
}

}  // namespace floe
