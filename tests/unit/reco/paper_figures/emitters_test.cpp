#include "reco/paper_figures/emitters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "data/base/constants.h"
#include "data/base/error.h"

namespace floe {
namespace {

// A string's modules every 20 m from 1600 to 1900 m depth.
void add_string(std::vector<Module>& modules, int string, double x, double y) {
  for (int dom = 1; dom <= 16; ++dom) {
    Module module;
    module.id = {string, dom};
    module.position = {x, y, origin_depth - (1580 + 20 * dom)};
    modules.push_back(module);
  }
}

// String 10 in the middle, strings 1 to 6 at 60, 120, ..., 360 degrees.
std::vector<Module> ring(double radius) {
  std::vector<Module> modules;
  for (int string = 1; string <= 6; ++string)
    add_string(modules, string, radius * std::cos(string * pi / 3), radius * std::sin(string * pi / 3));
  add_string(modules, 10, 0, 0);
  return modules;
}

TEST(Emitters, StandInTheMiddleOfARing) {
  const Detector detector("ring", ring(125));
  const auto emitters = choose_emitters(detector);
  ASSERT_EQ(emitters.size(), 1U);  // the outer strings have three neighbours
  const Emitter& emitter = emitters.front();
  EXPECT_EQ(emitter.module, (ModuleId{10, 7}));  // 1720 m: nearest to the middle of 1650 to 1800 m
  EXPECT_EQ(text_of(emitter), "10,7 at 1720 m");
  ASSERT_EQ(emitter.neighbours.size(), 6U);
  for (int k = 0; k < 6; ++k) {
    const Neighbour& neighbour = emitter.neighbours[static_cast<std::size_t>(k)];
    EXPECT_NEAR(neighbour.distance, 125, 1e-9);
    EXPECT_EQ(neighbour.modules.size(), 7U);  // 1660 to 1780 m
    for (const std::uint32_t module : neighbour.modules)
      EXPECT_EQ(detector.modules()[module].id.string, neighbour.string);
  }
  // By azimuth from 0: string 6 stands at 360 degrees, which may come out as a hair less.
  std::set<int> strings;
  for (std::size_t k = 1; k < 6; ++k)
    EXPECT_GT(emitter.neighbours[k].azimuth, emitter.neighbours[k - 1].azimuth);
  for (const Neighbour& neighbour : emitter.neighbours) strings.insert(neighbour.string);
  EXPECT_EQ(strings, (std::set<int>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(narrowed(emitter, 20, detector).neighbours[0].modules.size(), 3U);
}

TEST(Emitters, ModulesThatAreOffDoNotCount) {
  std::vector<Module> modules = ring(125);
  for (Module& module : modules)
    if (module.id == ModuleId{10, 7} || module.id == ModuleId{3, 8}) module.on = false;
  const Emitter emitter = choose_emitters({"ring", modules}).front();
  EXPECT_EQ(emitter.module, (ModuleId{10, 8}));
  for (const Neighbour& neighbour : emitter.neighbours)
    EXPECT_EQ(neighbour.modules.size(), neighbour.string == 3 ? 6U : 7U);
}

TEST(Emitters, OfOtherRingsAreRefused) {
  std::vector<Module> gap = ring(125), crowd = ring(125), deep = ring(125);
  std::erase_if(gap, [](const Module& module) { return module.id.string == 2; });
  add_string(crowd, 11, 60, 0);
  for (Module& module : deep) module.position.z() -= 400;
  for (const auto& modules : {ring(90), ring(160), gap, crowd, deep})
    EXPECT_THROW(choose_emitters({"no ring", modules}), NoResult);
}

TEST(Emitters, OfTheBuiltInDetectorAreSpreadOverStringsAndDepths) {
  const Detector detector = ic86_detector();
  const auto emitters = choose_emitters(detector);
  ASSERT_EQ(emitters.size(), 4U);
  double depth = 1650;
  std::set<int> strings;
  for (const Emitter& emitter : emitters) {
    EXPECT_GT(emitter.depth, depth);  // deeper and deeper
    depth = emitter.depth;
    strings.insert(emitter.module.string);
    EXPECT_EQ(emitter.neighbours.size(), 6U);
    for (const Neighbour& neighbour : emitter.neighbours) {
      EXPECT_NEAR(neighbour.distance, 125, 0.01);
      EXPECT_LT(neighbour.string, 79);  // not in DeepCore
      EXPECT_GE(neighbour.modules.size(), 6U);
      for (const std::uint32_t module : neighbour.modules)
        EXPECT_LE(std::abs(detector.modules()[module].position.z() - origin_depth + emitter.depth), 60);
    }
  }
  EXPECT_LT(depth, 1800);
  EXPECT_EQ(strings.size(), 4U);
}

TEST(Emitters, FlashAsARing) {
  const Emitter emitter = choose_emitters({"ring", ring(125)}).front();
  const RunRequest request = ring_flash(emitter, 1e8, 3, 4, 2);
  EXPECT_EQ(request.run.module, emitter.module);
  EXPECT_EQ(request.run.leds.kind, LedPattern::Kind::ring);
  EXPECT_NEAR(request.photons, 0.680 * 0.992 * 1e8, 1);
  EXPECT_EQ(request.seed, 3U);
  EXPECT_EQ(request.stream, 4U);
  EXPECT_EQ(request.threads, 2);
}

}  // namespace
}  // namespace floe
