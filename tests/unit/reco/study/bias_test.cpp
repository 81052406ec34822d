#include "reco/study/bias.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/reco/study/gaussian_rows.h"

namespace floe {
namespace {

constexpr int event_count = 1000;

// The other model's fits are off by as many of their errors in energy, and their -ln L is larger by 3.
std::vector<StudyRow> biased_rows(double errors_of_energy) {
  std::vector<StudyRow> rows = gaussian_rows(event_count);
  for (StudyRow& row : rows) {
    row.other = row.fit;
    row.other->cascade.energy += errors_of_energy * std::sqrt(row.fit.covariance(6, 6));
    row.delta_neg_llh = row.index % 2 == 0 ? 1 : 5;
    row.delta_neg_llh_error = 2;
  }
  return rows;
}

TEST(StudyBias, OfTheTrueModelIsChance) {
  const StudyBias bias = summarise_bias(biased_rows(0.5));
  ASSERT_EQ(bias.events, static_cast<std::size_t>(event_count));
  for (const StudyChiSquare* sum : {&bias.truth.direction, &bias.truth.energy, &bias.truth.all}) {
    const double degrees = double(sum->degrees);
    EXPECT_NEAR(sum->value, degrees, 4 * std::sqrt(2 * degrees));
    EXPECT_GT(sum->probability(), 3e-5);
  }
  EXPECT_EQ(bias.truth.direction.degrees, 2u * event_count);
  EXPECT_EQ(bias.truth.energy.degrees, 1u * event_count);
  EXPECT_EQ(bias.truth.all.degrees, 7u * event_count);
}

TEST(StudyBias, OfTheOtherModelIsSeenWhereItIs) {
  const StudyBias bias = summarise_bias(biased_rows(0.5));
  // (n + s)^2 of a normal n: mean 1 + s^2, variance 2 + 4 s^2.
  EXPECT_NEAR(bias.other.energy.value, 1.25 * event_count, 4 * std::sqrt(3.0 * event_count));
  EXPECT_LT(bias.other.energy.probability(), 1e-4);
  EXPECT_DOUBLE_EQ(bias.other.direction.value, bias.truth.direction.value);
  EXPECT_DOUBLE_EQ(bias.other.median_angle, bias.truth.median_angle);
  EXPECT_GT(bias.other.mean_log_energy, bias.truth.mean_log_energy + 0.004);
}

TEST(StudyBias, LikelihoodIsSummedWithTheSimulationsErrors) {
  const StudyBias bias = summarise_bias(biased_rows(0));
  EXPECT_DOUBLE_EQ(bias.mean_delta, 3);
  EXPECT_NEAR(bias.mean_delta_error, 2 / std::sqrt(double(event_count - 1)), 1e-12);
  EXPECT_DOUBLE_EQ(bias.sum_delta, 3 * event_count);
  EXPECT_NEAR(bias.sum_delta_error, 2 * std::sqrt(double(event_count)), 1e-9);
  EXPECT_DOUBLE_EQ(bias.least_significance, 0.5);
  EXPECT_DOUBLE_EQ(bias.median_significance, 1.5);
}

TEST(StudyBias, LeavesOutEventsWithoutBothFits) {
  std::vector<StudyRow> rows = biased_rows(0);
  rows[0].other.reset();
  rows[1].other->status = FitStatus::not_enough_light;
  rows[2].fit.status = FitStatus::not_enough_light;
  EXPECT_EQ(summarise_bias(rows).events, event_count - 3u);
  EXPECT_EQ(summarise_bias({}).events, 0u);
  EXPECT_EQ(text_of(summarise_bias({})), "Fitted with the other model: no event\n");
}

}  // namespace
}  // namespace floe
