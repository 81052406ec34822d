// Which bins a pulse's charge belongs to when its light is spread over a width.
#pragma once

#include <algorithm>
#include <span>

namespace floe {

// Evenly from time - width / 2 to time + width / 2. `edges` between the bins rise; the first and the last bin
// are open, so that there is one bin more.
inline void add_spread(double time, double width, double charge, std::span<const double> edges,
                       std::span<double> bins) {
  double from = time - width / 2;
  const double end = time + width / 2;
  auto edge = std::upper_bound(edges.begin(), edges.end(), from);
  for (; edge != edges.end() && *edge < end; ++edge) {
    bins[static_cast<std::size_t>(edge - edges.begin())] += charge * (*edge - from) / width;
    from = *edge;
  }
  const double rest = width > 0 ? (end - from) / width : 1;
  bins[static_cast<std::size_t>(edge - edges.begin())] += charge * rest;
}

}  // namespace floe
