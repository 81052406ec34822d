// Several suspects may explain the data: which of them is missing? Fits decide.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "propagation/model.h"
#include "reco/diagnose/suspects.h"
#include "reco/ice_fit/ice_fit.h"

namespace floe {

// What two effects add to each other in a joint fit: chi-squares about the model without the one of them.
struct Duel {
  double winner = 0, loser = 0;
  // By what the winner leads, a unit taken off for each parameter. Below 0 where the loser adds more, but not
  // by so much that it would overrule the likelihood.
  double lead = 0;
};

// A fit of one suspect, beside all that is in the model already.
struct Trial {
  Suspect suspect;
  std::vector<IceParameter> parameters;  // of the suspect alone
  std::vector<double> values, errors;    // of the parameters, where its fit ended
  double neg_llh = 0;                    // of all runs, with the same random numbers as its rivals'
  double chi_square = 0;                 // of its parameters about the model without it
  std::optional<Duel> lost;              // to a rival that fits nearly as well
  bool untold = false;  // fits nearly as well as a rival, and the two could not be fitted together
};

// A trial with its fit, of which the suspect's parameters are the last.
struct Candidate {
  Trial trial;
  IceFit fit;
  double left = 0;  // of -ln L, above that of a true model: at most, by three standard deviations
};

// Fits these beside all that is in the model already, which come first in the result, until the fit has
// converged or is `settled` (IceFitOptions).
using FitBeside = std::function<IceFit(const std::vector<IceParameter>& more,
                                       const std::function<bool(const IceFit&)>& settled)>;

// Chi-square of these parameters of a fit, which begin at `first`, about the model without their effect. The
// place of a band is no change of the model.
double chi_square_of(const std::vector<IceParameter>& parameters, const IceFit& fit, std::size_t first,
                     const Model& base);

// Puts the best first. -ln L decides, with half a unit for each parameter, where the differences are larger
// than twice the `noise` of simulations, or than this noise and the chi-square of the one that is behind is
// less than 70% of the other's; candidates that are closer are fitted together, two at a time, and the one
// that adds more to the other wins. Where they add nearly as much, the order of -ln L stays. A duel ends
// early when the difference is beyond doubt.
void hold_contest(const Model& base, double noise, const FitBeside& fit, std::vector<Candidate>& candidates);

// Whether the duel that it lost was too close to tell it from the winner, or there could be none.
bool lost_narrowly(const Trial& trial);

}  // namespace floe
