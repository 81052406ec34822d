// What is said of a region without light: modules all around a flasher, in two rings, alike but for those
// that a test makes dark.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "data/base/vec3.h"
#include "reco/diagnose/score_test.h"
#include "reco/diagnose/where.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe::test {
namespace {

class GapRegion : public ::testing::Test {
 protected:
  static constexpr int azimuths = 12, rings = 2, quarters = 4, hits_a_bin = 100;
  static constexpr double width_deg = 15;

  // Light that is missing, as a share: by azimuth, ring and quarter of the time.
  using Loss = std::function<double(int azimuth, int ring, int quarter)>;

  // `scale`: counts of the data for a simulated hit. What data and simulation do by chance is left out, so
  // that all that follows is known.
  Whereabouts found(double scale, const Loss& loss) const {
    std::vector<Vec3> places{Vec3::Zero()};  // of the flasher
    SimulatedRun simulated;
    for (int i = 0; i < azimuths * rings; ++i) {
      const double azimuth = (i / rings + 0.5) * width_deg * degree, distance = i % rings == 0 ? 60 : 180;
      places.emplace_back(distance * std::cos(azimuth), distance * std::sin(azimuth), -5);
      for (int h = 0; h < quarters * hits_a_bin; ++h) {
        SimulatedHit& hit = simulated.hits.emplace_back();
        hit.module = static_cast<std::uint32_t>(i + 1), hit.time = static_cast<float>(h);
        hit.photon = simulated.hits.size();
      }
    }
    Survey survey;
    SurveyRun& run = survey.runs.emplace_back();
    run.data.run.module = {1, 1};
    run.bins = RunBins(simulated.hits, 1, std::vector<char>(places.size(), 1), {1, hits_a_bin, 1, quarters});
    survey.bins = run.bins.size();
    run.scale = scale;
    run.draws = PhotonDraws(simulated, run.bins, scale, false);
    const Eigen::VectorXd half = Eigen::VectorXd::Constant(survey.bins, hits_a_bin / 2.0);
    run.counts = {Eigen::VectorXd(survey.bins), {half, half}};
    run.expected = 2 * scale * half;
    run.trust = Eigen::ArrayXd::Ones(survey.bins);
    run.nuisance = Eigen::MatrixXd::Ones(survey.bins, 2);
    for (int b = 0; b < run.bins.size(); ++b) {
      const int module = b / quarters, quarter = b % quarters;
      run.nuisance(b, 1) = quarter - (quarters - 1) / 2.0;  // later light comes in the last quarter
      run.counts.data(b) = run.expected(b) * (1 - loss(module / rings, module % rings, quarter));
    }
    return where_is_the_gap(survey, axes_of(make_model(uniform_tables({}), places), survey), {100, 5, 1});
  }

  // Azimuths 165 to 180 deg and 0 to 30 deg, which are neighbours.
  static bool is_inside(int azimuth) { return azimuth == 11 || azimuth < 2; }
};

// 40% in a quarter of the light, of which the free brightness takes up a quarter: 30% are left. They are
// 0.3 x 600 of 600 counts, whose variance is 600 of the data and half of that of the simulation: 6.0 standard
// deviations at that place, and somewhat less among all places that were looked at.
TEST_F(GapRegion, GoesOnOverTheEndOfACircle) {
  const Whereabouts where = found(0.25, [](int azimuth, int, int) { return is_inside(azimuth) ? 0.4 : 0; });
  ASSERT_FALSE(where.regions.empty());
  const Region& region = where.regions.front();
  EXPECT_EQ(region.axis, "azimuth");
  EXPECT_EQ(region.from, 165);
  EXPECT_EQ(region.to, 30);
  EXPECT_EQ(region.sign, -1);
  EXPECT_NEAR(region.relative, -0.3, 1e-9);
  const double light = 0.25 * 3 * rings * quarters * hits_a_bin, z = 0.3 * light / std::sqrt(1.25 * light);
  EXPECT_LT(region.significance, z);
  // Each azimuth could begin a region of each width up to half of them, had all of these been independent.
  EXPECT_GT(region.significance, sigmas_of(ln_p_of(z) + std::log(azimuths * azimuths / 2.0)) - 0.2);
  EXPECT_EQ(
      region.sentence,
      "The data have 30.0% less light than the model towards 165-210 deg and opposite, timing unchanged.");
}

TEST_F(GapRegion, ProfilesAreTheCellsOfAllAxes) {
  const Whereabouts where = found(0.25, [](int azimuth, int, int) { return is_inside(azimuth) ? 0.4 : 0; });
  ASSERT_EQ(where.profiles.size(), 7u);
  const ResidualProfile& profile = where.profiles[1];
  ASSERT_EQ(profile.axis, "azimuth");
  const double light = 0.25 * rings * quarters * hits_a_bin;
  for (int i = 0; i < azimuths; ++i) {
    EXPECT_NEAR(profile.relative[static_cast<std::size_t>(i)], is_inside(i) ? -0.3 : 0.1, 1e-9) << i;
    EXPECT_NEAR(profile.error[static_cast<std::size_t>(i)], std::sqrt(1.25 / light), 1e-9) << i;
  }
}

TEST_F(GapRegion, SaysHowItGoesWithDistance) {
  const auto sentence = [&](double near, double far) {
    return found(0.5, [&](int azimuth, int ring,
                          int) { return is_inside(azimuth) ? (ring == 0 ? near : far) : 0; })
        .regions.front()
        .sentence;
  };
  const std::string place = "towards 165-210 deg and opposite";
  EXPECT_NE(sentence(0.15, 0.5).find(place + ", growing with distance, timing unchanged."),
            std::string::npos);
  EXPECT_NE(sentence(0.5, 0.15).find(place + ", fading with distance, timing unchanged."), std::string::npos);
  EXPECT_EQ(sentence(0.3, 0.3).find("distance"), std::string::npos);
  // More light than expected may grow as well.
  EXPECT_NE(sentence(-0.15, -0.5).find("more light than the model " + place + ", growing with distance"),
            std::string::npos);
}

TEST_F(GapRegion, SaysWhichLightIsMissing) {
  const auto sentence = [&](double early, double late) {
    return found(0.5,
                 [&](int azimuth, int, int quarter) {
                   return is_inside(azimuth) ? (quarter < quarters / 2 ? early : late) : 0;
                 })
        .regions.front()
        .sentence;
  };
  EXPECT_NE(sentence(0.1, 0.6).find("opposite, most in late light."), std::string::npos);
  EXPECT_NE(sentence(0.6, 0.1).find("opposite, most in early light."), std::string::npos);
}

TEST_F(GapRegion, IsNoneWhereHardlyAnyLightIsExpected) {
  const Whereabouts where = found(1e-3, [](int azimuth, int, int) { return is_inside(azimuth) ? 1 : 0; });
  EXPECT_TRUE(where.regions.empty());
  EXPECT_EQ(where.profiles.size(), 7u);
}

}  // namespace
}  // namespace floe::test
