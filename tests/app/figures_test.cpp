// floe figures on the command line, with little light.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/app/floe_runner.h"
#include "tests/app/small_detector.h"
#include "tests/app/wrong_cases.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::json;

class Figures : public ::testing::Test {
 protected:
  Outcome floe_well(const std::string& arguments) const {
    const Outcome outcome = run_floe(folder_.path(), arguments);
    EXPECT_EQ(outcome.code, 0) << "floe " << arguments << "\n" << outcome.err;
    return outcome;
  }
  std::string text_of(const std::string& file) const { return bytes_of(folder_.path() / file); }
  Json json_of(const std::string& file) const { return Json::parse(text_of(file)); }
  TemporaryFolder folder_;
};

struct Number {
  double value, error;
};
Number number_of(const Json& figure, const std::string& of, const std::string& name) {
  for (const Json& number : figure["numbers"])
    if (number["of"] == of && number["name"] == name) return {number["value"], number["error"]};
  ADD_FAILURE() << "no " << name << " of " << of;
  return {0, 1};
}

TEST_F(Figures, OfAzimuthSayHowMuchLightGoesAlongTheFlow) {
  // The built-in ice is dark at these depths: with less absorption a test needs fewer photons.
  const Outcome outcome = floe_well(
      "figures --only azimuth --photons 4e8 --seed 5 --with absorption-scale.factor=0.4 --json same.json -o "
      "made");
  EXPECT_EQ(files_in(folder_.path()), (std::set<std::string>{"made", "made/azimuth.csv", "made/azimuth.svg",
                                                             "made/figures.json", "same.json"}));
  EXPECT_EQ(text_of("same.json"), text_of("made/figures.json"));
  const Json all = json_of("made/figures.json");
  ASSERT_EQ(all["figures"].size(), 1U);
  const Json figure = all["figures"][0];
  EXPECT_EQ(figure["name"], "azimuth");
  EXPECT_EQ(figure["files"], (Json{"azimuth.svg", "azimuth.csv"}));
  const Number same = number_of(figure, "isotropic", "c along the flow"),
               full = number_of(figure, "full ice", "c along the flow");
  EXPECT_NEAR(same.value, 0, 4 * same.error);
  EXPECT_GT(full.value, 4 * full.error);
  const Number phi = number_of(figure, "full ice", "phi");
  EXPECT_NEAR(phi.value, 130, 4 * phi.error);
  EXPECT_NE(outcome.out.find("max/min"), std::string::npos) << outcome.out;

  const std::string picture = text_of("made/azimuth.svg");
  EXPECT_TRUE(picture.starts_with("<svg "));
  for (const char* said : {"isotropic", "absorption anisotropy", "birefringence", "full ice", "[deg]"})
    EXPECT_NE(picture.find(said), std::string::npos) << said;
  const std::string table = text_of("made/azimuth.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 4 * 4 * 6);  // models, flashers, neighbours
}

TEST_F(Figures, OfLightCurvesHaveACurveForEachDescription) {
  floe_well("figures --only light-curves --photons 2e8 --quiet -o made");
  const Json figure = json_of("made/figures.json")["figures"][0];
  for (const char* model : {"isotropic", "birefringence", "birefringence and absorption anisotropy"})
    for (const char* side : {", along the flow", ", across the flow"})
      EXPECT_GT(number_of(figure, std::string(model) + side, "charge for 1e9 photons").value, 0) << model;
  // The built-in ice has no anisotropy of scattering: said, not drawn.
  const std::string picture = text_of("made/light-curves.svg");
  EXPECT_EQ(picture.find("scattering anisotropy"), std::string::npos);
  EXPECT_NE(figure["remarks"].dump().find("scattering anisotropy: the same as isotropic"), std::string::npos);

  floe_well(
      "figures --only light-curves --photons 2e8 --quiet --with scattering-anisotropy.k1=-0.1 -o stretched");
  EXPECT_NE(text_of("stretched/light-curves.svg").find("scattering anisotropy"), std::string::npos);
}

TEST_F(Figures, OfDiffusionHaveTheTwelveNumbers) {
  floe_well("figures --only diffusion --quiet -o made");
  const Json figure = json_of("made/figures.json")["figures"][0];
  ASSERT_EQ(figure["numbers"].size(), 12U);
  // 1000 grains of 1 mm widen light by a few degrees.
  const Number width = number_of(figure, "sigma_x", "A");
  EXPECT_GT(width.value, 0.05);
  EXPECT_LT(width.value, 0.15);
  const std::string table = text_of("made/diffusion.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 19);
  EXPECT_NE(text_of("made/diffusion.svg").find("elongation 1.4"), std::string::npos);
}

TEST_F(Figures, OfLlhSpaceHaveAGridAndItsMinimum) {
  floe_well("figures --only llh-space --photons 1e8 --seed 3 -o made");
  const Json figure = json_of("made/figures.json")["figures"][0];
  const std::string table = text_of("made/llh-space.csv");
  EXPECT_TRUE(table.starts_with("birefringence 2150-2350 m,scattering 2150-2350 m,neg_llh,above_minimum\n"));
  EXPECT_GE(std::count(table.begin(), table.end(), '\n'), 1 + 25);
  const double noise = number_of(figure, "noise", "standard deviation of -ln L").value;
  EXPECT_GT(noise, 0);
  // The data have both factors at 1. The grid is 0.15 wide in scattering at least, and its lowest point is
  // not further from there than noise of a few units of -ln L takes it.
  EXPECT_NEAR(number_of(figure, "minimum", "scattering 2150-2350 m").value, 1, 0.2);
  const std::string picture = text_of("made/llh-space.svg");
  EXPECT_TRUE(picture.starts_with("<svg "));
  for (const char* said : {"birefringence 2150-2350 m", "scattering 2150-2350 m"})
    EXPECT_NE(picture.find(said), std::string::npos) << said;
}

TEST_F(Figures, OfStratigraphyFindWhatWasChanged) {
  floe_well("figures --only stratigraphy --photons 1e8 --seed 3 -o made");
  const Json figure = json_of("made/figures.json")["figures"][0];
  // The data have 1.2 times the absorption and 0.7 times the birefringence, in all four layers.
  double chi_square = 0;
  int layers = 0;
  for (const Json& number : figure["numbers"]) {
    const std::string name = number["name"];
    const double truth = name.starts_with("absorption") ? 1.2 : 0.7;
    const double pull = (number["value"].get<double>() - truth) / number["error"].get<double>();
    chi_square += pull * pull;
    ++layers;
    EXPECT_LT(std::abs(pull), 4) << name;
  }
  EXPECT_EQ(layers, 8);
  EXPECT_LT(chi_square, 26.1);  // one in a thousand for 8
  const std::string picture = text_of("made/stratigraphy.svg");
  for (const char* said : {"depth [m]", "Crystals", "Absorption"})
    EXPECT_NE(picture.find(said), std::string::npos) << said;
  EXPECT_TRUE(text_of("made/stratigraphy.csv").starts_with("depth_m,effective_scattering_length_m,"));
}

TEST_F(Figures, DoNotDependOnThreads) {
  floe_well("figures --only light-curves --photons 1e8 --quiet --threads 1 -o one");
  floe_well("figures --only light-curves --photons 1e8 --quiet --threads 3 -o three");
  for (const char* file : {"light-curves.csv", "light-curves.svg"})
    EXPECT_EQ(text_of(std::string("one/") + file), text_of(std::string("three/") + file)) << file;
}

// With hardly any light, a string sees none.
TEST_F(Figures, WithoutLightAreAnError) {
  expect_error(run_floe(folder_.path(), "figures --only azimuth --photons 1e6 -o made"), 4,
               "more photons are needed");
  EXPECT_TRUE(files_in(folder_.path()).empty());
}

class WrongFigures : public testing::TestWithParam<WrongCase> {};

TEST_P(WrongFigures, AreSaidAndLeaveNothing) {
  const TemporaryFolder folder;
  write_small_detector(folder.path() / "small", 125);
  write_bytes(folder.path() / "taken", "");
  expect_said_and_nothing_left(folder.path(), GetParam());
}

const WrongCase cases[] = {
    {"NoFolder", "", 2, "--output"},
    {"UnknownFigure", "-o made --only azimut", 2, "--only: found figure \"azimut\"; expected one of azimuth"},
    {"NoFigure", "-o made --only azimuth,", 2, "--only: found figure \"\""},
    {"TooFewPhotons", "-o made --photons 3", 2, "--photons"},
    {"FolderIsAFile", "-o taken", 5, "a file of this name exists"},
    {"FolderAboveMissing", "-o no/such", 5, "no"},
    // Its modules hang from 2168 m on.
    {"NoShallowModules", "-o made --only azimuth --detector small", 4, "no string with a module from 1650"},
};

INSTANTIATE_TEST_SUITE_P(CommandLine, WrongFigures, testing::ValuesIn(cases_of("figures ", cases)),
                         name_of_case);

}  // namespace
}  // namespace floe::test
