// Where the bins of a survey are, seen from the flashers: a few modules at places worked out by hand.
#include "reco/diagnose/axes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "data/base/constants.h"
#include "data/base/vec3.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe::test {
namespace {

Vec3 at_azimuth(double azimuth_deg, double distance, double z) {
  return {distance * std::cos(azimuth_deg * degree), distance * std::sin(azimuth_deg * degree), z};
}

class Axes : public ::testing::Test {
 protected:
  static constexpr int bright = 40, dim = 10;  // hits: four bins and one

  Axes() {
    // Module 1,1 flashes in the first run, 3,1 in the second.
    const std::vector<Vec3> places{{0, 0, 0},
                                   {0, 0, -17},
                                   at_azimuth(20, 100, 60),
                                   at_azimuth(200, 100, -60),
                                   at_azimuth(110, 600, -10)};
    std::vector<Module> all = modules_at(places);
    const ModuleId ids[] = {{1, 1}, {1, 2}, {2, 1}, {3, 1}, {4, 1}};
    for (std::size_t i = 0; i < all.size(); ++i) all[i].id = ids[i];
    model_ = make_model(uniform_tables({}), all);
    add_run({1, 1}, {0, dim, bright, bright, bright});
    add_run({3, 1}, {0, 0, bright, 0, 0});
    axes_ = axes_of(model_, survey_);
  }

  void add_run(ModuleId flasher, const std::vector<int>& hits_of) {
    std::vector<SimulatedHit> hits;
    for (std::uint32_t module = 0; module < hits_of.size(); ++module)
      for (int i = 0; i < hits_of[module]; ++i) {
        SimulatedHit& hit = hits.emplace_back();
        hit.module = module, hit.time = static_cast<float>(i);
      }
    SurveyRun run;
    run.data.run.module = flasher;
    run.bins = RunBins(hits, 1, std::vector<char>(hits_of.size(), 1), {1, dim, 1, 4});
    run.first = survey_.bins;
    survey_.bins += run.bins.size();
    survey_.runs.push_back(std::move(run));
  }

  const Axis& along(const std::string& name) const {
    return *std::find_if(axes_.begin(), axes_.end(), [&](const Axis& axis) { return axis.axis == name; });
  }
  // Low and high edge of the cell of a bin.
  std::pair<double, double> cell_of(const std::string& name, std::size_t bin) const {
    const Axis& axis = along(name);
    const auto at = static_cast<std::size_t>(axis.cell.at(bin));
    return {axis.low.at(at), axis.high.at(at)};
  }

