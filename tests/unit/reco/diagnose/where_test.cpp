// The region where light is missing, on a made-up survey of a string of modules.
#include "reco/diagnose/where.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "tests/physics/engine/test_scenes.h"

namespace floe::test {
namespace {

constexpr int modules = 12, hits_a_module = 4000;
constexpr double spacing = 25;  // [m], downwards; the last module flashes

class Where : public ::testing::Test {
 protected:
  Where() {
    std::vector<Vec3> positions;
    for (int m = 0; m < modules; ++m) positions.emplace_back(30.0 * (m % 2), 0, -spacing * m);
    model_ = make_model(uniform_tables({25, 100}), positions);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<float> times(0, 400);
    SimulatedRun simulated;
    std::uint64_t photon = 0;
    for (std::uint32_t m = 0; m + 1 < modules; ++m)
      for (int i = 0; i < hits_a_module; ++i) {
        simulated.hits.push_back({m, times(random), 400, {1, 0, 0}, {1, 0, 0}, photon++});
      }
    SurveyRun run;
    run.data.run.module = {modules, 1};
    run.bins = RunBins(simulated.hits, 1, std::vector<char>(modules, 1), {});
    run.scale = 0.5;  // the data have half as much light as the simulation
    run.draws = PhotonDraws(simulated, run.bins, run.scale, false);
    Eigen::VectorXd halves[2] = {Eigen::VectorXd::Zero(run.bins.size()),
                                 Eigen::VectorXd::Zero(run.bins.size())};
    for (const SimulatedHit& hit : simulated.hits)
      halves[hit.photon & 1](run.bins.bin(hit.module, hit.time)) += 1;
    run.counts.simulated = {halves[0], halves[1]};
    run.expected = run.scale * (halves[0] + halves[1]).array();
    run.trust = Eigen::ArrayXd::Ones(run.bins.size());
    run.nuisance = Eigen::MatrixXd::Zero(run.bins.size(), 2);
    run.nuisance.col(0).setOnes();
    run.counts.data = run.expected;
    survey_.bins = run.bins.size();
    survey_.runs.push_back(std::move(run));
  }

  // As the receivers from `first` on, `count` of them, see this share of their light.
  Whereabouts found(int first, int count, double share) {
    SurveyRun& run = survey_.runs[0];
    run.counts = run.draws.draw(random_);
    for (int m = first; m < first + count; ++m) {
      const RunBins::Receiver& receiver = run.bins.receivers()[static_cast<std::size_t>(m)];
      run.counts.data.segment(receiver.first, receiver.bins()) *= share;
    }
    return where_is_the_gap(survey_, axes_of(model_, survey_), {100, 3, 1});
  }
  static const Region& along(const Whereabouts& where, const std::string& axis) {
    return *std::find_if(where.regions.begin(), where.regions.end(),
                         [&](const Region& region) { return region.axis == axis; });
  }

  Model model_;
  Survey survey_;
  std::mt19937_64 random_{11};
};

TEST_F(Where, IsTheDepthAtWhichModulesAreDark) {
  const Whereabouts where = found(3, 2, 0.8);
  const Region& depth = along(where, "depth");
  const double shallow = origin_depth + 3 * spacing, deep = origin_depth + 4 * spacing;
  EXPECT_LE(depth.from, shallow);
  EXPECT_GE(depth.to, deep);
  EXPECT_LE(depth.to - depth.from, 2 * spacing + 25);
  EXPECT_EQ(depth.sign, -1);
  // 20% less there, and brightness, which is free, takes up 2 of 11 modules' share of it.
  EXPECT_NEAR(depth.relative, -0.2 * (1 - 2.0 / 11), 0.03);
  EXPECT_GT(depth.significance, 6);
  EXPECT_NE(depth.sentence.find("less light than the model on modules"), std::string::npos);
  EXPECT_EQ(where.regions.front().sentence.back(), '.');
}

TEST_F(Where, IsAModuleByItsName) {
  const Whereabouts where = found(6, 1, 1.3);
  const Region& module = along(where, "module");
  EXPECT_EQ(module.name, "7,1");
  EXPECT_EQ(module.sign, 1);
  EXPECT_GT(module.significance, 8);
}

// Of light that is as expected, the most significant region of an axis is no more than chance makes it: over
// two standard deviations in one of twenty.
TEST_F(Where, IsNowhereIfNothingIsMissing) {
  int over_two = 0, asked = 0;
  for (int trial = 0; trial < 12; ++trial)
    for (const Region& region : found(0, 0, 1).regions) ++asked, over_two += region.significance > 2;
  ASSERT_GE(asked, 60);
  // Axes share their light: as if 24 were independent, and three of their standard deviations.
  EXPECT_LT(over_two, asked * (0.046 + 3 * std::sqrt(0.046 / 24)));
}

TEST(Axis, SumsTheBinsOfItsCells) {
  Axis axis;
  axis.low = {0, 1}, axis.high = {1, 2};
  axis.cell = {0, 1, -1, 1};
  EXPECT_EQ(axis.sums(Eigen::VectorXd{{1, 2, 4, 8}}), (Eigen::VectorXd{{1, 10}}));
}

TEST(Axis, SaysWhereInWords) {
  Axis azimuth;
  azimuth.axis = "azimuth";
  for (int i = 0; i < 12; ++i) azimuth.low.push_back(15 * i), azimuth.high.push_back(15 * (i + 1));
  EXPECT_EQ(place_text(azimuth, {7, 4}), "towards 105-165 deg and opposite");
  EXPECT_EQ(place_text(azimuth, {11, 3}), "towards 165-210 deg and opposite");  // over the end
  Axis time;
  time.axis = "time";
  for (int i = 0; i < 4; ++i) time.low.push_back(0.25 * i), time.high.push_back(0.25 * (i + 1));
  EXPECT_EQ(place_text(time, {0, 1}), "in the earliest 25% of the light");
  EXPECT_EQ(place_text(time, {1, 2}), "between 25% and 75% of the light");
  EXPECT_EQ(place_text(time, {2, 2}), "in the latest 50% of the light");
}

}  // namespace
}  // namespace floe::test
