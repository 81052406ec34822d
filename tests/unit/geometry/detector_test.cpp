#include "geometry/detector.h"

#include <gtest/gtest.h>

#include "data/base/constants.h"
#include "data/base/error.h"

namespace floe {
namespace {

Module module_at(int string, int dom, Vec3 position) {
  Module module;
  module.id = {string, dom};
  module.position = position;
  return module;
}

TEST(Detector, SortsModulesAndFindsThem) {
  const Detector detector("two", {module_at(2, 1, {10, 0, 0}), module_at(1, 5, {0, 0, 3})});
  EXPECT_EQ(detector.modules()[0].id, (ModuleId{1, 5}));
  EXPECT_EQ(detector.find({2, 1}), std::size_t{1});
  EXPECT_EQ(detector.find({2, 2}), std::nullopt);
  EXPECT_EQ(detector.index_of({1, 5}), 0U);
}

TEST(Detector, NamesTheUnknownModule) {
  const Detector detector("one", {module_at(1, 1, {0, 0, 0})});
  try {
    detector.index_of({63, 20});
    FAIL() << "an unknown module was found";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("module 63,20"), std::string::npos) << error.what();
  }
}

TEST(Detector, RejectsWhatCannotBe) {
  EXPECT_THROW(Detector("none", {}), InputError);
  EXPECT_THROW(Detector("twice", {module_at(1, 1, {0, 0, 0}), module_at(1, 1, {0, 0, 9})}), InputError);
  EXPECT_THROW(Detector("nan", {module_at(1, 1, {0, 0, std::nan("")})}), InputError);
  Module dark = module_at(1, 1, {0, 0, 0});
  dark.relative_efficiency = 0;
  EXPECT_THROW(Detector("dark", {dark}), InputError);
  EXPECT_THROW(Detector("hole of no string", {module_at(1, 1, {0, 0, 0})}, {{2, {0, 0}}}), InputError);
}

TEST(Detector, RejectsOverlappingModulesInAnyDirection) {
  const double touching = 2 * module_radius;
  for (const Vec3& axis :
       {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, -2, 3), Vec3(-0.3141, 0.5377, 0)}) {
    const Vec3 away = axis.normalized();
    const auto pair_at = [&](double distance) {
      return Detector("pair", {module_at(1, 1, {400, -300, 200}),
                               module_at(7, 9, Vec3(400, -300, 200) + distance * away)});
    };
    EXPECT_THROW(pair_at(touching - 1e-6), InputError);
    EXPECT_NO_THROW(pair_at(touching + 1e-6));
  }
}

TEST(Detector, StringsStandAtTheirMeanUnlessTold) {
  const std::vector<Module> modules{module_at(1, 1, {0, 2, 0}), module_at(1, 2, {1, 4, 9}),
                                    module_at(2, 1, {50, 0, 0})};
  const Detector detector("strings", modules, {{2, {51, 1}}});
  EXPECT_EQ(detector.strings().at(1), Eigen::Vector2d(0.5, 3));
  EXPECT_EQ(detector.strings().at(2), Eigen::Vector2d(51, 1));
}

TEST(Detector, LargestEfficiencyIsOfModulesThatAreOn) {
  Module off = module_at(1, 1, {0, 0, 0}), on = module_at(1, 2, {0, 0, 10});
  off.relative_efficiency = 1.35;
  off.on = false;
  on.relative_efficiency = 0.9;
  EXPECT_EQ(Detector("d", {off, on}).largest_relative_efficiency(), 0.9);
  EXPECT_EQ(Detector("d", {off}).largest_relative_efficiency(), 0);
}

TEST(Detector, HashNamesTheContentNotTheName) {
  const auto hash = [](const char* name, auto change) {
    Module module = module_at(1, 1, {1, 2, 3});
    change(module);
    return Detector(name, {module}).hash();
  };
  const std::string base = hash("a", [](Module&) {});
  EXPECT_EQ(hash("b", [](Module&) {}), base);
  EXPECT_NE(hash("a", [](Module& m) { m.position.x() += 1e-9; }), base);
  EXPECT_NE(hash("a", [](Module& m) { m.on = false; }), base);
  EXPECT_NE(hash("a", [](Module& m) { m.cable_azimuth = 0; }), base);
  EXPECT_NE(hash("a", [](Module& m) { m.high_qe_spectrum = true; }), base);
  EXPECT_NE(hash("a", [](Module& m) { m.up_axis = -Vec3::UnitZ(); }), base);
}

