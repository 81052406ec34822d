#include "reco/study/pulls.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace floe {
namespace {

// Half of the interval between the quantiles that leave out as many values on either side as of a Gaussian
// beyond one standard deviation. Quantiles have the plotting positions at which few Gaussian values lie on
// average (Blom 1958): others are too narrow by a tenth for ten values.
double half_of_central_share(std::span<const double> values) {
  constexpr std::size_t fewest = 6;
  if (values.size() < fewest) return PullSummary::unknown;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const auto quantile = [&](double part) {
    const double place = part * (double(sorted.size()) + 0.25) + 0.375 - 1;
    const double below = std::clamp(std::floor(place), 0.0, double(sorted.size() - 2));
    const auto i = static_cast<std::size_t>(below);
    return sorted[i] + (place - below) * (sorted[i + 1] - sorted[i]);
  };
  return 0.5 * (quantile(0.5 + 0.5 * central_share) - quantile(0.5 - 0.5 * central_share));
}

PullSummary values_of(std::span<const double> pulls) {
  PullSummary result;
  if (pulls.empty()) return result;
  result.mean = mean_of(pulls);
  result.width = standard_deviation(pulls);
  result.core = half_of_central_share(pulls);
  const auto inside =
      std::count_if(pulls.begin(), pulls.end(), [](double pull) { return std::abs(pull) < 1; });
  result.coverage = double(inside) / double(pulls.size());
  return result;
}

std::vector<double> joined(std::span<const Vector7> events) {
  std::vector<double> pulls;
  for (const Vector7& event : events) pulls.insert(pulls.end(), event.begin(), event.end());
  return pulls;
}

}  // namespace

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double standard_deviation(std::span<const double> values) {
  const double mean = mean_of(values);
  double square = 0;
  for (const double value : values) square += (value - mean) * (value - mean);
  return values.size() > 1 ? std::sqrt(square / double(values.size() - 1)) : PullSummary::unknown;
}

double binomial_error(double count) {
  return std::sqrt(central_share * (1 - central_share) / count);
}

PullSummary summary_of(std::span<const double> pulls) {
  PullSummary result = values_of(pulls);
  const double n = double(pulls.size());
  result.width_error = result.width / std::sqrt(2 * n);
  result.core_error = 0.96 * result.core / std::sqrt(n);  // of a Gaussian's quantiles
  if (n > 0) result.coverage_error = binomial_error(n);
  return result;
}

PullSummary summary_of(std::span<const Vector7> pulls_of_events) {
  constexpr int draws = 1000;
  PullSummary result = values_of(joined(pulls_of_events));
  if (pulls_of_events.size() < 2) return result;
  std::mt19937_64 engine(1);
  std::uniform_int_distribution<std::size_t> any(0, pulls_of_events.size() - 1);
  std::vector<double> widths, cores, coverages;
  std::vector<Vector7> drawn(pulls_of_events.size());
  for (int draw = 0; draw < draws; ++draw) {
    for (Vector7& event : drawn) event = pulls_of_events[any(engine)];
    const PullSummary found = values_of(joined(drawn));
    widths.push_back(found.width), cores.push_back(found.core), coverages.push_back(found.coverage);
  }
  result.width_error = standard_deviation(widths);
  result.core_error = standard_deviation(cores);
  // Where all values are inside, or none, draws do not scatter: no less than for independent values.
  result.coverage_error =
      std::max(standard_deviation(coverages), binomial_error(7 * double(pulls_of_events.size())));
  return result;
}

}  // namespace floe
