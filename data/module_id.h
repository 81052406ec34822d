// The name of an optical module.
#pragma once

#include <compare>

namespace floe {

// An optical module's place: string 1-86 (more in other detectors), DOM 1-60 from the top.
struct ModuleId {
  int string = 0;
  int dom = 0;
  auto operator<=>(const ModuleId&) const = default;
};

}  // namespace floe
