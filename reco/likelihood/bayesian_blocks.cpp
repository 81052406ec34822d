#include "reco/likelihood/bayesian_blocks.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace floe {
namespace {

// Places where a block may begin: next to every cell with counts.
std::vector<std::size_t> candidate_cuts(std::span<const double> counts) {
  std::vector<std::size_t> cuts{0};
  for (std::size_t i = 1; i < counts.size(); ++i)
    if (counts[i] > 0 || counts[i - 1] > 0) cuts.push_back(i);
  cuts.push_back(counts.size());
  return cuts;
}

double fitness(double count, double length) {
  return count > 0 ? count * std::log(count / length) : 0;
}

}  // namespace

std::vector<std::size_t> bayesian_blocks(std::span<const double> counts, double false_cut) {
  assert(false_cut > 0 && false_cut < 1);
  double total = 0;
  for (const double count : counts) total += count;
  if (total < 2) return {};

  const std::vector<std::size_t> cuts = candidate_cuts(counts);
  const std::size_t n = cuts.size() - 1;  // pieces between neighbouring cuts
  std::vector<double> before(n + 1, 0);   // counts before each cut
  for (std::size_t i = 0; i < n; ++i) {
    before[i + 1] = before[i];
    for (std::size_t cell = cuts[i]; cell < cuts[i + 1]; ++cell) before[i + 1] += counts[cell];
  }

  // best[j]: the largest fitness of the first j pieces; last[j]: where its last block begins.
  const double prior = 4 - std::log(73.53 * false_cut * std::pow(double(counts.size()), -0.478));
  std::vector<double> best(n + 1, 0);
  std::vector<std::size_t> last(n + 1, 0);
  for (std::size_t j = 1; j <= n; ++j) {
    best[j] = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < j; ++i) {
      const double value = best[i] - prior + fitness(before[j] - before[i], double(cuts[j] - cuts[i]));
      if (value > best[j]) best[j] = value, last[j] = i;
    }
  }

  std::vector<std::size_t> result;
  for (std::size_t j = last[n]; j > 0; j = last[j]) result.push_back(cuts[j]);
  std::reverse(result.begin(), result.end());
  return result;
}

std::vector<double> block_edges(std::span<const double> times, std::span<const double> charges, double begin,
                                double end, double cell) {
  assert(times.size() == charges.size() && cell > 0 && end >= begin);
  const double first = std::floor(begin / cell);
  const auto cells = static_cast<std::size_t>(std::max(1.0, std::ceil(end / cell) - first));
  std::vector<double> counts(cells, 0);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double place = std::floor(times[i] / cell) - first;
    counts[static_cast<std::size_t>(std::clamp(place, 0.0, double(cells - 1)))] += charges[i];
  }
  std::vector<double> edges;
  for (const std::size_t cut : bayesian_blocks(counts)) edges.push_back((first + double(cut)) * cell);
  return edges;
}

}  // namespace floe
