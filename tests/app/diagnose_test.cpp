// floe diagnose on the command line: it names what was hidden, and nothing where nothing was.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/floe_runner.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::json;

class Diagnose : public ::testing::Test {
 protected:
  Outcome floe(const std::string& arguments) const { return run_floe(folder_.path(), arguments); }
  std::string text_of(const std::string& file) const { return bytes_of(folder_.path() / file); }
  // Two small runs in the built-in ice, with the options of floe simulate.
  void simulate(const std::string& options, const std::string& more_runs = "") const {
    write_bytes(
        folder_.path() / "runs.toml",
        "[defaults]\nphotons = 2.5e8\n[[run]]\nmodule = [36, 20]\n[[run]]\nmodule = [45, 40]\n" + more_runs);
    const Outcome outcome =
        floe("simulate --flashers runs.toml --oversize 16 --seed 5 --quiet -o runs.h5 " + options);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  Json diagnosis() const {
    const Outcome outcome = floe("diagnose runs.h5 --least-hits 1000 --folds 2 -o found --json copy.json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(text_of("found/result.json"), text_of("copy.json"));
    return Json::parse(text_of("copy.json"));
  }
  std::string hash_of(const std::string& ice) const {
    floe("info --detector ic86 --quiet --json info.json --ice " + ice);
    return Json::parse(text_of("info.json"))["ice"]["hash"];
  }
  TemporaryFolder folder_;
};

// The built-in ice has k1 = 0.6: what it has too much of is as wrong as what it lacks.
TEST_F(Diagnose, NamesWhatWasHidden) {
  simulate("--with absorption-anisotropy.k1=0");
  const Json found = diagnosis();
  ASSERT_FALSE(found["verdict"].empty());
  ASSERT_EQ(found["verdict"][0], "absorption-anisotropy") << found["steps"][0]["scores"].dump(1);
  EXPECT_EQ(found["groups"]["absorption-anisotropy"][0], "absorption-anisotropy");
  // With so little light the data may not tell it from the other anisotropy: then they are a group.
  EXPECT_LE(found["groups"]["absorption-anisotropy"].size(), 2u);
  const Json& k1 = found["effects"][0]["parameters"]["k1"];
  const double value = k1["value"], error = k1["error"];
  EXPECT_GT(error, 0.01);
  EXPECT_LT(error, 0.15);
  EXPECT_NEAR(value, 0, 4 * error);
  EXPECT_LT(found["p_value"].get<double>(), 1e-4);
  EXPECT_GT(found["gap_before"].get<double>(), 10);
  EXPECT_GT(found["closed"].get<double>(), 0.5);
  EXPECT_EQ(found["gaps"].size(), 2u);
  EXPECT_GT(found["p_of_rest"].get<double>(), 0.005);
  EXPECT_NE(found["verdict"].back(), "unexplained");

  EXPECT_FALSE(found["where"].empty());
  EXPECT_NE(text_of("found/report.html").find("Missing: absorption-anisotropy"), std::string::npos);
  EXPECT_NE(hash_of("found/improved-ice"), hash_of("south-pole"));
  EXPECT_EQ(hash_of("found/improved-ice"), found["improved_model"]["ice"]["hash"]);
}

TEST_F(Diagnose, IsSilentWhereNothingIsMissing) {
  simulate("", "[[run]]\nmodule = [27, 30]\nphotons = 1e6\n");
  const Json found = diagnosis();
  EXPECT_EQ(found["left_out"], Json::array({"run 27,30: no receiver sees enough light to be compared"}));
  EXPECT_EQ(found["gaps"].size(), 2u);
  EXPECT_TRUE(found["verdict"].empty()) << found["verdict"].dump() << found["steps"][0]["scores"].dump(1);
  EXPECT_TRUE(found["effects"].empty());
  EXPECT_GT(found["p_value"].get<double>(), 0.01);
  EXPECT_EQ(found["gap_before"], found["gap_after"]);
  EXPECT_TRUE(found["p_of_rest"].is_null());
  EXPECT_EQ(hash_of("found/improved-ice"), found["base_model"]["ice"]["hash"]);
  EXPECT_NE(text_of("found/report.html").find("Nothing is missing"), std::string::npos);
}

TEST_F(Diagnose, IsPutToTheTestByBlindTrials) {
  write_bytes(folder_.path() / "runs.toml",
              "[defaults]\nphotons = 1.5e8\n[[run]]\nmodule = [36, 20]\n[[run]]\nmodule = [45, 40]\n");
  const std::string command =
      "blind-trials runs.toml --trials 1 --nothing 2 --least 8 --most 15 --seed 3 --light 2 --full-nothing 1 "
      "--least-hits 1000 "
      "--sealed sealed.json --rows rows.jsonl --json ";
  const Outcome outcome = floe(command + "trials.json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Right name or group: "), std::string::npos);
  int hidden = 0, right = 0;
  const Json found = Json::parse(text_of("trials.json"));
  for (const Json& trial : found["trials"]) {
    const Json& secret = trial["hidden"];
    if (secret["effect"] == "") {
      EXPECT_EQ(trial["named"]["effect"], "");
      continue;
    }
    EXPECT_GE(secret["expected_significance"].get<double>(), 8);
    EXPECT_FALSE(secret["values"].empty());
    ++hidden, right += trial["right"].get<bool>();
  }
  EXPECT_GE(hidden, 4);
  EXPECT_TRUE(found["not_tried"].contains("noise")) << found["not_tried"].dump();
  const Json sealed = Json::parse(text_of("sealed.json"));
  ASSERT_EQ(sealed["trials"].size(), found["trials"].size());
  for (std::size_t i = 0; i < sealed["trials"].size(); ++i)
    EXPECT_EQ(sealed["trials"][i], found["trials"][i]["hidden"]);
  // Whole diagnoses, of nothing here: those of effects take longer.
  ASSERT_EQ(found["full"].size(), 1u);
  EXPECT_TRUE(found["full"][0]["verdict"].empty()) << found["full"].dump();
  EXPECT_TRUE(found["full"][0]["right"]);
  EXPECT_GE(right, hidden / 2.0) << outcome.out;
  EXPECT_EQ(floe("blind-trials runs.toml --least 5 --most 4").code, 2);
  expect_error(floe("blind-trials runs.toml --effects tilt,tild"), 2,
               "no effect 'tild'; did you mean 'tilt'?");

  // The same command again takes what it has kept, and another one does not.
  const std::string rows = text_of("rows.jsonl");
  ASSERT_EQ(floe(command + "again.json").code, 0);
  EXPECT_EQ(text_of("rows.jsonl"), rows);
  const Json again = Json::parse(text_of("again.json"));
  EXPECT_EQ(again["trials"], found["trials"]);
  EXPECT_EQ(again["full"], found["full"]);
  expect_error(floe(command + "other.json --alpha 0.02"), 2,
               "rows.jsonl: found rows of a run with alpha 0.01");
}

// Exit code 4 writes --json with the reason, and nothing else.
TEST_F(Diagnose, SaysInJsonWhyThereIsNoResult) {
  write_bytes(folder_.path() / "dark.hits", "FLASHER 36 20 photons=1000 oversize=16\n");
  const Outcome outcome = floe("diagnose dark.hits -o found --quiet --json copy.json");
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  const Json why = Json::parse(text_of("copy.json"));
  EXPECT_EQ(why["status"], "no_result");
  EXPECT_NE(outcome.err.find(why["reason"].get<std::string>()), std::string::npos) << outcome.err;
  EXPECT_EQ(files_in(folder_.path()).size(), 2u);
}

// Simulations are as wide as the data unless they are told not to be.
TEST_F(Diagnose, SimulatesModulesAsWideAsTheDatas) {
  write_bytes(folder_.path() / "runs.hits",
              "FLASHER 36 20 photons=1000 oversize=16\nHIT 36 21 100 405 1.5 0.2 1.5 0.2\nFLASHER 45 40 "
              "photons=1000 oversize=5\n"
              "HIT 45 41 100 405 1.5 0.2 1.5 0.2\n");
  expect_error(floe("diagnose runs.hits -o found"), 3, "simulated with oversize 5, a run before it with 16");
}

TEST_F(Diagnose, SaysWhatIsWrongWithWhatItIsGiven) {
  expect_error(floe("diagnose none.h5 -o found"), 3, "none.h5");
  EXPECT_EQ(floe("diagnose runs.h5 -o found --alpha 2").code, 2);
  EXPECT_TRUE(files_in(folder_.path()).empty());
}

}  // namespace
}  // namespace floe::test
