// The Cramer-Rao bound that `floe study` measures, against the exact one of light in closed form.
#include "reco/direct_fit/information_bound.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <vector>

#include "reco/direct_fit/arrival_bins.h"
#include "reco/event_data.h"
#include "tests/unit/reco/toy_light.h"

namespace floe {
namespace {

// Of a gamma distribution with such shape and scale 1: the series of the incomplete gamma function, all
// terms of which are positive.
double share_before(double shape, double x) {
  if (x <= 0) return 0;
  if (x > shape + 20 * std::sqrt(shape) + 40) return 1;
  double term = 1 / shape, sum = term;
  for (int n = 1; term > 1e-16 * sum; ++n) {
    term *= x / (shape + n);
    sum += term;
  }
  return sum * std::exp(shape * std::log(x) - x - std::lgamma(shape));
}

// Expected counts in all bins of the toy's light.
std::vector<double> expected(const ToyLight& toy, const EventData& data, const LightCentre& light) {
  std::vector<double> result;
  const auto add = [&](std::uint32_t module, const std::vector<double>& edges) {
    const Vec3 place = data.detector().modules()[module].position;
    const ToyLight::Delay delay = ToyLight::delay(light, place);
    const double charge = toy.mean_charge(light, place);
    double before = 0;
    for (std::size_t i = 0; i <= edges.size(); ++i) {
      const double after =
          i < edges.size() ? share_before(delay.shape, (edges[i] - light.time - delay.flight) / delay.scale)
                           : 1;
      result.push_back(charge * std::max(1e-12, after - before));
      before = after;
    }
  };
  for (const ModuleData& lit : data.lit()) add(lit.module, lit.edges);
  for (const std::uint32_t dark : data.dark()) add(dark, {});
  return result;
}

Matrix7 exact_information(const ToyLight& toy, const EventData& data, const LocalFrame& frame) {
  const std::vector<double> mean = expected(toy, data, frame.origin());
  const Vector7 step = (Vector7() << 0.01, 0.01, 0.01, 1e-4, 1e-4, 0.01, 1e-4).finished();
  std::vector<Vector7> slope(mean.size());
  for (int k = 0; k < 7; ++k) {
    const Vector7 move = step(k) * Vector7::Unit(k);
    const auto more = expected(toy, data, frame.at(move)), less = expected(toy, data, frame.at(-move));
    for (std::size_t i = 0; i < mean.size(); ++i) slope[i](k) = (more[i] - less[i]) / (2 * step(k));
  }
  Matrix7 information = Matrix7::Zero();
  for (std::size_t i = 0; i < mean.size(); ++i) information += slope[i] * slope[i].transpose() / mean[i];
  return information;
}

struct Bounds {
  Vector7 measured, exact;  // errors
};

Bounds bounds(const CascadeParameters& truth, std::uint64_t seed) {
  ToyLight light(seed);
  const Event event = light.draw(truth, 77777);
  FitOptions options;
  options.threads = 2;
  options.seed = seed;
  const EventData data(*light.model().detector, event);
  const Matrix7 measured = cramer_rao_bound(light, truth, data, options);

  const LocalFrame frame(light_centre(truth, options.kind));
  const LightSample sample = light.sample({truth, 20 * light.photons_per_cascade(truth, 5), 5, 900000});
  const LightSample* const samples[] = {&sample};
  const EventData binned = data.with_edges(arrival_edges(data, frame, samples, options.kind));
  const Matrix7 jacobian = frame.jacobian(Vector7::Zero(), options.kind);
  const Matrix7 exact = jacobian * exact_information(light, binned, frame).inverse() * jacobian.transpose();
  return {measured.diagonal().cwiseSqrt(), exact.diagonal().cwiseSqrt()};
}

// Every error within a fifth of the exact one, and no bias on the whole: the emulator's bins have a few per
// cent less information than there is, its noise leaves as much again.
TEST(InformationBound, IsThatOfLightInClosedForm) {
  const CascadeParameters cascades[] = {{{20, -40, -300}, 100, 1.2, 2.0, 2000},
                                        {{-80, 110, -150}, 500, 2.3, 5.0, 5000},
                                        {{60, 90, -220}, 900, 0.6, 0.5, 20000}};
  double sum = 0;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const Bounds found = bounds(cascades[i], 11 + i);
    for (int k = 0; k < 7; ++k) {
      EXPECT_NEAR(found.measured(k) / found.exact(k), 1.05, 0.2) << "cascade " << i << " parameter " << k;
      sum += std::log(found.measured(k) / found.exact(k)) / 21;
    }
  }
  EXPECT_NEAR(std::exp(sum), 1.05, 0.08);
}

// A module far above its cap says only that it is bright: hardly more than a module that is left out.
TEST(InformationBound, SaturatedModulesCountAsLittleAsTheySay) {
  constexpr double cap = 30;
  const CascadeParameters truth{{60, 90, -220}, 900, 0.6, 0.5, 20000};
  ToyLight light(13);
  const Event event = light.draw(truth, 77777);
  FitOptions options;
  options.threads = 2;
  options.seed = 13;
  const auto errors = [&](const DataSelection& selection) -> Vector7 {
    const EventData data(*light.model().detector, event, selection);
    return cramer_rao_bound(light, truth, data, options).diagonal().cwiseSqrt();
  };
  const EventData all(*light.model().detector, event);
  DataSelection capped, without;
  capped.charge_cap = cap;
  for (const ModuleData& lit : all.lit())
    if (lit.charge >= cap) without.bad.push_back(all.detector().modules()[lit.module].id);
  ASSERT_GT(without.bad.size(), 5u);
  const Vector7 saturated = errors(capped), left_out = errors(without), whole = errors({});
  for (int k = 0; k < 7; ++k) {
    // Each bound is known to a tenth; which modules are above the cap tells something of the energy, too.
    EXPECT_LT(saturated(k), 1.15 * left_out(k)) << k;
    EXPECT_GT(saturated(k), 0.9 * whole(k)) << k;
  }
}

// Errors of a fit that its own noise made small come up to the bound; others stay as they are.
TEST(NoLessThan, RaisesWhatIsBelowTheBoundInAnyDirection) {
  Matrix7 mix = Matrix7::Identity();
  mix(0, 1) = 0.7, mix(2, 5) = -0.4, mix(6, 3) = 2;
  Vector7 of_bound, of_fit;
  of_bound << 1, 4, 1e-4, 9, 1, 2, 1e6;
  of_fit << 0.25, 9, 1e-4, 0.01, 1, 8, 4e6;
  const Matrix7 bound = mix * of_bound.asDiagonal() * mix.transpose(),
                fit = mix * of_fit.asDiagonal() * mix.transpose(),
                expected = mix * of_bound.cwiseMax(of_fit).asDiagonal() * mix.transpose();
  const Matrix7 raised = no_less_than(bound, fit);
  for (int i = 0; i < 7; ++i)
    for (int k = 0; k < 7; ++k)
      EXPECT_NEAR(raised(i, k), expected(i, k), 1e-9 * std::sqrt(expected(i, i) * expected(k, k)));
  const Matrix7 open = Matrix7::Constant(std::numeric_limits<double>::infinity());
  EXPECT_EQ(no_less_than(open, fit), fit);
}

}  // namespace
}  // namespace floe
