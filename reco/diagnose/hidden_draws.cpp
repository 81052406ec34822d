#include "reco/diagnose/hidden_draws.h"

#include <cmath>

#include "data/base/error.h"

namespace floe {

namespace {

// Parameters may be cut off at what makes sense.
bool reaches(const TestedSuspect& place, const std::vector<IceParameter>& parameters,
             const Eigen::VectorXd& amplitudes, const Model& base) {
  if (place.suspect->place.count("depth")) return std::abs(amplitudes(0)) < std::log(2.5);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double is = parameters[i].start - null_number(parameters[i], base),
                 wanted = amplitudes(static_cast<Eigen::Index>(i));
    if (std::abs(is - wanted) > 0.05 * std::abs(wanted)) return false;
  }
  return true;
}

// Throws InputError where that is no physical ice.
std::optional<Hidden> hidden_at(const TestedSuspect& place, const Eigen::VectorXd& amplitudes,
                                double significance, const Model& base) {
  if (((amplitudes - place.low).array() < 0).any() || ((place.high - amplitudes).array() < 0).any())
    return {};
  Hidden hidden;
  hidden.parameters = fit_parameters(*place.suspect, amplitudes, base);
  if (!reaches(place, hidden.parameters, amplitudes, base)) return {};
  hidden.effect = {place.suspect->effect, text_of(*place.suspect), {}, significance, place.suspect->place};
  for (const IceParameter& p : hidden.parameters) {
    hidden.numbers.push_back(p.start);
    hidden.effect.values.emplace_back(p.name, p.start);
  }
  hidden.model = with_parameters(base, hidden.parameters, hidden.numbers);
  return hidden;
}

}  // namespace

std::optional<Hidden> draw_hidden(const std::vector<const TestedSuspect*>& places, const ScoreTester& tester,
                                  const Model& base, SignificanceRange wanted, std::mt19937_64& random) {
  constexpr int tries = 40;
  for (int i = 0; i < tries; ++i) {
    const TestedSuspect& place =
        *places[std::uniform_int_distribution<std::size_t>(0, places.size() - 1)(random)];
    Eigen::VectorXd direction(place.low.size());
    for (double& value : direction) value = std::normal_distribution<double>()(random);
    const double significance = std::uniform_real_distribution<double>(wanted.least, wanted.most)(random);
    const double unit = place.expected_gain(direction);
    if (!(unit > 0)) continue;
    const double gain = tester.gain_of_significance(place, significance);
    try {
      if (auto hidden = hidden_at(place, direction * std::sqrt(gain / unit), significance, base))
        return hidden;
    } catch (const Error&) {
      // No physical ice: another draw.
    }
  }
  return {};
}

}  // namespace floe
