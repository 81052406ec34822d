#include "reco/diagnose/contest.h"

#include <algorithm>
#include <cmath>

#include "data/base/error.h"

namespace floe {

namespace {

constexpr double close = 2;          // differences of -ln L, in units of their noise
constexpr double behind = 1;         // likewise: is believed if its own fit, too, found little
constexpr double little = 0.7;       // of the other's chi-square
constexpr double undecided = 6;      // differences of chi-square, less one for each parameter
constexpr double beyond_doubt = 25;  // differences of chi-square: not worth more rounds
constexpr double held = 1e-3;  // width of a prior, in the parameter's scale, that leaves a band where it is

double parameters_in(const Trial& trial) {
  return static_cast<double>(trial.parameters.size());
}

double cost(const Candidate& candidate) {
  return candidate.trial.neg_llh + 0.5 * parameters_in(candidate.trial);
}

// What is false gains less than what is true, and its fit, which follows the light's slopes, needs it less.
bool is_outdone(const Candidate& candidate, const Candidate& best, double noise) {
  return cost(candidate) > cost(best) + behind * noise &&
         candidate.trial.chi_square < little * best.trial.chi_square;
}

// From half way to where it ended alone: from that end itself it would be favoured, and two halves of what is
// alike explain the data nearly as well as either.
std::vector<IceParameter> parameters_of(const Candidate& candidate, const Model& base) {
  std::vector<IceParameter> parameters = candidate.trial.parameters;
  const std::size_t first = candidate.fit.numbers.size() - parameters.size();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    IceParameter& p = parameters[i];
    const double alone = candidate.fit.numbers[first + i];
    const bool is_place = is_place_of_band(p);
    p.start = is_place ? alone : (null_number(p, base) + alone) / 2;
    if (is_place) p.prior = held * p.scale, p.prior_centre = alone;
  }
  return parameters;
}

// What each adds to the other, leader first.
std::pair<double, double> duel(const Candidate& leader, const Candidate& challenger, const Model& base,
                               const FitBeside& fit) {
  std::vector<IceParameter> both = parameters_of(leader, base);
  const std::size_t own = both.size();
  for (IceParameter& p : parameters_of(challenger, base)) both.push_back(std::move(p));
  const auto added = [&](const IceFit& joint) -> std::pair<double, double> {
    const std::size_t first = joint.numbers.size() - both.size();
    return {chi_square_of(leader.trial.parameters, joint, first, base),
            chi_square_of(challenger.trial.parameters, joint, first + own, base)};
  };
  return added(fit(both, [&](const IceFit& joint) {
    const auto [of_leader, of_challenger] = added(joint);
    return std::abs(of_leader - of_challenger) > beyond_doubt;
  }));
}

}  // namespace

double chi_square_of(const std::vector<IceParameter>& parameters, const IceFit& fit, std::size_t first,
                     const Model& base) {
  std::vector<double> nulls;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const IceParameter& p = parameters[i];
    nulls.push_back(is_place_of_band(p) ? fit.numbers[first + i] : null_number(p, base));
  }
  return fit.distance(first, nulls);
}

void hold_contest(const Model& base, double noise, const FitBeside& fit, std::vector<Candidate>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return cost(a) < cost(b); });
  const double limit = cost(candidates.front()) + close * noise;
  std::size_t best = 0;
  for (std::size_t i = 1; i < candidates.size() && cost(candidates[i]) < limit; ++i) try {
      if (is_outdone(candidates[i], candidates[best], noise)) continue;
      const auto [leader, challenger] = duel(candidates[best], candidates[i], base, fit);
      const double lead =
          leader - parameters_in(candidates[best].trial) - challenger + parameters_in(candidates[i].trial);
      const bool stays = lead > -undecided;
      const std::size_t loser = stays ? i : best;
      if (!stays) {
        // Those that the last best has beaten have not met the new one: narrow losers may be as good.
        for (std::size_t k = 0; k < i; ++k) {
          candidates[k].trial.untold = lost_narrowly(candidates[k].trial);
          candidates[k].trial.lost.reset();
        }
        best = i;
      }
      candidates[loser].trial.lost = stays ? Duel{leader, challenger, lead} : Duel{challenger, leader, -lead};
    } catch (const InputError&) {
      candidates[i].trial.untold = true;  // no physical ice on its way: the order of -ln L stays
    }
  std::rotate(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(best),
              candidates.begin() + static_cast<std::ptrdiff_t>(best) + 1);
}

bool lost_narrowly(const Trial& trial) {
  return trial.untold || (trial.lost && trial.lost->lead < undecided);
}

}  // namespace floe
