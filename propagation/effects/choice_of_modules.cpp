#include "propagation/effects/choice_of_modules.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "data/base/error.h"

namespace floe {

namespace {

bool is_meant(const Module& module, double string, double dom) {
  return module.id.string == string && (dom == 0 || module.id.dom == dom);
}

}  // namespace

EffectParameter string_parameter() {
  return {"string", "", "number of the string; 0: none", 0, 0, 100000, true};
}

void expect_modules(const Detector& detector, double string, double dom, std::string_view effect) {
  const auto& modules = detector.modules();
  const auto meant = [&](const Module& module) { return is_meant(module, string, dom); };
  if (std::any_of(modules.begin(), modules.end(), meant)) return;
  throw UsageError(fmt::format("{}: found string {}{}; expected one of the {} strings of detector {}{}",
                               effect, string, dom == 0 ? "" : fmt::format(", dom {}", dom),
                               detector.strings().size(), detector.name(),
                               dom == 0 ? "" : ", and one of its modules"));
}

Detector with_modules(const Detector& detector, double string, double dom,
                      const std::function<void(Module&)>& change) {
  std::vector<Module> modules = detector.modules();
  for (Module& module : modules)
    if (is_meant(module, string, dom)) change(module);
  return {detector.name(), std::move(modules), detector.strings()};
}

}  // namespace floe
