// floe scan on the command line: one run, few points.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/floe_runner.h"
#include "tests/app/wrong_cases.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::json;

class Scan : public ::testing::Test {
 protected:
  Outcome floe_well(const std::string& arguments) const {
    const Outcome outcome = run_floe(folder_.path(), arguments);
    EXPECT_EQ(outcome.code, 0) << "floe " << arguments << "\n" << outcome.err;
    return outcome;
  }
  std::string text_of(const std::string& file) const { return bytes_of(folder_.path() / file); }
  Json json_of(const std::string& file) const { return Json::parse(text_of(file)); }
  // Modules so wide that 30,000 hits take little light.
  void simulate(const std::string& options) const {
    write_bytes(folder_.path() / "runs.toml", "[[run]]\nmodule = [36, 20]\nphotons = 2e8\n");
    floe_well("simulate --flashers runs.toml --oversize 25 --seed 16 --quiet -o runs.h5 " + options);
  }
  TemporaryFolder folder_;
};

// What does not depend on when and where the command ran.
Json without_times(Json json) {
  for (const char* name : {"command", "seconds"}) json.erase(name);
  return json;
}

TEST_F(Scan, FindsMoreAbsorption) {
  simulate("--with absorption-scale.factor=1.2");
  const Outcome outcome = floe_well(
      "scan runs.h5 --oversize 25 --light 8 --seed 6 --x absorption-scale=1:1.4:3 --y "
      "scattering-scale.factor=0.9:1.1:3 -o map.json --picture map.svg");
  const Json map = json_of("map.json"), minimum = map["minimum"];
  EXPECT_EQ(map["x"]["name"], "absorption-scale.factor");
  EXPECT_EQ(map["x"]["base"], 1);
  EXPECT_EQ(map["x"]["values"], (Json{1.0, 1.2, 1.4}));
  EXPECT_EQ(map["neg_llh"].size(), 3U);
  EXPECT_EQ(map["neg_llh"][0].size(), 3U);
  EXPECT_EQ(map["runs"].size(), 1U);
  EXPECT_NEAR(map["runs"][0]["brightness_photons"].get<double>() / (0.675 * 2e8), 1, 0.25);
  ASSERT_TRUE(minimum["found"]);
  EXPECT_FALSE(minimum["at_edge"]);
  const double x_error = minimum["x_error"], y_error = minimum["y_error"];
  EXPECT_GT(x_error, 0.01);  // about 6000 hits
  EXPECT_LT(x_error, 0.1);
  EXPECT_NEAR(minimum["x"].get<double>(), 1.2, 4 * x_error);
  EXPECT_NEAR(minimum["y"].get<double>(), 1, 4 * y_error);
  EXPECT_GT(map["noise"].get<double>(), 0);
  EXPECT_NE(outcome.out.find("noise of its differences"), std::string::npos) << outcome.out;

  const std::string picture = text_of("map.svg");
  EXPECT_TRUE(picture.starts_with("<svg "));
  for (const char* said : {"absorption-scale.factor", "scattering-scale.factor", "base model", "68%", "95%",
                           "-ln L above the minimum"})
    EXPECT_NE(picture.find(said), std::string::npos) << said;
}

// Long grains turn light more, and so do many small ones: the data tell the two apart badly
// (arXiv:2107.08692).
TEST_F(Scan, OfGrainsTradesSizeForElongation) {
  write_bytes(folder_.path() / "runs.toml",
              "[defaults]\nphotons = 3e8\n[[run]]\nmodule = [36, 20]\n[[run]]\nmodule = [45, 40]\n");
  floe_well(
      "simulate --flashers runs.toml --oversize 50 --quiet -o runs.h5 --with "
      "grains.elongation=1.7,grains.size=0.8");
  floe_well(
      "scan runs.h5 --oversize 50 --light 5 --quiet --x grains.elongation=1:2.4:3 --y grains.size=0.5:1.1:3 "
      "-o map.json");
  const Json map = json_of("map.json");
  EXPECT_EQ(map["x"]["base"], 1.4);
  EXPECT_EQ(map["y"]["unit"], "mm");
  const auto at = [&](int row, int column) { return map["neg_llh"][row][column].get<double>(); };
  const double together = at(0, 0) + at(2, 2), against = at(0, 2) + at(2, 0), noise = map["noise"];
  EXPECT_LT(together + 3 * noise, against);
}

TEST_F(Scan, DoesNotDependOnThreads) {
  simulate("");
  const std::string scan =
      "scan runs.h5 --oversize 50 --light 0.1 --quiet --x absorption-scale=1:1.4:3 --y "
      "flow-azimuth=110:150:3 ";
  EXPECT_EQ(floe_well(scan + "--threads 1 -o one.json").out, "");
  floe_well(scan + "--threads 3 -o three.json");
  EXPECT_EQ(without_times(json_of("one.json")), without_times(json_of("three.json")));
}

