#include "apps/flasher_data_file.h"

#include "data/event_files.h"
#include "data/flasher_text.h"

namespace floe {

std::vector<Event> read_flasher_events(const std::string& file) {
  if (file.ends_with(".h5")) return read_event_file(file).events;
  std::vector<Event> events;
  for_each_flasher_run(file, [&](const Event& event) { events.push_back(event); });
  return events;
}

}  // namespace floe
