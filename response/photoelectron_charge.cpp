#include "response/photoelectron_charge.h"

#include <cmath>
#include <numbers>

#include "response/draws.h"

namespace floe {

namespace {

// Of a Gaussian around 1: its density, and how much of it lies below.
double gaussian(double q, double sigma) {
  const double z = (q - 1) / sigma;
  return std::exp(-0.5 * z * z) / (sigma * std::sqrt(2 * std::numbers::pi));
}
double gaussian_below(double q, double sigma) {
  return 0.5 * std::erfc((1 - q) / (sigma * std::numbers::sqrt2));
}

}  // namespace

double PhotoelectronCharge::density(double charge) const {
  if (charge <= 0) return 0;
  const auto& s = settings_;
  const double above = 1 - gaussian_below(0, s.peak_width);
  return s.steep_share / s.steep_width * std::exp(-charge / s.steep_width) +
         s.exponential_share / s.exponential_width * std::exp(-charge / s.exponential_width) +
         (1 - s.steep_share - s.exponential_share) * gaussian(charge, s.peak_width) / above;
}

double PhotoelectronCharge::probability_below(double charge) const {
  if (charge <= 0) return 0;
  const auto& s = settings_;
  const double cut = gaussian_below(0, s.peak_width);
  return s.steep_share * -std::expm1(-charge / s.steep_width) +
         s.exponential_share * -std::expm1(-charge / s.exponential_width) +
         (1 - s.steep_share - s.exponential_share) * (gaussian_below(charge, s.peak_width) - cut) / (1 - cut);
}

double PhotoelectronCharge::mean() const {
  const auto& s = settings_;
  const double above = 1 - gaussian_below(0, s.peak_width);
  const double peak = 1 + s.peak_width * s.peak_width * gaussian(0, s.peak_width) / above;
  return s.steep_share * s.steep_width + s.exponential_share * s.exponential_width +
         (1 - s.steep_share - s.exponential_share) * peak;
}

double PhotoelectronCharge::draw(RandomStream& stream) const {
  const auto& s = settings_;
  const double kind = stream.uniform();
  if (kind < s.steep_share) return s.steep_width * stream.exponential();
  if (kind < s.steep_share + s.exponential_share) return s.exponential_width * stream.exponential();
  for (;;)
    if (const double charge = 1 + s.peak_width * draw_gaussian(stream); charge > 0) return charge;
}

}  // namespace floe