TEST_F(Scan, OfALayerTakesTheRunsInside) {
  const std::string near = "FLASHER 63 20\nHIT 63 21 120 405 1.5 0.2 1.5 0.2\n";  // 1780 m
  std::string text = "FLASHER 62 50\nHIT 62 51 120 405 1.5 0.2 1.5 0.2\n" + near;
  for (int i = 0; i < 100; ++i) text += "HIT 63 22 180 405 1.5 0.2 1.5 0.2\n";
  write_bytes(folder_.path() / "runs.hits", text);
  const std::string arguments =
      "scan runs.hits --oversize 100 --light 0.1 --depths 1700,1900 --x absorption=0.9:1.1:3 --y "
      "scattering=0.9:1.1:3 -o map.json";
  const Outcome outcome = floe_well(arguments);
  EXPECT_NE(outcome.out.find("left out: 1 run of flashers beyond 1700 to 1900 m"), std::string::npos)
      << outcome.out;
  const Json map = json_of("map.json");
  EXPECT_EQ(map["runs"].size(), 1U);
  EXPECT_EQ(map["x"]["name"], "absorption 1700-1900 m");
}

TEST_F(Scan, ExamplesOfItsHelpAreUnderstood) {
  std::istringstream help(run_floe(folder_.path(), "scan --help").out);
  int examples = 0;
  for (std::string line; std::getline(help, line);) {
    if (!line.starts_with("  floe ")) continue;
    ++examples;
    expect_error(run_floe(folder_.path(), line.substr(7)), 3, "runs.h5");
  }
  EXPECT_GE(examples, 3);
}

class WrongScan : public testing::TestWithParam<WrongCase> {};

TEST_P(WrongScan, IsSaidAndLeavesNothing) {
  const TemporaryFolder folder;
  write_bytes(folder.path() / "runs.hits", "FLASHER 63 20\nHIT 63 21 120 405 1.5 0.2 1.5 0.2\n");
  expect_said_and_nothing_left(folder.path(), GetParam());
}

const std::string x = "--x absorption-scale=0.8:1.2:3 ", y = "--y scattering-scale=0.8:1.2:3 ",
                  out = "-o map.json ";

const WrongCase cases[] = {
    {"NoAxis", x + out, 2, "--y"},
    {"NoOutput", x + y, 2, "--json"},
    {"AxisWithoutRange", x + out + "--y scattering-scale", 2, "--y: found \"scattering-scale\""},
    {"AxisOfTwoNumbers", x + out + "--y scattering-scale=1:2", 2, "expected NAME=LOW:HIGH:COUNT"},
    {"AxisWithLetter", x + out + "--y scattering-scale=O.5:2:5", 2, "--y: found \"O.5\""},
    {"TwoValues", x + out + "--y scattering-scale=1:2:2", 2, "--y: found \"2\""},
    {"FallingAxis", x + out + "--y scattering-scale=2:1:5", 2, "expected the lower value first"},
    {"BeyondTheLimits", x + out + "--y scattering=0.01:1:5", 2, "expected values from 0.1 to 10"},
    {"UnknownName", x + out + "--y scatering-scale=1:2:5", 2, "did you mean 'scattering-scale'?"},
    {"ManyNumbers", x + out + "--y scattering-layer=1:2:5", 2, "expected one of depth, width, factor"},
    {"SameTwice", x + out + "--y absorption-scale.factor=1:2:3", 2, "named twice"},
    {"DepthsOfNoLayer", x + y + out + "--depths 1700,1900", 2, "--depths"},
    {"DepthsUpwards", x + out + "--y scattering=1:2:5 --depths 1900,1700", 2, "shallower depth first"},
    {"DepthsWithoutIce", x + out + "--y scattering=1:2:5 --depths 100,200", 2, "no row from 100 to 200 m"},
    {"DepthsWithoutFlasher", x + out + "--y scattering=1:2:5 --depths 2300,2400", 4, "no flasher"},
    {"NoCrystals", x + out + "--y birefringence=1:2:5 --without birefringence", 2, "birefringence.strength"},
    {"AllRunsOfNoLayer", x + y + out + "--all-runs", 2, "--depths"},
    {"PictureOfAnotherKind", x + y + out + "--picture map.png", 2, "--picture: found \"map.png\""},
    {"JsonFolderMissing", x + y + "-o no/such/map.json", 5, "no/such"},
    {"PictureFolderMissing", x + y + out + "--picture no/such/map.svg", 5, "no/such"},
};

INSTANTIATE_TEST_SUITE_P(CommandLine, WrongScan, testing::ValuesIn(cases_of("scan runs.hits ", cases)),
                         name_of_case);

}  // namespace
}  // namespace floe::test
