#include "reco/diagnose/additions.h"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "data/base/error.h"

namespace floe {

void Additions::add(NamedEffect winner, const IceFit& fit) {
  accepted_.add(std::move(winner), fit);
  ++count_;
  record_.steps.back().added = accepted_.effects().size() - 1;
  give_up_faded();
}

void Additions::give_up_faded() {
  while (const std::optional<AcceptedEffects::Faded> faded = accepted_.faded()) {
    const std::vector<NamedEffect>& effects = accepted_.effects();
    record_.remarks.push_back(fmt::format("{} was given up when {} came in: {:.1f} standard deviations",
                                          text_of(effects[faded->effect].suspect),
                                          text_of(effects.back().suspect), faded->sigmas));
    drop(faded->effect);
    refit();
  }
}

void Additions::refit() {
  while (!accepted_.empty()) try {
      accepted_.take(fits_.fit(accepted_.parameters()));
      return;
    } catch (const InputError&) {
      give_up(accepted_.effects().size() - 1, "no physical ice without what was given up before");
    }
}

void Additions::give_up(std::size_t effect, const std::string& why) {
  record_.remarks.push_back(
      fmt::format("{} was given up: {}", text_of(accepted_.effects()[effect].suspect), why));
  drop(effect);
  record_.looked_at_improved = false;
}

void Additions::give_up_all(const std::string& why) {
  while (!accepted_.empty()) give_up(0, why);
}

void Additions::drop(std::size_t effect) {
  accepted_.drop(effect);
  for (DiagnosisStep& step : record_.steps)
    if (step.added == effect)
      step.added.reset();
    else if (step.added && *step.added > effect)
      --*step.added;
}

}  // namespace floe
