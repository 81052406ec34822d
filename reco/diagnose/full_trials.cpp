#include "reco/diagnose/full_trials.h"

#include <algorithm>

namespace floe {

std::vector<FullTrial::Value> values_of(const HiddenEffect& hidden, const NamedEffect& named) {
  std::vector<FullTrial::Value> values;
  for (const auto& [name, value] : hidden.values) {
    if (named.mean && named.suspect.effect + "." + named.mean->name == name) {
      values.push_back({name, value, named.mean->value, named.mean->error});
      continue;
    }
    for (std::size_t i = 0; i < named.parameters.size(); ++i)
      if (named.parameters[i].name == name) values.push_back({name, value, named.values[i], named.errors[i]});
  }
  return values;
}

bool NamedInTrial::is(const HiddenEffect& hidden) const {
  constexpr std::size_t largest_group = 3;
  return effect == hidden.effect || (group.size() <= largest_group &&
                                     std::find(group.begin(), group.end(), hidden.effect) != group.end());
}

bool NamedInTrial::is_elsewhere(const HiddenEffect& hidden) const {
  return effect == hidden.effect && !is_same_place(place, hidden.place);
}

bool FullTrial::right() const {
  if (outside) return !verdict.empty() && verdict.back() == "unexplained";
  if (hidden.size() == 1 && hidden.front().effect.empty()) return verdict.empty();
  if (named.size() < hidden.size()) return false;
  if (hidden.size() == 1) return named[0].is(hidden[0]);
  return (named[0].is(hidden[0]) && named[1].is(hidden[1])) ||
         (named[0].is(hidden[1]) && named[1].is(hidden[0]));
}

bool FullTrial::elsewhere() const {
  return std::any_of(hidden.begin(), hidden.end(), [&](const HiddenEffect& effect) {
    const auto first = std::find_if(named.begin(), named.end(),
                                    [&](const NamedInTrial& name) { return name.effect == effect.effect; });
    return first != named.end() && first->is_elsewhere(effect);
  });
}

FullTrial full_trial(const Model& base, const std::vector<HiddenEffect>& hidden, bool outside,
                     const FlasherData& data, const DiagnosisOptions& options, const Progress& progress) {
  const Diagnosis found = diagnose(base, data, options, progress);
  FullTrial trial;
  trial.hidden = hidden;
  trial.outside = outside;
  trial.verdict = found.verdict;
  if (found.has_clear_gap()) trial.closed = found.closed();
  trial.remarks = found.remarks;
  trial.seconds = found.seconds;
  for (const NamedEffect& named : found.effects) {
    const Suspect& suspect = named.suspect;
    trial.named.push_back({suspect.effect, text_of(suspect), suspect.place, named.group});
    for (const HiddenEffect& effect : hidden) {
      if (suspect.effect != effect.effect || !is_same_place(suspect.place, effect.place)) continue;
      const std::vector<FullTrial::Value> values = values_of(effect, named);
      trial.values.insert(trial.values.end(), values.begin(), values.end());
    }
  }
  return trial;
}

}  // namespace floe
