#include "apps/event_arguments.h"

#include <fmt/format.h>

#include "data/base/error.h"
#include "data/event_files.h"

namespace floe {

const std::string& require_event_file_name(const std::string& file) {
  if (!file.ends_with(".h5"))
    throw UsageError(fmt::format(
        "--output: found \"{}\"; expected a name that ends in .h5 (floe export writes texts)", file));
  return file;
}

void add_event_arguments(CLI::App& app, std::vector<std::string>& files) {
  app.add_option("EVENT", files, "Event files: .h5, or texts .hits, .dat, also with .gz")
      ->type_name("FILE")
      ->required();
}

std::vector<Event> read_events(const std::vector<std::string>& files) {
  std::vector<Event> events;
  for (const std::string& file : files) {
    EventFile content = read_event_file(file);
    if (content.provenance && content.provenance->weighted)
      fmt::print(
          stderr,
          "floe: warning: {}: weighted photons, which are no counts of hits: fits to them have wrong errors "
          "and p-values\n",
          file);
    for (Event& event : content.events) {
      events.push_back(std::move(event));
      if (files.size() > 1) events.back().id = file + ":" + events.back().id;
    }
  }
  return events;
}

}  // namespace floe
