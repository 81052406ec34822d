// The texts that other tools write (docs/formats.md); a file is one event.
#pragma once

#include <filesystem>

#include "data/event.h"

namespace floe {

// "HIT string DOM time wavelength p_theta p_phi d_theta d_phi" [ns, nm, rad]; DOM may be DOM_PMT, the
// PMT is dropped. TR lines become the truth, other lines of f2k are passed over. Throws InputError.
Event read_hit_text(const std::filesystem::path& path);

// "string DOM time charge" [ns, photoelectrons]. Throws InputError.
Event read_charge_list(const std::filesystem::path& path);

}  // namespace floe
