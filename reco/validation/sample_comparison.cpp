#include "reco/validation/sample_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "reco/validation/two_sample_tests.h"

namespace floe {

namespace {

constexpr double least_hits_counted = 20, least_hits_tested = 200;

using HitsOfModule = std::map<ModuleId, std::vector<const Hit*>>;

HitsOfModule by_module(std::span<const Hit> hits) {
  HitsOfModule result;
  for (const Hit& hit : hits) result[hit.module].push_back(&hit);
  return result;
}

template <typename Value>
void test_module(ModuleTests& tests, ModuleId module, const std::vector<const Hit*>& a,
                 const std::vector<const Hit*>& b, Value value) {
  std::vector<double> values_a, values_b;
  for (const Hit* hit : a) values_a.push_back(value(*hit));
  for (const Hit* hit : b) values_b.push_back(value(*hit));
  const double probability = kolmogorov_smirnov(std::move(values_a), std::move(values_b)).probability;
  ++tests.tried;
  if (probability <= tests.smallest_probability) {
    tests.smallest_probability = probability;
    tests.worst = module;
  }
}

}  // namespace

SampleComparison compare_samples(std::span<const Hit> a, double scale_a, std::span<const Hit> b,
                                 double scale_b, double dispersion) {
  SampleComparison result;
  result.hits_a = static_cast<double>(a.size());
  result.hits_b = static_cast<double>(b.size());
  result.ratio = result.hits_a / scale_a / (result.hits_b / scale_b);
  result.ratio_error = result.ratio * std::sqrt(dispersion * (1 / result.hits_a + 1 / result.hits_b));

  HitsOfModule hits_a = by_module(a), hits_b = by_module(b);
  for (const auto& entry : hits_b) hits_a[entry.first];  // modules that only b has seen
  for (const auto& [module, seen_a] : hits_a) {
    const auto& seen_b = hits_b[module];
    const auto count_a = static_cast<double>(seen_a.size()), count_b = static_cast<double>(seen_b.size());
    // What both samples together expect in the smaller of them decides, so that neither sample's own
    // fluctuation selects modules.
    const double expected = (count_a + count_b) / (scale_a + scale_b) * std::min(scale_a, scale_b);
    if (expected < least_hits_counted) continue;
    const double difference = count_a / scale_a - count_b / scale_b;
    const double rate = (count_a + count_b) / (scale_a + scale_b);
    const double variance = dispersion * rate * (1 / scale_a + 1 / scale_b);
    result.chi_square += difference * difference / variance;
    ++result.modules;
    if (std::min(count_a, count_b) < least_hits_tested) continue;
    test_module(result.times, module, seen_a, seen_b, [](const Hit& hit) { return hit.time; });
    if (!seen_a.front()->has_direction() || !seen_b.front()->has_direction()) continue;
    test_module(result.zeniths, module, seen_a, seen_b, [](const Hit& hit) { return hit.direction.z(); });
    test_module(result.azimuths, module, seen_a, seen_b,
                [](const Hit& hit) { return std::atan2(hit.direction.y(), hit.direction.x()); });
    test_module(result.impacts, module, seen_a, seen_b, [](const Hit& hit) { return hit.inward.z(); });
  }
  result.chi_square_p = chi_square_probability(result.chi_square, std::max(1, result.modules));
  return result;
}

}  // namespace floe
