// floe fit-ice on the command line: what it leaves behind, what it says of bad data, what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/floe_runner.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class FitIce : public ::testing::Test {
 protected:
  Outcome floe(const std::string& arguments) const { return run_floe(folder_.path(), arguments); }
  Outcome floe_well(const std::string& arguments) const {
    const Outcome outcome = floe(arguments);
    EXPECT_EQ(outcome.code, 0) << "floe " << arguments << "\n" << outcome.err;
    return outcome;
  }
  std::string text_of(const std::string& file) const { return bytes_of(folder_.path() / file); }
  void write(const std::string& file, const std::string& text) const {
    write_bytes(folder_.path() / file, text);
  }
  Json result() const { return Json::parse(text_of("fitted/result.json")); }
  // Two runs, with the options of floe simulate; as text, so that they are easy to spoil.
  void simulate(const std::string& options, const std::string& photons = "3e8") const {
    write("runs.toml",
          "[defaults]\nphotons = " + photons + "\n[[run]]\nmodule = [36, 20]\n[[run]]\nmodule = [45, 40]\n");
    floe_well("simulate --flashers runs.toml --oversize 16 --seed 5 --quiet -o runs.h5 " + options);
    floe_well("export runs.h5 -o runs.hits");
  }
  TemporaryFolder folder_;
};

TEST_F(FitIce, FindsMoreAbsorptionAndLeavesAnIceModelThatIsReadAgain) {
  simulate("--with absorption-scale.factor=1.3");
  const Outcome outcome =
      floe_well("fit-ice runs.h5 --fit absorption-scale --light 2 --least-hits 6000 -o fitted");
  EXPECT_NE(outcome.out.find("absorption-scale.factor"), std::string::npos) << outcome.out;
  const Json found = result();
  const Json& parameter = found["parameters"][0];
  const double value = parameter["value"], error = parameter["error"];
  EXPECT_GT(error, 0.003);  // about 3000 hits
  EXPECT_LT(error, 0.08);
  EXPECT_NEAR(value, 1.3, 4 * error);
  EXPECT_EQ(found["runs"].size(), 2u);
  for (const Json& run : found["runs"])
    EXPECT_NEAR(run["brightness_photons"].get<double>() / (0.675 * 3e8), 1, 0.25);

  EXPECT_EQ(files_in(folder_.path() / "fitted"),
            (std::set<std::string>{"result.json", "stratigraphy.csv", "stratigraphy.svg", "improved-ice",
                                   "improved-ice/CHANGES.txt", "improved-ice/cfg.txt",
                                   "improved-ice/icemodel.dat", "improved-ice/icemodel.par"}));
  // The directory holds the ice that was fitted.
  floe_well("info --ice fitted/improved-ice --detector ic86 --json info.json --quiet");
  const Json info = Json::parse(text_of("info.json"));
  EXPECT_EQ(info["ice"]["hash"], found["fitted_model"]["ice"]["hash"]);
  EXPECT_NE(text_of("fitted/improved-ice/CHANGES.txt").find("absorption-scale.factor"), std::string::npos);
}

// A band of dust, from a start near by.
TEST_F(FitIce, FindsThePlaceOfABand) {
  simulate("--with absorption-layer.depth=1780,absorption-layer.factor=2");
  floe_well(
      "fit-ice runs.h5 --fit absorption-layer.depth,absorption-layer.factor --start "
      "absorption-layer.depth=1795,absorption-layer.factor=1.3 --light 2 "
      "--least-hits 6000 --quiet -o fitted");
  const Json found = result();
  const double truths[] = {1780, 2}, largest_errors[] = {8, 0.4};
  for (int i = 0; i < 2; ++i) {
    const Json& parameter = found["parameters"][i];
    const double value = parameter["value"], error = parameter["error"];
    EXPECT_GT(error, 0) << i;
    EXPECT_LT(error, largest_errors[i]) << i;
    EXPECT_NEAR(value, truths[i], 4 * error) << i;
  }
}

