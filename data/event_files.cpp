#include "data/event_files.h"

#include <fmt/format.h>

#include "data/base/error.h"
#include "data/event_rules.h"
#include "data/hdf5_reader.h"
#include "data/icetray_tables.h"
#include "data/text_events.h"

namespace floe {

EventFile read_event_file(const std::filesystem::path& path) {
  if (is_hdf5(path)) {
    if (is_icetray_file(path)) return {read_icetray_pulses(path), {}};
    return read_hdf5_events(path);
  }
  const std::string suffix = text_suffix_of(path);
  if (suffix == ".h5" || suffix == ".hdf5") return read_hdf5_events(path);
  if (suffix == ".hits" || suffix == ".txt") return {{read_hit_text(path)}, {}};
  if (suffix == ".dat") return {{read_charge_list(path)}, {}};
  throw InputError({path.string()}, fmt::format("the suffix '{}'", suffix),
                   "an event file: .h5, .hits (photons) or .dat (charges), the texts also with .gz");
}

}  // namespace floe