  // First bins of the receivers: 1,2, then 2,1 and 3,1 and 4,1; and 2,1 in the second run.
  static constexpr std::size_t below_ = 0, near_ = 1, opposite_ = 5, far_ = 9, of_second_ = 13;
  Model model_;
  Survey survey_;
  std::vector<Axis> axes_;
};

TEST_F(Axes, HaveAPlaceForEveryBin) {
  ASSERT_EQ(survey_.bins, 17);
  ASSERT_EQ(axes_.size(), 7u);
  for (const Axis& axis : axes_) {
    EXPECT_EQ(axis.cell.size(), 17u) << axis.axis;
    EXPECT_EQ(axis.low.size(), axis.high.size()) << axis.axis;
    EXPECT_LT(*std::max_element(axis.cell.begin(), axis.cell.end()), axis.size()) << axis.axis;
  }
}

TEST_F(Axes, DepthIsOfTheReceiver) {
  const double heights[] = {-17, 60, -60, -10, 60};
  const std::size_t bins[] = {below_, near_, opposite_, far_, of_second_};
  for (int i = 0; i < 5; ++i) {
    const auto [low, high] = cell_of("depth", bins[i]);
    EXPECT_LE(low, origin_depth - heights[i]) << i;
    EXPECT_GT(high, origin_depth - heights[i]) << i;
    EXPECT_EQ(high - low, 25) << i;
  }
}

// Ice looks the same along its flow and against it.
TEST_F(Axes, AzimuthsOfOppositeWaysAreOne) {
  const std::pair<double, double> along_20(15, 30), along_110(105, 120);
  EXPECT_EQ(cell_of("azimuth", near_), along_20);
  EXPECT_EQ(cell_of("azimuth", opposite_), along_20);
  EXPECT_EQ(cell_of("azimuth", of_second_), along_20);
  EXPECT_EQ(cell_of("azimuth", far_), along_110);
  EXPECT_EQ(along("azimuth").cell[below_], -1);  // straight below there is none
  EXPECT_TRUE(along("azimuth").circular);
}

TEST_F(Axes, DistanceIsFromTheFlasherOfTheRun) {
  EXPECT_EQ(cell_of("distance", below_), std::pair(0.0, 40.0));
  EXPECT_EQ(cell_of("distance", near_), std::pair(80.0, 120.0));        // hypot(100, 60) = 117
  EXPECT_EQ(cell_of("distance", of_second_), std::pair(200.0, 240.0));  // hypot(200, 120) = 233
  EXPECT_EQ(cell_of("distance", far_), std::pair(440.0, 480.0));        // the last takes what is beyond
}

TEST_F(Axes, ArrivalAngleTellsAboveFromBelow) {
  EXPECT_EQ(cell_of("arrival angle", near_), std::pair(45.0, 60.0));        // atan2(100, 60) = 59 deg
  EXPECT_EQ(cell_of("arrival angle", opposite_), std::pair(120.0, 135.0));  // 121 deg
  EXPECT_EQ(cell_of("arrival angle", below_), std::pair(165.0, 180.0));
}

// A single bin has early and late light alike.
TEST_F(Axes, TimeIsTheShareOfTheReceiversLight) {
  const Axis& time = along("time");
  EXPECT_EQ(time.cell[below_], -1);
  for (const std::size_t first : {near_, opposite_, far_, of_second_})
    for (int quarter = 0; quarter < 4; ++quarter)
      EXPECT_EQ(time.cell[first + static_cast<std::size_t>(quarter)], quarter);
}

TEST_F(Axes, StringsAndModulesHaveNames) {
  EXPECT_EQ(along("string").names, (std::vector<std::string>{"1", "2", "3", "4"}));
  EXPECT_EQ(along("module").names, (std::vector<std::string>{"1,2", "2,1", "3,1", "4,1"}));
  for (const char* name : {"string", "module"}) {
    EXPECT_FALSE(along(name).ordered);
    // A module is the same whoever flashes.
    EXPECT_EQ(along(name).cell[near_], along(name).cell[of_second_]);
  }
}

TEST_F(Axes, SumsLoseOnlyWhatIsNotOnThem) {
  const Eigen::VectorXd light = Eigen::VectorXd::LinSpaced(17, 1, 17);
  for (const Axis& axis : axes_) {
    const bool all = axis.axis != "azimuth" && axis.axis != "time";  // the module below is on neither
    EXPECT_NEAR(axis.sums(light).sum(), light.sum() - (all ? 0 : light(0)), 1e-9) << axis.axis;
  }
  // 2,1 sees bins 1 to 4 of the first run and all of the second.
  EXPECT_NEAR(along("string").sums(light)(1), 2 + 3 + 4 + 5 + 14 + 15 + 16 + 17, 1e-9);
}

TEST_F(Axes, SayInWordsWhatTheirCellsAre) {
  const auto text = [&](const char* axis, std::size_t bin) {
    return place_text(along(axis), {along(axis).cell[bin], 1});
  };
  EXPECT_EQ(text("depth", below_), "on modules 1950-1975 m deep");  // 1965
  EXPECT_EQ(text("distance", near_), "80-120 m from the flashers");
  EXPECT_EQ(text("azimuth", far_), "towards 105-120 deg and opposite");
  EXPECT_EQ(text("arrival angle", near_), "on modules above their flashers (45-60 deg from the vertical)");
  EXPECT_EQ(text("arrival angle", opposite_), "on modules below their flashers (120-135 deg)");
  EXPECT_EQ(place_text(along("arrival angle"), {4, 4}),
            "60-120 deg from the vertical, seen from the flashers");
  EXPECT_EQ(text("time", near_ + 3), "in the latest 25% of the light");
  EXPECT_EQ(text("string", far_), "on string 4");
  EXPECT_EQ(text("module", below_), "on module 1,2");
}

}  // namespace
}  // namespace floe::test
