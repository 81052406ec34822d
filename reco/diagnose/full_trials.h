// Trials of the whole diagnosis: light with something hidden in it goes through everything that measured
// light goes through.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/base/progress.h"
#include "reco/diagnose/diagnosis.h"

namespace floe {

// What a trial hides; nothing when `effect` is empty.
struct HiddenEffect {
  std::string effect, text;
  std::vector<std::pair<std::string, double>> values;  // names of parameters
  double significance = 0;                             // expected
  Place place = {};
};

// What was named, and what cannot be told from it.
struct NamedInTrial {
  std::string effect, text;  // as in HiddenEffect; empty: nothing was named
  Place place;
  std::vector<std::string> group;  // itself first

  // Whether it is that effect, or its group, of at most three, has the effect: a name is worth nothing in a
  // larger one.
  bool is(const HiddenEffect& hidden) const;
  // The same effect, but of another string or module, or in a band apart.
  bool is_elsewhere(const HiddenEffect& hidden) const;
};

struct FullTrial {
  std::vector<HiddenEffect> hidden;  // one; two of a pair
  bool outside = false;              // of the catalogue
  std::vector<std::string> verdict;  // as in result.json
  std::vector<NamedInTrial> named;
  // Of hidden effects that were named at their place, where both speak of the same parameter.
  struct Value {
    std::string name;
    double hidden = 0, found = 0, error = 0;
  };
  std::vector<Value> values;
  std::optional<double> closed;      // share of the held-out gap; none where that was no larger than chance
  std::vector<std::string> remarks;  // why names were given up
  double seconds = 0;

  // The first name is right; of a pair the first two are, in any order; what is outside of the catalogue
  // stays unexplained.
  bool right() const;
  // Whether the first name of a hidden effect is of a wrong place.
  bool elsewhere() const;
  // Whether what is outside of the catalogue was left unexplained, but an effect was named as well.
  bool named_as_well() const { return outside && right() && !named.empty(); }
};

// Hidden values beside those that a diagnosis fitted to the same parameters; birefringence that was fitted
// layer by layer counts by its mean.
std::vector<FullTrial::Value> values_of(const HiddenEffect& hidden, const NamedEffect& named);

FullTrial full_trial(const Model& base, const std::vector<HiddenEffect>& hidden, bool outside,
                     const FlasherData& data, const DiagnosisOptions& options, const Progress& progress = {});

}  // namespace floe
