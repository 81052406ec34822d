#include "reco/diagnose/goodness.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "propagation/engine/threads.h"
#include "reco/validation/two_sample_tests.h"

namespace floe {

namespace {

constexpr std::uint64_t first_draw = std::uint64_t{1} << 33;  // beyond those of other tests

}  // namespace

double total_neg_llh(const Survey& survey, const SurveyCounts& counts) {
  const std::vector<double> of_runs = neg_llh_of(survey, counts);
  return std::accumulate(of_runs.begin(), of_runs.end(), 0.0);
}

ExpectedFit expected_fit(const Survey& survey, const Draws& draws) {
  std::vector<double> drawn(static_cast<std::size_t>(draws.count));
#pragma omp parallel for num_threads(thread_count(draws.threads))
  for (int d = 0; d < draws.count; ++d)
    drawn[static_cast<std::size_t>(d)] =
        total_neg_llh(survey, drawn_counts(survey, draws.seed, first_draw + static_cast<std::uint64_t>(d)));
  ExpectedFit fit;
  double squares = 0;
  for (const double value : drawn) fit.mean += value / draws.count;
  for (const double value : drawn) squares += std::pow(value - fit.mean, 2);
  fit.scatter = std::sqrt(squares / (draws.count - 1));
  return fit;
}

double neg_llh_of(const std::vector<ModelJudge::Fit>& fits) {
  double sum = 0;
  for (const ModelJudge::Fit& fit : fits) sum += fit.measured.neg_llh;
  return sum;
}

ExpectedFit right_fit(const std::vector<ModelJudge::Fit>& fits) {
  double variance = 0;
  ExpectedFit right;
  for (const ModelJudge::Fit& fit : fits) {
    right.mean += fit.expected;
    variance += fit.scatter * fit.scatter;
  }
  right.scatter = std::sqrt(variance);
  return right;
}

double neg_llh_of_floor(const FlasherData& data, double floor) {
  double charge = 0;
  for (const RunData& run : data.runs) charge += run.charge;
  return floor * floor * charge / 2;
}

double probability_of(double neg_llh, const ExpectedFit& right) {
  const double variance = right.scatter * right.scatter;
  neg_llh = std::max(0.0, neg_llh);  // less than a floor
  return chi_square_probability(2 * neg_llh * right.mean / variance, 2 * right.mean * right.mean / variance);
}

}  // namespace floe
