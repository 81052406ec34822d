#include "reco/study/summary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/reco/study/gaussian_rows.h"

namespace floe {
namespace {

const StudyLine& line_of(const StudyTable& table, const std::string& name) {
  for (const StudyLine& line : table.lines)
    if (line.name == name) return line;
  throw std::runtime_error("no line " + name);
}

TEST(StudySummary, GaussianErrorsHavePullsOfWidthOneAndCover) {
  const StudyTable table = summarise(gaussian_rows(1000), "test");
  EXPECT_EQ(table.fitted, 1000u);
  for (const StudyLine& line : table.lines) {
    EXPECT_NEAR(line.pull.coverage, 0.6827, 4 * line.pull.coverage_error) << line.name;
    if (!(line.pull.width > 0)) continue;
    EXPECT_NEAR(line.pull.width, 1, 4 * line.pull.width_error) << line.name;
    EXPECT_NEAR(line.pull.core, 1, 4 * line.pull.core_error) << line.name;
  }
  // Medians of 1000 are known to 1.6 / sqrt(1000) of themselves, at worst.
  for (const char* name : {"position", "direction", "energy"})
    EXPECT_NEAR(line_of(table, name).median_error / line_of(table, name).median_bound, 1, 0.1) << name;
}

// Half of the events ten times worse than the others: the median of errors is no event's own.
TEST(StudySummary, BoundIsThatOfTheMedianOverAllEvents) {
  constexpr int count = 400;
  std::vector<StudyRow> rows = gaussian_rows(count);
  for (int i = 0; i < count; ++i)
    rows[static_cast<std::size_t>(i)].bound = Matrix7::Identity() * (i % 2 == 0 ? 1.0 : 100.0);
  // erf(m / sqrt(2)) + erf(m / (10 sqrt(2))) = 1. Scatter: sqrt(sum of p (1 - p)) / (sum of densities).
  constexpr double median_of_all = 1.5436;
  const double narrow = std::erf(median_of_all / std::sqrt(2.0)),
               wide = std::erf(median_of_all / std::sqrt(200.0));
  ASSERT_NEAR(narrow + wide, 1, 1e-3);
  const double peak = std::sqrt(2 / M_PI), square = median_of_all * median_of_all / 2;
  const double density = peak * (std::exp(-square) + 0.1 * std::exp(-square / 100)) / 2;
  const double scatter = std::sqrt((narrow * (1 - narrow) + wide * (1 - wide)) / 2 / count) / density;
  const StudyLine line = line_of(summarise(rows, ""), "x");
  EXPECT_NEAR(line.median_bound, median_of_all, 0.1 * scatter + 0.02);
  EXPECT_NEAR(line.median_scatter, scatter, 0.15 * scatter);
}

TEST(StudySummary, OneEventFarOffWidensOnlyTheStandardDeviation) {
  std::vector<StudyRow> rows = gaussian_rows(100);
  const StudyLine before = line_of(summarise(rows, ""), "x");
  rows[3].fit.cascade.position.x() = rows[3].truth.position.x() + 40;
  const StudyLine after = line_of(summarise(rows, ""), "x");
  EXPECT_GT(after.pull.width, 2);
  EXPECT_NEAR(after.pull.core, before.pull.core, 0.05);
}

TEST(StudySummary, SaysHowManyHaveACompetingMinimum) {
  std::vector<StudyRow> rows = gaussian_rows(10);
  rows[2].fit.other_minimum = OtherMinimum{rows[2].truth, 1, 1};
  const StudyTable table = summarise(rows, "ten");
  EXPECT_EQ(table.contested, 1u);
  EXPECT_NE(text_of(table).find("10 of 10 events fitted, 1 with a competing minimum"), std::string::npos);
}

TEST(StudySummary, EventsWithoutResultAreNamedAndLeftOut) {
  std::vector<StudyRow> rows = gaussian_rows(10);
  rows[4].fit.status = FitStatus::not_enough_light;
  rows[4].fit.reason = "8 photoelectrons";
  const StudyTable table = summarise(rows, "ten");
  EXPECT_EQ(table.fitted, 9u);
  ASSERT_EQ(table.failures.size(), 1u);
  EXPECT_EQ(table.failures[0], "10000 GeV event 4: not_enough_light: 8 photoelectrons");
}

}  // namespace
}  // namespace floe
