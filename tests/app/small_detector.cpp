#include "tests/app/small_detector.h"

#include <fmt/format.h>

#include <cmath>

#include "data/base/constants.h"
#include "data/base/vec3.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {

void write_small_detector(const std::filesystem::path& file, double spacing) {
  std::string geometry;
  for (int string = 1; string <= 7; ++string)
    for (int dom = 1; dom <= 9; ++dom) {
      const double radius = string == 1 ? 0 : spacing, angle = string * pi / 3;
      geometry += fmt::format("module-{0}-{1} {2:012x} {3:.2f} {4:.2f} {5:.2f} {0} {1}\n", string, dom,
                              100 * string + dom, radius * std::cos(angle), radius * std::sin(angle),
                              -200 - 20 * dom - origin_depth);
    }
  write_bytes(file, geometry);
}

}  // namespace floe::test
