// What a handful of noisy repetitions says.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace floe {

struct Spread {
  double median, lowest, highest;
};

// Of at least one value.
inline Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {(values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back()};
}

}  // namespace floe
