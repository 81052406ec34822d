#include "reco/ice_fit/held_out_runs.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

// Flashers on strings 1, 2 ... at these heights.
struct Runs {
  Detector detector;
  FlasherData data;
  explicit Runs(const std::vector<double>& heights) : detector("column", modules(heights)) {
    for (std::size_t i = 0; i < heights.size(); ++i) {
      RunData run;
      run.name = std::to_string(i);
      run.run.module = {static_cast<int>(i) + 1, 1};
      data.runs.push_back(run);
    }
  }
  static std::vector<Module> modules(const std::vector<double>& heights) {
    std::vector<Vec3> positions;
    for (const double height : heights) positions.emplace_back(0, 0, height);
    return test::modules_at(positions);
  }
};

// Whatever their order: no two neighbours in depth are held out together, and each run is held out once.
TEST(HeldOutRuns, AreSpreadOverDepth) {
  const Runs runs({100, -300, 200, 0, -400, -100});
  const HeldOutRuns held_out(runs.data, runs.detector, 3);
  std::vector<int> times(6, 0);
  for (int fold = 0; fold < 3; ++fold) {
    for (std::size_t r = 0; r < 6; ++r) times[r] += held_out.holds(r, fold);
    EXPECT_EQ(held_out.rest(runs.data, fold).runs.size(), 4u);
  }
  EXPECT_EQ(times, std::vector<int>(6, 1));
  // From the top: 2, 0, 3, 5, 1, 4.
  EXPECT_TRUE(held_out.holds(2, 0) && held_out.holds(5, 0));
  EXPECT_TRUE(held_out.holds(0, 1) && held_out.holds(1, 1));
  EXPECT_TRUE(held_out.holds(3, 2) && held_out.holds(4, 2));
}

// Two runs of one flasher see the same ice: neither may tell of the other.
TEST(HeldOutRuns, RunsOfOneFlasherStayTogether) {
  Runs runs({0, -50, -100});
  runs.data.runs.push_back(runs.data.runs[1]);
  EXPECT_EQ(flasher_count(runs.data), 3);
  const HeldOutRuns held_out(runs.data, runs.detector, 3);
  for (int fold = 0; fold < 3; ++fold) {
    EXPECT_EQ(held_out.holds(1, fold), held_out.holds(3, fold));
    EXPECT_EQ(held_out.rest(runs.data, fold).runs.size(), held_out.holds(1, fold) ? 2u : 3u);
  }
}

TEST(HeldOutRuns, OneByOneOrAllTogether) {
  const Runs runs({0, -50, -100});
  const HeldOutRuns one_by_one(runs.data, runs.detector, 3);
  for (int fold = 0; fold < 3; ++fold) EXPECT_EQ(one_by_one.rest(runs.data, fold).runs.size(), 2u);
  EXPECT_TRUE(HeldOutRuns(runs.data, runs.detector, 1).rest(runs.data, 0).runs.empty());
}

}  // namespace
}  // namespace floe