// One of 300 receivers sees half as much: fitted along, it stands out, and the ice is as it was.
TEST_F(FitIce, FindsTheReceiverThatSeesLess) {
  simulate("--with module-efficiency.string=36,module-efficiency.dom=21,module-efficiency.factor=0.5");
  const Outcome outcome = floe_well(
      "fit-ice runs.h5 --fit absorption-scale --light 1 --least-hits 6000 --efficiencies 0.2 -o fitted");
  EXPECT_NE(outcome.out.find("furthest off is 36,21"), std::string::npos) << outcome.out;
  const Json found = result();
  const Json& parameter = found["parameters"][0];
  EXPECT_NEAR(parameter["value"].get<double>(), 1, 4 * parameter["error"].get<double>());
  const auto odd = std::ranges::find_if(found["efficiencies"], [](const Json& receiver) {
    return receiver["string"] == 36 && receiver["dom"] == 21;
  });
  ASSERT_NE(odd, found["efficiencies"].end());
  EXPECT_NEAR((*odd)["factor"].get<double>(), 0.5, 5 * (*odd)["error"].get<double>());
  EXPECT_GT(found["efficiencies"].size(), 100u);
  EXPECT_NE(text_of("fitted/efficiencies.csv").find("\n36,21,"), std::string::npos);
  expect_error(floe("fit-ice runs.h5 --layer-by-layer --efficiencies 0.1 -o new"), 2, "layer by layer");
}

TEST_F(FitIce, TheResultDoesNotDependOnThreads) {
  simulate("");
  const std::string fit =
      "fit-ice runs.h5 --fit absorption,scattering --layers 3 --light 0.5 --least-hits 2000 --quiet ";
  floe_well(fit + "--threads 1 -o one");
  floe_well(fit + "--threads 3 -o fitted");
  const Json one = Json::parse(text_of("one/result.json"));
  EXPECT_EQ(one["parameters"], result()["parameters"]);
  EXPECT_EQ(one["parameters"].size(), 6u);
}

TEST_F(FitIce, LayerByLayerUsesTheFlashersInside) {
  simulate("");
  floe_well(
      "fit-ice runs.h5 --fit absorption,scattering --layers 4 --layer-by-layer --light 0.5 --least-hits 2000 "
      "--quiet -o fitted");
  // The flashers are in the first and in the last of four layers.
  const Json found = result();
  std::vector<std::string> names;
  for (const Json& parameter : found["parameters"]) names.push_back(parameter["name"]);
  EXPECT_EQ(names.size(), 4u);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end())) << found["parameters"].dump();
  EXPECT_EQ(found["runs"].size(), 2u);
  EXPECT_EQ(found["correlation"][0][1], 0);  // other flashers, other layer
  EXPECT_NE(found["correlation"][0][2], 0);  // absorption and scattering of one layer
  expect_error(floe("fit-ice runs.h5 --fit absorption,flow-azimuth --layer-by-layer -o new"), 2, "no layer");
}

TEST_F(FitIce, LeavesOutWhatCannotBeRightAndFitsTheRest) {
  simulate("");
  const std::string good = text_of("runs.hits");
  // A receiver next to a flasher that saw nothing, in any run.
  std::string spoiled;
  std::istringstream lines(good);
  for (std::string line; std::getline(lines, line);)
    if (line.find("HIT 36 21 ") == line.npos) spoiled += line + "\n";
  // A run without light, one of another colour, and a measured one with a receiver that is far too bright.
  spoiled += "FLASHER 50 30 photons=1e8 oversize=16\n";
  spoiled += "FLASHER 51 30 wavelength_nm=340 photons=1e8 oversize=16\nHIT 51 31 200 340 1.5 0.2 1.5 0.2\n";
  spoiled += "FLASHER 26 30 photons=1e8\n";
  for (int i = 0; i < 2000; ++i) spoiled += "HIT 26 31 120 405 1.5 0.2 1.5 0.2\n";
  for (int i = 0; i < 40; ++i) spoiled += "HIT 26 33 330 405 1.5 0.2 1.5 0.2\n";
  write("spoiled.hits", spoiled);
  const Outcome outcome = floe_well(
      "fit-ice spoiled.hits --fit absorption-scale --light 1 --least-hits 2000 --oversize 16 -o fitted");
  const std::string left_out = result()["left_out"].dump();
  for (const char* said : {"run 50,30: no light", "run 51,30: flashes at 340 nm", "36,21:", "dead",
                           "26,31 in run 26,30", "saturated"}) {
    EXPECT_NE(left_out.find(said), std::string::npos) << said << " in " << left_out;
    EXPECT_NE(outcome.out.find(said), std::string::npos) << said << " in " << outcome.out;
  }
  EXPECT_EQ(result()["runs"].size(), 3u);
}

