#include "reco/diagnose/unexplained.h"

#include <fmt/format.h>

#include <map>

#include "reco/diagnose/diagnosis.h"

namespace floe {
namespace {

// Strings or modules do not go wrong by threes: what they have in common is more likely one thing, which
// the catalogue does not have.
void tell_of_too_many_alike(const Diagnosis& diagnosis, std::vector<std::string>& why) {
  constexpr int too_many = 3;
  std::map<std::string, int> places;
  for (const NamedEffect& effect : diagnosis.effects) ++places[effect.suspect.effect];
  for (const auto& [name, count] : places)
    if (count >= too_many)
      why.push_back(fmt::format(
          "{} at {} places at once is more likely one thing that the catalogue does not have", name, count));
}

}  // namespace

std::vector<std::string> why_unexplained(const Diagnosis& diagnosis, bool something_remains) {
  constexpr double most = 0.5;  // of a gap
  std::vector<std::string> why;
  if (something_remains) why.push_back("something remains that no effect of the catalogue explains");
  if (diagnosis.has_clear_gap() && diagnosis.is_clear(diagnosis.gap_after) && diagnosis.closed() < most)
    why.push_back(diagnosis.folds > 1 ? "runs that were held out do not confirm it"
                                      : "most of the gap stays");
  tell_of_too_many_alike(diagnosis, why);
  return why;
}

}  // namespace floe
