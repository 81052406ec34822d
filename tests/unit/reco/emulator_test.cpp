#include "reco/direct_fit/emulator.h"

#include <ceres/gradient_checker.h>
#include <gtest/gtest.h>

#include <cmath>

#include "reco/direct_fit/design.h"
#include "reco/direct_fit/local_fit.h"
#include "tests/unit/reco/toy_light.h"

namespace floe {
namespace {

class EmulatorTest : public ::testing::Test {
 protected:
  EmulatorTest()
      : truth_{{25, -45, -250}, 120, 1.2, 2.3, 4000},
        event_(light_.draw(truth_, 1)),
        data_(*light_.model().detector, event_),
        frame_(light_centre(truth_, CascadeKind::electron)) {
    settings_.position_step = 5;
    settings_.direction_step = 0.12;
    for (std::uint64_t draw = 0; draw < 2; ++draw)
      for (const Coordinates& place : simplex_design(1, draw)) {
        Vector7 local = Vector7::Zero();
        local.head<3>() = settings_.position_step * place.head<3>();
        local.segment<2>(3) = settings_.direction_step * place.tail<2>();
        samples_.push_back(
            light_.sample({cascade_of(frame_.at(local), CascadeKind::electron), 5e6, 5, ++stream_}));
      }
    for (const LightSample& sample : samples_) pointers_.push_back(&sample);
  }

  ToyLight light_{17};
  CascadeParameters truth_;
  Event event_;
  EventData data_;
  LocalFrame frame_;
  EmulatorSettings settings_;
  std::uint64_t stream_ = 100;
  std::vector<LightSample> samples_;
  std::vector<const LightSample*> pointers_;
};

TEST_F(EmulatorTest, PredictsTheLightOfOtherCascades) {
  const Emulator emulator(data_, MeanIce({30, 100}), frame_.origin(), pointers_, settings_);
  const Vector7 p = (Vector7() << 3, -2, 2, 0.05, -0.05, 6, 0.1).finished();
  std::vector<Emulator::Evaluation> values;
  emulator.evaluate(p, values);
  const LightCentre there = frame_.at(p);
  std::size_t bin = 0;
  double square = 0;
  int bright = 0;
  for (const ModuleData& lit : data_.lit()) {
    const double expected = light_.mean_charge(there, data_.detector().modules()[lit.module].position);
    double emulated = 0, variance = 0;
    for (std::size_t b = 0; b < lit.counts.size(); ++b, ++bin) {
      const double mean = std::exp(values[bin].log_mean);
      emulated += mean;
      variance += mean * mean / emulator.bins()[bin].effective_counts;
    }
    if (expected < 5) continue;
    ++bright;
    square += std::pow(emulated - expected, 2) / (2 * variance + std::pow(0.03 * expected, 2));
  }
  ASSERT_GT(bright, 20);
  EXPECT_LT(square / bright, 1.5);
}

TEST_F(EmulatorTest, GradientsAreRight) {
  for (const double noise : {0.0, 2e4}) {
    DataSelection selection;
    selection.noise_rate = noise;
    const EventData data(*light_.model().detector, event_, selection);
    const Emulator emulator(data, MeanIce({30, 100}), frame_.origin(), pointers_, settings_);
    const auto cost = make_cost(emulator);
    ceres::NumericDiffOptions options;
    options.ridders_relative_initial_step_size = 1e-4;
    const ceres::GradientChecker checker(
        cost.get(), static_cast<const std::vector<const ceres::Manifold*>*>(nullptr), options);
    const Vector7 p = (Vector7() << 1, 0.5, -2, 0.02, 0.05, 3, -0.1).finished();
    const double* parameters[] = {p.data()};
    ceres::GradientChecker::ProbeResults results;
    checker.Probe(parameters, 1e-4, &results);
    // Of columns that hold numbers of very different size, the small ones are only known absolutely.
    const Eigen::MatrixXd gap = results.jacobians[0] - results.numeric_jacobians[0];
    for (int i = 0; i < 7; ++i) {
      const double largest = results.jacobians[0].col(i).cwiseAbs().maxCoeff();
      EXPECT_GT(largest, 0) << "parameter " << i;
      EXPECT_LT(gap.col(i).cwiseAbs().maxCoeff(), 1e-4 * largest) << "parameter " << i;
    }
  }
}

TEST_F(EmulatorTest, CostIsTheLikelihood) {
  const Emulator emulator(data_, MeanIce({30, 100}), frame_.origin(), pointers_, settings_);
  const auto cost = make_cost(emulator);
  const Vector7 p = (Vector7() << 1, 0.5, -2, 0.02, 0.05, 3, -0.1).finished();
  const double* parameters[] = {p.data()};
  Eigen::VectorXd residuals(cost->num_residuals());
  ASSERT_TRUE(cost->Evaluate(parameters, residuals.data(), nullptr));
  EXPECT_NEAR(0.5 * residuals.squaredNorm(), emulator.neg_llh(p), 1e-6 * emulator.neg_llh(p));
}

TEST_F(EmulatorTest, FitFindsTheTruthFromNearBy) {
  const Vector7 away = (Vector7() << 3, -3, 2, 0.08, -0.05, 8, 0.1).finished();
  const LocalFrame start(frame_.at(away));
  const Emulator emulator(data_, MeanIce({30, 100}), start.origin(), pointers_, settings_);
  const LocalFit fit = fit_locally(emulator);
  const Vector7 gap = fit.step - start.of(frame_.origin());
  EXPECT_TRUE(fit.converged);
  // Chi-square of 7; the errors hold a model error that this light does not have. p < 1e-3: 24.3.
  EXPECT_LT(gap.dot(fit.information * gap), 24.3);
}

}  // namespace
}  // namespace floe
