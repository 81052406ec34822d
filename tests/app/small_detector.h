// A detector so small that fits in it take less than a second, for tests of what happens around fits.
#pragma once

#include <filesystem>

namespace floe::test {

// A geo-f2k file: string 1 at x = y = 0 and strings 2 to 7 `spacing` [m] around it, each with modules 1 to 9
// from z = -220 m to -380 m.
void write_small_detector(const std::filesystem::path& file, double spacing);

}  // namespace floe::test
