// Single lines of the texts of hits that other tools write (docs/formats.md).
#pragma once

#include <string_view>

#include "data/base/text.h"
#include "data/event.h"

namespace floe {

inline constexpr std::string_view hit_layout =
    "HIT string DOM time[ns] wavelength[nm] p_theta p_phi d_theta d_phi";
inline constexpr std::string_view charge_layout = "string DOM time[ns] charge[pe]";

// The module that `field` (string) and the one after it (DOM, or DOM_PMT, of which the PMT is dropped) name.
// The line must have both fields. Throws InputError; whether the numbers are in range is not asked.
ModuleId parse_module(const TextLine& line, std::size_t field);

// The photon, of charge 1, of a line "HIT ..." [ns, nm, rad]. Throws InputError: malformed, or a hit that no
// event may hold (data/event_rules.h).
Hit parse_hit_line(const TextLine& line);

// The pulse of a line of a charge list [ns, photoelectrons]. Throws InputError as above.
Hit parse_charge_line(const TextLine& line);

}  // namespace floe
