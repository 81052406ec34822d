// The effects that a diagnosis has added to its base model, all of them fitted together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "propagation/effects_file.h"
#include "propagation/model.h"
#include "reco/diagnose/separation.h"
#include "reco/diagnose/suspects.h"
#include "reco/ice_fit/ice_fit.h"

namespace floe {

struct NamedEffect {
  Suspect suspect;
  std::vector<IceParameter> parameters;
  std::vector<double> values, errors;
  // The mean over layers, where the effect was refined layer by layer; by the effect's own parameter's name.
  struct Mean {
    std::string name;
    double value = 0, error = 0;
  };
  std::optional<Mean> mean;
  double significance = 0;                   // standard deviations
  std::vector<std::string> group;            // effects that the data cannot tell from it, itself first
  std::vector<Separation> separations = {};  // what would tell it from each of the others
};

class AcceptedEffects {
 public:
  // Keeps a reference.
  explicit AcceptedEffects(const Model& base) : base_(base) {}

  const std::vector<NamedEffect>& effects() const { return effects_; }
  bool empty() const { return effects_.empty(); }
  Model model() const { return with_parameters(base_, parameters_, numbers_); }
  // Whether this suspect is there already: strings and modules may be wrong one by one, of all others a model
  // holds one.
  bool has(const Suspect& suspect) const;

  // What a fit is given: the parameters of all effects, which begin where they are, and `more`.
  std::vector<IceParameter> parameters(const std::vector<IceParameter>& more = {}) const;
  std::size_t parameter_count() const { return parameters_.size(); }
  // `fit`: of parameters(effect.parameters).
  void add(NamedEffect effect, const IceFit& fit);
  // Of parameters(): values, errors, significances and the places of bands follow it.
  void take(const IceFit& fit);

  // The same with an effect of one parameter layer by layer instead.
  std::vector<IceParameter> parameters_by_layers(std::size_t effect, LayerFamily family,
                                                 const DepthRange& range) const;
  // Chi-square of the effect's layers about what is best for all of them. `fit`: of those parameters.
  double spread_of_layers(std::size_t effect, const IceFit& fit) const;
  void take_layers(std::size_t effect, const IceFit& fit);

  // An effect that is hardly there any more now that the last one is: that one may have explained it away.
  struct Faded {
    std::size_t effect;
    double sigmas;  // of all its parameters together
  };
  std::optional<Faded> faded() const;
  void drop(std::size_t effect);

  // Those that no file of an ice directory can hold but floe.toml.
  EffectGroups beside_ice() const;

 private:
  std::size_t first_parameter(std::size_t effect) const;
  std::size_t layer_count(const IceFit& fit) const;
  static NamedEffect::Mean mean_of(const NamedEffect& effect, const IceFit& fit, std::size_t first);

  const Model& base_;
  std::vector<NamedEffect> effects_;
  // Of all effects, one after another.
  std::vector<IceParameter> parameters_;
  std::vector<double> numbers_;
};

}  // namespace floe
