// Values of strong effects, on light whose change is known.
#include "reco/diagnose/score_values.h"

#include <gtest/gtest.h>

#include <cmath>

namespace floe {
namespace {

// One run of a few bins, whose light grows by exp(slope a).
class OneRun : public ::testing::Test {
 protected:
  const Eigen::VectorXd base_{{400, 900, 250, 100}}, slopes_{{0.2, -0.1, -1, -2.5}};
  Survey survey_;
  Suspect suspect_{"absorption-scale", {}, {{{0, 1}}}};
  TestedSuspect tested_;

  OneRun() {
    SurveyRun run;
    run.scale = 0.5;
    run.expected = base_;
    run.trust = Eigen::ArrayXd::Ones(base_.size());
    run.counts = {base_, {base_, base_}};  // as bright as 2 scale
    // Without what brightness can do.
    const double mean = base_.dot(slopes_) / base_.sum();
    const Eigen::VectorXd weight = slopes_.array() - mean;
    run.halves = run.weights = {weight, weight};
    const double information = (weight.array().square() * base_.array()).sum();
    survey_.runs.push_back(run);
    survey_.columns.resize(1);
    survey_.bins = base_.size();
    const auto one = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
    tested_ = {&suspect_,
               one(information),
               one(information),
               one(1 / information),
               one(1 / information),
               Eigen::VectorXd::Zero(1),
               Eigen::VectorXd::Constant(1, -2),
               Eigen::VectorXd::Constant(1, 2),
               base_.sum(),
               1};
  }

  Eigen::VectorXd light(double amplitude) const {
    return base_.array() * (slopes_ * amplitude).array().exp();
  }
  // Of data with this amplitude, 1.3 times as bright as expected.
  SurveyCounts data(double amplitude) const {
    SurveyCounts counts = measured_counts(survey_);
    counts[0].data = 1.3 * light(amplitude);
    return counts;
  }
  Score score(double truth) const {
    return {suspect_, 0, tested_.amplitudes(gap_of(survey_, data(truth))), tested_.errors()};
  }
  ScoreValues refined(double truth) const {
    const auto simulated = [&](const Eigen::VectorXd& at) { return LightInBins{10 * light(at(0))}; };
    return beyond_first_order(survey_, tested_, data(truth), score(truth), simulated);
  }
};

TEST_F(OneRun, StrongEffectsComeOutRight) {
  for (const double truth : {-0.25, 0.1, 0.25}) {
    const ScoreValues values = refined(truth);
    EXPECT_NEAR(values.amplitudes(0), truth, 0.2 * values.errors(0)) << truth;
    EXPECT_GT(std::abs(score(truth).amplitudes(0) - truth), 0.1 * values.errors(0)) << truth;
  }
  // Where there is more light that changes, the value is known better.
  EXPECT_LT(refined(-0.25).errors(0), refined(0.1).errors(0));
  EXPECT_LT(refined(0.1).errors(0), refined(0.25).errors(0));
}

TEST_F(OneRun, LimitsHold) {
  tested_.high(0) = 0.2;
  EXPECT_NEAR(refined(0.25).amplitudes(0), 0.2, 1e-9);
}

}  // namespace
}  // namespace floe