TEST_F(FitIce, LadderRefitsFiveModelsAndHoldsEveryRunOutOnce) {
  simulate("", "2e8");
  const Outcome outcome =
      floe_well("ladder runs.h5 --light 1 --least-hits 1000 --oversize 16 --json ladder.json");
  const Json ladder = Json::parse(text_of("ladder.json"));
  ASSERT_EQ(ladder["models"].size(), 5u);
  double least = 1e300;
  std::string best;
  for (const Json& model : ladder["models"]) {
    ASSERT_EQ(model["held_out_of_runs"].size(), 2u);
    double sum = 0;
    for (const Json& run : model["held_out_of_runs"]) sum += run.get<double>();
    EXPECT_NEAR(model["held_out_neg_llh"].get<double>(), sum, 1e-9 * sum);
    if (sum < least) least = sum, best = model["model"];
    EXPECT_NE(outcome.out.find(model["model"].get<std::string>()), std::string::npos);
    for (const Json& parameter : model["parameters"]) EXPECT_GT(parameter["error"].get<double>(), 0);
  }
  EXPECT_EQ(ladder["best"], best);
  EXPECT_EQ(ladder["models"][0]["parameters"].size(), 2u);  // isotropic: scales of absorption and scattering
  EXPECT_EQ(ladder["models"][4]["parameters"].size(), 4u);
  expect_error(floe("ladder runs.h5 --folds 3"), 2, "2 to 2");
}

TEST_F(FitIce, RefusesWhatMakesNoSense) {
  simulate("");
  const auto refuses = [&](const std::string& arguments, int code, const std::string& said) {
    expect_error(floe("fit-ice " + arguments), code, said);
    EXPECT_FALSE(fs::exists(folder_.path() / "new")) << arguments;
  };
  refuses("runs.h5 --fit absorbtion -o new", 2, "did you mean 'absorption");
  refuses("runs.h5 --fit absorption-layer -o new", 2, "expected one of depth, width, factor");
  refuses("runs.h5 --fit string-efficiency.factor -o new", 2, "fit of its own");
  refuses("runs.h5 --fit angular-acceptance -o new", 2, "changes nothing of the ice");
  refuses("runs.h5 --fit absorption,absorption -o new", 2, "named twice");
  refuses("runs.h5 --depths 2000,1500 -o new", 2, "shallower depth first");
  refuses("runs.h5 --fit absorption-layer.depth,absorption-layer.factor -o new", 2, "Begin elsewhere");
  refuses("runs.h5 --fit absorption --start flow-azimuth.azimuth=100 -o new", 2, "it is not fitted");
  refuses("runs.h5 --fit flow-azimuth --start flow-azimuth.azimuth=1000 -o new", 2, "from -360 to 360");
  refuses("runs.h5 --fit flow-azimuth --start flow-azimuth -o new", 2, "EFFECT.PARAMETER=VALUE");
  refuses("runs.h5 --layers 0 -o new", 2, "--layers");
  refuses("nothing.h5 -o new", 3, "nothing.h5");
  refuses("runs.h5 -o missing/new", 5, "missing");
  fs::create_directory(folder_.path() / "full");
  write("full/file", "kept");
  expect_error(floe("fit-ice runs.h5 -o full"), 5, "not empty");
  EXPECT_EQ(text_of("full/file"), "kept");
  // Events that are no flasher runs.
  floe_well("simulate --cascade 0,0,-300,70,130,1e3 --oversize 10 --quiet -o cascade.h5");
  refuses("cascade.h5 -o new", 3, "cascade.h5: found no flasher run among its 1 events");
}

}  // namespace
}  // namespace floe::test
