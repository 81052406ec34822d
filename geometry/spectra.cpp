#include <fmt/format.h>

#include <algorithm>

#include "data/base/text.h"
#include "geometry/acceptance.h"
#include "geometry/with_file_name.h"

namespace floe {

namespace {

constexpr double shortest = 100, longest = 2000;  // wavelengths that make sense here [nm]

void check_wavelengths(const auto& points, const char* what) {
  if (points.empty()) throw InputError(fmt::format("{}: found no points", what));
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!(points[k].wavelength >= shortest && points[k].wavelength <= longest))
      throw InputError(fmt::format("{}: found wavelength {} nm; expected {} to {} nm", what,
                                   points[k].wavelength, shortest, longest));
    if (k > 0 && !(points[k].wavelength > points[k - 1].wavelength))
      throw InputError(fmt::format("{}: found wavelength {} nm after {} nm; expected wavelengths that rise",
                                   what, points[k].wavelength, points[k - 1].wavelength));
  }
}

// Rows of two numbers.
std::vector<std::pair<double, double>> read_pairs(const std::filesystem::path& file, const char* first,
                                                  const char* second) {
  std::vector<std::pair<double, double>> pairs;
  for (const TextLine& line : read_text_lines(file)) {
    expect_fields(line, 2, 2, fmt::format("{}, {}", first, second));
    pairs.emplace_back(parse_number(line, 0, first), parse_number(line, 1, second));
  }
  return pairs;
}

}  // namespace

WavelengthSpectrum::WavelengthSpectrum(std::vector<Point> points) : points_(std::move(points)) {
  check_wavelengths(points_, "wavelength spectrum");
  if (points_.size() < 2) throw InputError("wavelength spectrum: found one point; expected at least two");
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (!(points_[k].cumulative >= (k > 0 ? points_[k - 1].cumulative : 0)))
      throw InputError(
          fmt::format("wavelength spectrum: found cumulative {} at {} nm; expected values that do not fall",
                      points_[k].cumulative, points_[k].wavelength));
  if (points_.front().cumulative != 0 || points_.back().cumulative != 1)
    throw InputError(
        fmt::format("wavelength spectrum: found cumulative values from {} to {}; expected 0 to 1",
                    points_.front().cumulative, points_.back().cumulative));
  lay_out_guides();
}

// first_interval_[k] is the first interval that ends above k/guides: where the search for a cumulative
// in [k, k + 1)/guides starts.
void WavelengthSpectrum::lay_out_guides() {
  std::size_t interval = 0;
  for (std::size_t k = 0; k < guides; ++k) {
    const double start = static_cast<double>(k) / guides;
    while (interval + 2 < points_.size() && !(points_[interval + 1].cumulative > start)) ++interval;
    first_interval_[k] = static_cast<std::uint16_t>(interval);
  }
}

double WavelengthSpectrum::sample(double u) const {
  const double inside = std::clamp(u, 0.0, 1.0);
  const auto guide = std::min(static_cast<std::size_t>(inside * guides), guides - 1);
  std::size_t interval = first_interval_[guide];
  while (interval + 2 < points_.size() && !(points_[interval + 1].cumulative > inside)) ++interval;
  // At u = 1 flat intervals at the end hold no light: the last one that rises.
  while (interval > 0 && !(points_[interval + 1].cumulative > points_[interval].cumulative)) --interval;
  const Point &low = points_[interval], &high = points_[interval + 1];
  const double share = (inside - low.cumulative) / (high.cumulative - low.cumulative);
  return low.wavelength + std::min(share, 1.0) * (high.wavelength - low.wavelength);
}

double WavelengthSpectrum::density(double wavelength) const {
  const auto next =
      std::upper_bound(points_.begin(), points_.end(), wavelength,
                       [](double value, const Point& point) { return value < point.wavelength; });
  if (next == points_.begin() || next == points_.end()) return 0;
  const Point& low = *(next - 1);
  return (next->cumulative - low.cumulative) / (next->wavelength - low.wavelength);
}

WavelengthSpectrum read_wavelength_spectrum(const std::filesystem::path& wv_dat) {
  std::vector<WavelengthSpectrum::Point> points;
  for (const auto& [cumulative, wavelength] : read_pairs(wv_dat, "cumulative spectrum", "wavelength [nm]"))
    points.push_back({cumulative, wavelength});
  return with_file_name(wv_dat, [&] { return WavelengthSpectrum(std::move(points)); });
}

HighQeRatio::HighQeRatio(std::vector<Point> points) : points_(std::move(points)) {
  check_wavelengths(points_, "high-QE ratio");
  for (const Point& point : points_)
    if (!(point.ratio >= 0 && point.ratio <= 100))
      throw InputError(
          fmt::format("high-QE ratio: found {} at {} nm; expected 0 to 100", point.ratio, point.wavelength));
  if (!(maximum() > 0)) throw InputError("high-QE ratio: found 0 everywhere; expected light somewhere");
}

double HighQeRatio::operator()(double wavelength) const {
  const auto next =
      std::lower_bound(points_.begin(), points_.end(), wavelength,
                       [](const Point& point, double value) { return point.wavelength < value; });
  if (next == points_.begin()) return points_.front().ratio;
  if (next == points_.end()) return points_.back().ratio;
  const Point& low = *(next - 1);
  const double fraction = (wavelength - low.wavelength) / (next->wavelength - low.wavelength);
  return low.ratio + fraction * (next->ratio - low.ratio);
}

double HighQeRatio::maximum() const {
  return std::max_element(points_.begin(), points_.end(),
                          [](const Point& a, const Point& b) { return a.ratio < b.ratio; })
      ->ratio;
}

HighQeRatio read_high_qe_ratio(const std::filesystem::path& wv_rde) {
  std::vector<HighQeRatio::Point> points;
  for (const auto& [wavelength, ratio] : read_pairs(wv_rde, "wavelength [nm]", "high-QE ratio"))
    points.push_back({wavelength, ratio});
  return with_file_name(wv_rde, [&] { return HighQeRatio(std::move(points)); });
}

}  // namespace floe
