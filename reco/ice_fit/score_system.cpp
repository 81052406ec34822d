#include "reco/ice_fit/score_system.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "reco/ice_fit/smooth_slopes.h"

namespace floe {

namespace {

// 1 where a bin is of a receiver whose efficiency is fitted.
Eigen::MatrixXd efficiency_slopes(Eigen::Index bins, const RunColumns& columns) {
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(bins, static_cast<Eigen::Index>(columns.efficiency.size()));
  for (std::size_t bin = 0; bin < columns.receiver_of_bin.size(); ++bin)
    slopes(static_cast<Eigen::Index>(bin), columns.receiver_of_bin[bin]) = 1;
  return slopes;
}

// Adds the run's own columns, brightness, time zero and efficiencies, to the slopes of ln(mu) per bin.
Eigen::MatrixXd with_nuisances(const Eigen::MatrixXd& ice, const LightFold& fold, const RunColumns& columns) {
  const Eigen::MatrixXd efficiencies = efficiency_slopes(ice.rows(), columns);
  Eigen::MatrixXd slopes(ice.rows(), ice.cols() + 2 + efficiencies.cols());
  slopes << ice, Eigen::VectorXd::Ones(ice.rows()),
      (fold.delay.array() / fold.counts.array().max(1)).matrix(), efficiencies;
  return slopes;
}

Eigen::MatrixXd own_slopes(const LightFold& fold, const RunColumns& columns) {
  return with_nuisances(fold.slopes.array().colwise() / fold.counts.array().max(1), fold, columns);
}

// Weights in these columns, by a symmetric matrix. Rows of the slope are weights, its columns are not.
void shrink(const std::vector<Eigen::Index>& columns, const Eigen::MatrixXd& shares, ScoreSystem& system) {
  system.gap(columns) = (shares * system.gap(columns)).eval();
  for (Eigen::MatrixXd* matrix :
       {&system.slope, &system.information, &system.noise, &system.simulation_noise})
    (*matrix)(columns, Eigen::all) = (shares * (*matrix)(columns, Eigen::all)).eval();
  for (Eigen::MatrixXd* matrix : {&system.information, &system.noise, &system.simulation_noise})
    (*matrix)(Eigen::all, columns) = ((*matrix)(Eigen::all, columns) * shares).eval();
}

}  // namespace

ScoreSystem& ScoreSystem::operator+=(const ScoreSystem& other) {
  gap += other.gap;
  slope += other.slope;
  information += other.information;
  noise += other.noise;
  simulation_noise += other.simulation_noise;
  return *this;
}

void add_run(const RunLight& light, const RunLight& seen, const RunCounts& counts, const RunColumns& columns,
             ScoreSystem& system) {
  const LightFold* folds = light.folds;
  const Eigen::Index parameters = folds[0].slopes.cols();
  const SmoothSlopes smooth = smooth_slopes(seen.folds, seen.places, seen.symmetric);
  const Eigen::MatrixXd slopes[2] = {own_slopes(folds[0], columns), own_slopes(folds[1], columns)};
  const Eigen::MatrixXd weight[2] = {with_nuisances(smooth.fold[0], seen.folds[0], columns),
                                     with_nuisances(smooth.fold[1], seen.folds[1], columns)};
  const Eigen::ArrayXd expected[2] = {counts.scale * folds[0].counts.array(),
                                      counts.scale * folds[1].counts.array()};
  const Eigen::ArrayXd mu = (expected[0] + expected[1]) / 2;
  const Eigen::ArrayXd simulated = (folds[0].counts + folds[1].counts).array().max(1);
  // Bins that the simulation does not know as well as the data count less.
  const double known = counts.model_error * counts.model_error;
  const Eigen::ArrayXd trust = 1 / (1 + mu * (1 / simulated + known));

  const Eigen::Index size = weight[0].cols();
  Eigen::VectorXd gap = Eigen::VectorXd::Zero(size);
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(size, size), information = slope, noise = slope;
  const auto add_noise = [&](const Eigen::MatrixXd& w, const Eigen::ArrayXd& variance) {
    noise += w.transpose() * (variance * trust.square()).matrix().asDiagonal() * w;
  };
  for (int fold = 0; fold < 2; ++fold) {
    const int other = 1 - fold;
    gap += weight[fold].transpose() * (trust * (counts.data.array() - expected[other])).matrix() / 2;
    const auto light_of_bins = (trust * expected[other]).matrix().asDiagonal();
    slope += weight[fold].transpose() * light_of_bins * slopes[other] / 2;
    information += weight[fold].transpose() * light_of_bins * weight[fold] / 2;
    add_noise(weight[fold] / 2, counts.dispersion * counts.scale * expected[other]);
  }
  const Eigen::MatrixXd simulation_noise = noise;
  add_noise((weight[0] + weight[1]) / 2, counts.data_dispersion * mu + known * mu.square());

  // Into the system: the ice's columns, then the run's own.
  const auto place = [&](Eigen::Index i) -> Eigen::Index {
    if (i < parameters) return i;
    if (i < parameters + 2) return columns.nuisance + (i - parameters);
    return columns.efficiency[static_cast<std::size_t>(i - parameters - 2)];
  };
  for (Eigen::Index i = 0; i < size; ++i) {
    system.gap(place(i)) += gap(i);
    for (Eigen::Index k = 0; k < size; ++k) {
      system.slope(place(i), place(k)) += slope(i, k);
      system.information(place(i), place(k)) += (information(i, k) + information(k, i)) / 2;
      system.noise(place(i), place(k)) += noise(i, k);
      system.simulation_noise(place(i), place(k)) += simulation_noise(i, k);
    }
  }
}

void shrink_combinations(const std::vector<std::string>& places, ScoreSystem& system) {
  std::map<std::string, std::vector<Eigen::Index>> columns_at;
  for (std::size_t p = 0; p < places.size(); ++p)
    if (!places[p].empty()) columns_at[places[p]].push_back(static_cast<Eigen::Index>(p));
  for (const auto& [place, columns] : columns_at) {
    if (columns.size() < 2) continue;
    const Eigen::MatrixXd slope = system.slope(columns, columns);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(system.information(columns, columns));
    const Eigen::MatrixXd& directions = parts.eigenvectors();
    const Eigen::ArrayXd confirmed = (directions.transpose() * slope * directions).diagonal(),
                         claimed = parts.eigenvalues();
    const Eigen::ArrayXd share = (claimed > 0).select((confirmed / claimed).max(0).min(1), 0);
    shrink(columns, directions * share.matrix().asDiagonal() * directions.transpose(), system);
  }
}

void calibrate_information(const std::vector<std::string>& groups, ScoreSystem& system) {
  constexpr double least = 0.3, most = 1.5;  // weights this far off would be of no use
  struct Sums {
    double slope = 0, information = 0;
  };
  std::map<std::string, Sums> sums;
  for (std::size_t p = 0; p < groups.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    sums[groups[p]].slope += system.slope(i, i);
    sums[groups[p]].information += system.information(i, i);
  }
  Eigen::VectorXd factor = Eigen::VectorXd::Ones(system.gap.size());
  for (std::size_t p = 0; p < groups.size(); ++p) {
    const Sums& sum = sums[groups[p]];
    if (sum.information > 0)
      factor(static_cast<Eigen::Index>(p)) = std::sqrt(std::clamp(sum.slope / sum.information, least, most));
  }
  system.information = factor.asDiagonal() * system.information * factor.asDiagonal();
}

}  // namespace floe
