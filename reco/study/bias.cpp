#include "reco/study/bias.h"

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <vector>

#include "reco/study/summary.h"
#include "reco/validation/two_sample_tests.h"

namespace floe {
namespace {

double error_of_mean(const std::vector<double>& values) {
  return standard_deviation(values) / std::sqrt(double(values.size()));
}

// `difference` of as many parameters as it has, from `first` on.
void add(StudyChiSquare& sum, const StudyResiduals& residuals, int first, int count) {
  const Eigen::VectorXd difference = residuals.difference.segment(first, count);
  const Eigen::MatrixXd covariance = residuals.covariance.block(first, first, count, count);
  sum.value += difference.dot(covariance.ldlt().solve(difference));
  sum.degrees += static_cast<std::size_t>(count);
}

ModelBias bias_of(const std::vector<const StudyRow*>& rows, const StudyFit& (*fit_of)(const StudyRow&)) {
  ModelBias bias;
  std::vector<double> angles, energies;
  for (const StudyRow* row : rows) {
    const StudyFit& fit = fit_of(*row);
    angles.push_back(angle_between(fit.cascade, row->truth));
    energies.push_back(std::log(fit.cascade.energy / row->truth.energy));
    const StudyResiduals residuals = residuals_of(*row, fit);
    add(bias.direction, residuals, 4, 2);
    add(bias.energy, residuals, 6, 1);
    add(bias.all, residuals, 0, 7);
  }
  bias.median_angle = median(angles);
  bias.mean_log_energy = mean_of(energies), bias.mean_log_energy_error = error_of_mean(energies);
  return bias;
}

std::string words_of(const StudyChiSquare& sum) {
  return fmt::format("{:.1f} (p = {:.2g})", sum.value, sum.probability());
}

}  // namespace

double StudyChiSquare::probability() const {
  return chi_square_probability(value, double(degrees));
}

StudyBias summarise_bias(std::span<const StudyRow> all_rows) {
  StudyBias bias;
  std::vector<const StudyRow*> rows;
  for (const StudyRow& row : all_rows)
    if (row.other && is_fitted(row.fit) && is_fitted(*row.other)) rows.push_back(&row);
  bias.events = rows.size();
  if (rows.empty()) return bias;
  bias.other = bias_of(rows, [](const StudyRow& row) -> const StudyFit& { return *row.other; });
  bias.truth = bias_of(rows, [](const StudyRow& row) -> const StudyFit& { return row.fit; });
  std::vector<double> deltas, significances;
  double variance = 0;
  for (const StudyRow* row : rows) {
    deltas.push_back(row->delta_neg_llh);
    significances.push_back(row->delta_neg_llh / row->delta_neg_llh_error);
    bias.sum_delta += row->delta_neg_llh;
    variance += row->delta_neg_llh_error * row->delta_neg_llh_error;
  }
  bias.sum_delta_error = std::sqrt(variance);
  bias.mean_delta = mean_of(deltas), bias.mean_delta_error = error_of_mean(deltas);
  bias.least_significance = *std::min_element(significances.begin(), significances.end());
  bias.median_significance = median(significances);
  return bias;
}

std::string text_of(const StudyBias& bias) {
  if (bias.events == 0) return "Fitted with the other model: no event\n";
  const auto line = [](const std::string& what, const std::string& other, const std::string& truth) {
    return fmt::format("  {:<32}  {:>22}  {:>22}\n", what, other, truth);
  };
  const auto energy = [](const ModelBias& model) {
    return fmt::format("{:+.4f} +- {:.4f}", model.mean_log_energy, model.mean_log_energy_error);
  };
  std::string text = fmt::format("Fitted with the other model: {} events\n", bias.events);
  text += line("", "other model", "true model");
  text += line("angle from the truth, median deg", fmt::format("{:.2f}", bias.other.median_angle / degree),
               fmt::format("{:.2f}", bias.truth.median_angle / degree));
  text += line("energy, mean of ln(fit/truth)", energy(bias.other), energy(bias.truth));
  const auto chi_square = [&](const std::string& what, StudyChiSquare ModelBias::*sum) {
    const StudyChiSquare &other = bias.other.*sum, &truth = bias.truth.*sum;
    text += line(fmt::format("{}, chi-square of {}", what, other.degrees), words_of(other), words_of(truth));
  };
  chi_square("direction", &ModelBias::direction);
  chi_square("energy", &ModelBias::energy);
  chi_square("all parameters", &ModelBias::all);
  text += fmt::format(
      "  -ln L larger by {:.1f} +- {:.1f} with the other model (error of the simulations); "
      "by {:.1f} +- {:.1f} an event\n",
      bias.sum_delta, bias.sum_delta_error, bias.mean_delta, bias.mean_delta_error);
  return text;
}

}  // namespace floe
