// Pulses as IceTray's HDF5 writer lays them out (docs/formats.md): a table of all pulses, and an index beside
// it that says which rows are an event's.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/event.h"

namespace floe {

inline constexpr const char* usual_icetray_table = "InIcePulses";

// Whether an HDF5 file has such an index. Throws InputError when it cannot be read.
bool is_icetray_file(const std::filesystem::path& path);

// Events are named RUN-EVENT, or RUN-EVENT-SUBEVENT-STREAM where one of the two is not 0. Pulses without
// charge are passed over. Without `table` the file must have one table of pulses only. Throws InputError: no
// table, several (naming them), missing columns, values that no hit may have, rows that do not fit together.
std::vector<Event> read_icetray_pulses(const std::filesystem::path& path,
                                       const std::optional<std::string>& table = {});

// Names of the form RUN-EVENT or RUN-EVENT-SUBEVENT-STREAM become those numbers; otherwise the run is 0 and
// events are numbered from 0. Throws OutputError, and UsageError for averages over several events, which the
// tables cannot tell from events.
void write_icetray_pulses(const std::filesystem::path& path, std::span<const Event> events,
                          const std::string& table = usual_icetray_table);

}  // namespace floe
