#include "reco/diagnose/seen_above.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace floe {

std::vector<SeenAbove> seen_above(const ScoreTester& tester, const Model& base, double alpha, double floor) {
  std::map<std::string, std::vector<double>> changes;
  std::map<std::string, std::vector<IceParameter>> of_effect;  // alike at all places
  std::vector<SeenAbove> all;
  for (const TestedSuspect& tested : tester.suspects()) {
    const Suspect& suspect = *tested.suspect;
    const double gain = tester.gain_to_be_named(tested, alpha);
    const auto [known, is_new] = of_effect.try_emplace(suspect.effect);
    if (is_new) known->second = changing_parameters(suspect, base);
    const std::vector<IceParameter>& parameters = known->second;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const auto index = static_cast<Eigen::Index>(i);
      const Eigen::VectorXd one = Eigen::VectorXd::Unit(tested.low.size(), index);
      const double of_one = tested.expected_gain(one), size_of_one = tested.size(one);
      if (!(of_one > 0 && size_of_one > 0)) continue;
      std::vector<double>& of_parameter = changes[parameters[i].name];
      if (of_parameter.empty()) all.push_back({suspect.effect, parameters[i].name, parameters[i].unit, 0});
      of_parameter.push_back(std::max(std::sqrt(gain / of_one), floor / size_of_one));
    }
  }
  for (SeenAbove& seen : all) {
    std::vector<double>& values = changes.at(seen.parameter);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    seen.change = *middle;
    // Amplitudes of bands are logarithms of their factors.
    if (seen.effect.ends_with("-layer")) seen.change = std::expm1(seen.change);
  }
  return all;
}

}  // namespace floe
