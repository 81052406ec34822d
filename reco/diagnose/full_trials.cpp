#include "reco/diagnose/full_trials.h"

#include <algorithm>

namespace floe {

namespace {

void add_values(const HiddenEffect& hidden, const NamedEffect& named, std::vector<FullTrial::Value>& values) {
  for (const auto& [name, value] : hidden.values) {
    if (named.mean && named.mean->name == name) {
      values.push_back({name, value, named.mean->value, named.mean->error});
      continue;
    }
    for (std::size_t i = 0; i < named.parameters.size(); ++i)
      if (named.parameters[i].name == name) values.push_back({name, value, named.values[i], named.errors[i]});
  }
}

}  // namespace

bool names(const std::string& named, const std::vector<std::string>& group, const std::string& effect) {
  constexpr std::size_t largest_group = 3;
  return named == effect ||
         (group.size() <= largest_group && std::find(group.begin(), group.end(), effect) != group.end());
}

bool FullTrial::names(const HiddenEffect& effect, std::size_t place) const {
  // The last of the verdict may be "unexplained", which has no group.
  const std::vector<std::string> none;
  return place < verdict.size() &&
         floe::names(verdict[place], place < groups.size() ? groups[place] : none, effect.effect);
}

bool FullTrial::right() const {
  if (outside) return !verdict.empty() && verdict.back() == "unexplained";
  if (hidden.size() == 1) return hidden.front().effect.empty() ? verdict.empty() : names(hidden.front(), 0);
  return (names(hidden[0], 0) && names(hidden[1], 1)) || (names(hidden[0], 1) && names(hidden[1], 0));
}

FullTrial full_trial(const Model& base, const std::vector<HiddenEffect>& hidden, bool outside,
                     const FlasherData& data, const DiagnosisOptions& options, const Progress& progress) {
  const Diagnosis found = diagnose(base, data, options, progress);
  FullTrial trial;
  trial.hidden = hidden;
  trial.outside = outside;
  trial.verdict = found.verdict;
  trial.closed = found.closed();
  trial.seconds = found.seconds;
  for (const NamedEffect& named : found.effects) {
    trial.groups.push_back(named.group);
    for (const HiddenEffect& effect : hidden)
      if (named.suspect.effect == effect.effect) add_values(effect, named, trial.values);
  }
  return trial;
}

}  // namespace floe