TEST(Detector, ExtentHoldsAllModules) {
  const Detector detector("d", {module_at(1, 1, {1, -2, 3}), module_at(1, 2, {-4, 5, -6})});
  EXPECT_EQ(detector.extent().low, Vec3(-4, -2, -6));
  EXPECT_EQ(detector.extent().high, Vec3(1, 5, 3));
}

double horizontal_distance(const Detector& detector, int a, int b) {
  return (detector.strings().at(a) - detector.strings().at(b)).norm();
}

TEST(Ic86, HasThePublishedNumbers) {
  const Detector detector = ic86_detector();
  EXPECT_EQ(detector.size(), 5160U);
  EXPECT_EQ(detector.strings().size(), 86U);
  EXPECT_EQ(detector.largest_relative_efficiency(), 1.35);
  int high = 0;
  for (const Module& module : detector.modules()) high += module.relative_efficiency > 1;
  EXPECT_EQ(high, 8 * 60);
  EXPECT_NEAR(detector.extent().high.z(), origin_depth - 1450, 3);
  EXPECT_NEAR(detector.extent().low.z(), origin_depth - 2450, 3);
}

TEST(Ic86, GridStringsAre125MetresFromTheirNeighbours) {
  const Detector detector = ic86_detector();
  for (int a = 1; a <= 78; ++a) {
    int neighbours = 0;
    for (int b = 1; b <= 78; ++b) {
      if (a == b) continue;
      const double distance = horizontal_distance(detector, a, b);
      EXPECT_GE(distance, 125 - 1e-9);
      neighbours += distance < 126;
    }
    EXPECT_GE(neighbours, 2) << "string " << a;
    EXPECT_LE(neighbours, 6) << "string " << a;
  }
}

// arXiv:1109.6096: DeepCore is built around string 36, whose neighbours are 26, 27, 35, 37, 45, 46.
TEST(Ic86, NumberingPutsDeepCoreAroundString36) {
  const Detector detector = ic86_detector();
  for (const int neighbour : {26, 27, 35, 37, 45, 46})
    EXPECT_NEAR(horizontal_distance(detector, 36, neighbour), 125, 1e-9);
  for (int string = 81; string <= 86; ++string) EXPECT_NEAR(horizontal_distance(detector, 36, string), 72, 1);
  for (int string = 79; string <= 80; ++string) EXPECT_NEAR(horizontal_distance(detector, 36, string), 42, 1);
}

TEST(Ic86, ModulesHangAtTheirSpacing) {
  const Detector detector = ic86_detector();
  const auto z = [&](int string, int dom) {
    return detector.modules()[detector.index_of({string, dom})].position.z();
  };
  for (int dom = 1; dom < 60; ++dom) {
    EXPECT_NEAR(z(1, dom) - z(1, dom + 1), 17.02, 1e-9);
    if (dom != 10) {
      EXPECT_NEAR(z(86, dom) - z(86, dom + 1), dom < 10 ? 10 : 7, 1e-9);
    }
  }
  EXPECT_LT(z(86, 11), origin_depth - 2100);  // below the dust layer
  EXPECT_GT(z(86, 10), origin_depth - 1860);  // above it
}

// Rows run at an azimuth of about 9.3 deg: string 6 stands 5 spacings from string 1 along it.
TEST(Ic86, RowsRunAlongTheirAzimuth) {
  const Detector detector = ic86_detector();
  const Eigen::Vector2d row = detector.strings().at(6) - detector.strings().at(1);
  EXPECT_NEAR(row.norm(), 5 * 125, 1e-9);
  EXPECT_NEAR(std::atan2(row.y(), row.x()) / degree, 9.3, 1e-9);
}

}  // namespace
}  // namespace floe
