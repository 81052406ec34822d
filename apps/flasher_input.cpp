#include "apps/flasher_input.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/option_values.h"
#include "data/base/error.h"
#include "data/event_files.h"
#include "data/flasher_text.h"

namespace floe {

std::vector<Event> read_flasher_file(const std::string& file) {
  if (file.ends_with(".h5")) {
    std::vector<Event> events = read_event_file(file).events;
    if (std::none_of(events.begin(), events.end(), [](const Event& e) { return e.flasher.has_value(); }))
      throw InputError({file}, fmt::format("no flasher run among its {} events", events.size()),
                       "flasher runs, as floe simulate --flashers RUNS.toml writes them");
    return events;
  }
  std::vector<Event> events;  // texts of flasher runs have lines that say where each begins
  for_each_flasher_run(file, [&](const Event& event) { events.push_back(event); });
  return events;
}

double oversize_for(const std::vector<Event>& runs, const SimulationSettings& settings) {
  double of_runs = 0;
  for (const Event& event : runs) {
    if (!event.flasher || event.flasher->oversize == of_runs) continue;
    if (of_runs > 0 && !settings.oversize_given)
      throw InputError(
          fmt::format("{}: simulated with oversize {:g}, a run before it with {:g}; say with "
                      "--oversize which the simulations shall have, or use runs of one",
                      event.id, event.flasher->oversize, of_runs));
    of_runs = event.flasher->oversize;
  }
  const bool simulated = of_runs > 1;
  if (!settings.oversize_given) return simulated ? of_runs : settings.oversize;
  if (simulated && of_runs != settings.oversize)
    fmt::print(
        stderr,
        "floe: warning: the data have oversize {:g}, simulations {:g}: wider modules see light earlier "
        "and count some of it twice\n",
        of_runs, settings.oversize);
  return settings.oversize;
}

std::pair<double, double> parse_depths(const std::string& text) {
  const std::vector<std::string> parts = split_list(text);
  if (parts.size() != 2)
    throw UsageError(fmt::format("--depths: found \"{}\"; expected TOP,BOTTOM in metres", text));
  const double top = parse_option_number("--depths", parts[0], {0, 5000});
  const double bottom = parse_option_number("--depths", parts[1], {0, 5000});
  if (bottom <= top)
    throw UsageError(fmt::format("--depths: found \"{}\"; expected the shallower depth first", text));
  return {top, bottom};
}

}  // namespace floe
