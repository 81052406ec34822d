#include "reco/ice_fit/layers_apart.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "data/base/error.h"

namespace floe {

namespace {

// One group of depth: which parameters, which runs.
struct Group {
  std::vector<IceParameter> parameters;
  FlasherData data;
};

// A module would have an efficiency of its own in every layer.
void expect_known_efficiencies(const IceFitOptions& options) {
  if (options.efficiency_width > 0)
    throw UsageError("efficiencies of receivers are fitted to all layers at once, not layer by layer");
}

std::map<double, Group> groups_of(const std::vector<IceParameter>& parameters) {
  std::map<double, Group> groups;
  for (const IceParameter& parameter : parameters) {
    if (parameter.family.empty())
      throw UsageError(
          fmt::format("{} belongs to no layer: it cannot be fitted layer by layer", parameter.name));
    groups[parameter.depth].parameters.push_back(parameter);
  }
  return groups;
}

// The group whose middle is nearest to the flasher.
Group& group_of(const RunData& run, const Detector& detector, std::map<double, Group>& groups) {
  const double depth = flasher_depth(run, detector);
  auto nearest = groups.begin();
  for (auto group = groups.begin(); group != groups.end(); ++group)
    if (std::abs(group->first - depth) < std::abs(nearest->first - depth)) nearest = group;
  return nearest->second;
}

// Appends a fit of other parameters to other runs.
void append(const IceFit& part, IceFit& whole) {
  const Eigen::Index was = whole.covariance.rows(), more = part.covariance.rows();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(was + more, was + more);
  covariance.topLeftCorner(was, was) = whole.covariance;
  covariance.bottomRightCorner(more, more) = part.covariance;
  whole.covariance = covariance;
  const auto extend = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  extend(whole.parameters, part.parameters);
  extend(whole.numbers, part.numbers);
  extend(whole.light_errors, part.light_errors);
  extend(whole.runs, part.runs);
  extend(whole.left_out, part.left_out);
  whole.neg_llh += part.neg_llh;
  whole.bins += part.bins;
  whole.rounds = std::max(whole.rounds, part.rounds);
  whole.converged = whole.converged && part.converged;
  whole.seconds += part.seconds;
  whole.photons += part.photons;
}

// Families one after the other, each from the top down, as fits of all layers at once have them.
void sort_by_family(IceFit& fit) {
  std::vector<Eigen::Index> order(fit.parameters.size());
  std::iota(order.begin(), order.end(), 0);
  const auto& parameters = fit.parameters;
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return parameters[static_cast<std::size_t>(a)].family < parameters[static_cast<std::size_t>(b)].family;
  });
  IceFit sorted = fit;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto from = static_cast<std::size_t>(order[i]);
    sorted.parameters[i] = fit.parameters[from];
    sorted.numbers[i] = fit.numbers[from];
    sorted.light_errors[i] = fit.light_errors[from];
  }
  sorted.covariance = fit.covariance(order, order);
  fit = std::move(sorted);
}

}  // namespace

IceFit fit_layers_apart(const Model& base, const FlasherData& data,
                        const std::vector<IceParameter>& parameters, const IceFitOptions& options,
                        const Progress& progress) {
  expect_known_efficiencies(options);
  std::map<double, Group> groups = groups_of(parameters);
  if (groups.empty()) throw UsageError("there is no layer to fit");
  for (const RunData& run : data.runs) group_of(run, *base.detector, groups).data.runs.push_back(run);
  std::erase_if(groups, [](const auto& group) { return group.second.data.runs.empty(); });
  if (groups.empty()) throw NoResult("no layer has a flasher in it");
  IceFit whole;
  whole.converged = true;
  whole.left_out = data.left_out;
  double done = 0;
  for (const auto& [depth, group] : groups) {
    const double share = 1 / static_cast<double>(groups.size());
    append(fit_ice(base, group.data, group.parameters, options,
                   [&, depth = depth](double fraction, const std::string& stage) {
                     if (progress)
                       progress(done + share * fraction, fmt::format("{:.0f} m: {}", depth, stage));
                   }),
           whole);
    done += share;
  }
  sort_by_family(whole);
  return whole;
}

}  // namespace floe
