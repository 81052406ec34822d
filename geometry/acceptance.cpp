#include "geometry/acceptance.h"

#include <fmt/format.h>

#include <algorithm>

#include "data/base/text.h"
#include "geometry/with_file_name.h"

namespace floe {

namespace {

// Rounded coefficients may lift a curve a little above its nominal maximum.
constexpr double tolerated_excess = 0.05;

double polynomial_at(const std::vector<double>& coefficients, double x) {
  double value = 0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) value = value * x + *c;
  return value;
}

double largest_value(const std::vector<double>& coefficients) {
  constexpr int steps = 2000;
  double largest = polynomial_at(coefficients, -1);
  for (int k = 1; k <= steps; ++k)
    largest = std::max(largest, polynomial_at(coefficients, 2.0 * k / steps - 1));
  return largest;
}

}  // namespace

AngularAcceptance AngularAcceptance::polynomial(double maximum, std::vector<double> coefficients) {
  if (!(maximum > 0) || !std::isfinite(maximum))
    throw InputError(
        fmt::format("angular acceptance: found maximum {}; expected a positive number", maximum));
  if (coefficients.empty())
    throw InputError("angular acceptance: found no coefficients; expected at least one");
  const double largest = largest_value(coefficients);
  if (!std::isfinite(largest)) throw InputError("angular acceptance: found a coefficient that is not finite");
  if (!(largest > 0)) throw InputError("angular acceptance: found a curve that is nowhere above 0");
  if (largest > (1 + tolerated_excess) * maximum)
    throw InputError(fmt::format(
        "angular acceptance: found a curve that rises to {:.6g}; expected at most its maximum {:.6g}",
        largest, maximum));
  AngularAcceptance acceptance;
  acceptance.maximum_ = maximum;
  acceptance.coefficients_ = std::move(coefficients);
  return acceptance;
}

AngularAcceptance AngularAcceptance::polynomial(std::vector<double> coefficients) {
  const double largest = largest_value(coefficients);
  if (!(largest > 0)) throw InputError("angular acceptance: found a curve that is nowhere above 0");
  return polynomial(largest, std::move(coefficients));
}

AngularAcceptance AngularAcceptance::surface(double cut) {
  if (!(cut >= -1 && cut < 1))
    throw InputError(
        fmt::format("surface acceptance: found cut {}; expected a number from -1 to below 1", cut));
  AngularAcceptance acceptance;
  acceptance.surface_ = true;
  acceptance.cut_ = cut;
  return acceptance;
}

double AngularAcceptance::probability(const Vec3& photon_direction, const Vec3& inward,
                                      const Vec3& up_axis) const {
  if (surface_) return inward.dot(up_axis) > cut_ ? 1 : 0;
  return std::clamp(polynomial_at(coefficients_, photon_direction.dot(up_axis)) / maximum_, 0.0, 1.0);
}

AngularAcceptance read_angular_acceptance(const std::filesystem::path& as_dat) {
  std::vector<double> numbers;
  for (const TextLine& line : read_text_lines(as_dat))
    for (std::size_t k = 0; k < line.fields.size(); ++k)
      numbers.push_back(parse_number(line, k, numbers.empty() ? "maximum" : "coefficient"));
  const Location whole{as_dat.string(), 0};
  if (numbers.size() < 2)
    throw InputError(whole, fmt::format("{} numbers", numbers.size()),
                     "the maximum and polynomial coefficients, or 0 and a cut");
  if (numbers[0] == 0 && numbers.size() != 2)
    throw InputError(whole, fmt::format("{} numbers after 0", numbers.size() - 1), "one, the cut");
  return with_file_name(as_dat, [&] {
    return numbers[0] == 0 ? AngularAcceptance::surface(numbers[1])
                           : AngularAcceptance::polynomial(numbers[0], {numbers.begin() + 1, numbers.end()});
  });
}

}  // namespace floe
