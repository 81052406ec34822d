// What reader and writer of diffusion patterns have to agree on; docs/formats.md explains every field.
#pragma once

#include <cstddef>
#include <cstdint>

namespace floe {

inline constexpr const char* pattern_format = "floe-crystal";
inline constexpr std::uint64_t pattern_format_version = 2;
inline constexpr std::size_t photon_columns = 6;  // direction x, y, n, position x, y, n

}  // namespace floe
