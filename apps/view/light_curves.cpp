#include "apps/view/light_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace floe {

namespace {

struct Light {
  std::size_t module;
  double time, charge;
};

std::vector<Light> in_order(std::span<const Hit> hits, const Detector& detector, std::uint64_t& left_out) {
  std::vector<Light> lights;
  lights.reserve(hits.size());
  for (const Hit& hit : hits) {
    if (const auto module = detector.find(hit.module))
      lights.push_back({*module, hit.time, hit.charge});
    else
      ++left_out;
  }
  std::sort(lights.begin(), lights.end(), [](const Light& a, const Light& b) {
    return a.module != b.module ? a.module < b.module : a.time < b.time;
  });
  return lights;
}

double bin_of(double time, const LightCurves& curves) {
  return std::floor((time - curves.begin) / curves.bin_width);
}

std::size_t bins_with_light(const std::vector<Light>& lights, const LightCurves& curves) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < lights.size(); ++i)
    count += i == 0 || lights[i].module != lights[i - 1].module ||
             bin_of(lights[i].time, curves) != bin_of(lights[i - 1].time, curves);
  return count;
}

// 1, 2, 5, 10, 20, ... ns.
double wider(double width) {
  const double decade = std::pow(10, std::floor(std::log10(width) + 0.01));
  return width < 1.5 * decade ? 2 * decade : width < 3 * decade ? 5 * decade : 10 * decade;
}

void set_bins(const std::vector<Light>& lights, std::size_t most_bins, LightCurves& curves) {
  double first = std::numeric_limits<double>::max(), last = std::numeric_limits<double>::lowest();
  for (const Light& light : lights) {
    first = std::min(first, light.time);
    last = std::max(last, light.time);
  }
  curves.begin = std::floor(first);
  curves.end = last;
  constexpr double largest_bin = 1e9;  // what a page's numbers hold with ease
  // Where there are fewer bins than modules with light, none is narrow enough: one wide bin each is left.
  while (bin_of(last, curves) > largest_bin ||
         (bin_of(last, curves) > 0 && bins_with_light(lights, curves) > most_bins))
    curves.bin_width = wider(curves.bin_width);
}

}  // namespace

LightCurves light_curves(std::span<const Hit> hits, const Detector& detector, std::size_t most_bins) {
  LightCurves curves;
  const std::vector<Light> lights = in_order(hits, detector, curves.left_out);
  if (lights.empty()) return curves;
  set_bins(lights, most_bins, curves);
  for (const Light& light : lights) {
    if (curves.modules.empty() || curves.modules.back().module != light.module)
      curves.modules.push_back({light.module, 0, 0, light.time, {}, {}});
    LightCurve& curve = curves.modules.back();
    ++curve.hits;
    curve.charge += light.charge;
    const auto bin = static_cast<std::uint32_t>(bin_of(light.time, curves));
    if (curve.bins.empty() || curve.bins.back() != bin) {
      curve.bins.push_back(bin);
      curve.charge_in_bin.push_back(0);
    }
    curve.charge_in_bin.back() += light.charge;
  }
  return curves;
}

}  // namespace floe
