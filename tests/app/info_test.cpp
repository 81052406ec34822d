// floe info: what it prints follows from the model's files.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "propagation/model.h"
#include "tests/app/floe_runner.h"
#include "tests/app/model_directory.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::json;

Json info_of(const std::string& arguments, const TemporaryFolder& folder) {
  const Outcome outcome = run_floe(folder.path(), "info --quiet --json info.json " + arguments);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  return Json::parse(bytes_of(folder.path() / "info.json"));
}

TEST(Info, SaysThatWhatIsBuiltInIsIdealised) {
  const TemporaryFolder folder;
  const Outcome outcome = run_floe(folder.path(), "info");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("south-pole (built in, idealised"), std::string::npos);
  EXPECT_NE(outcome.out.find("ic86 (built in, idealised"), std::string::npos);
  write_model_directory(folder.path() / "my-ice");
  EXPECT_EQ(run_floe(folder.path(), "info --ice my-ice").out.find("idealised"), std::string::npos);
}

TEST(Info, CountsWhatTheFilesHold) {
  const TemporaryFolder folder;
  write_model_directory(folder.path() / "my-ice");
  replace_line(folder.path() / "my-ice" / "hvs-f2k", 7, "1 7 0");
  const Json info = info_of("--ice my-ice", folder);
  EXPECT_EQ(info["detector"]["modules"], 5160);
  EXPECT_EQ(info["detector"]["modules_on"], 5159);
  EXPECT_EQ(info["detector"]["modules_with_cable"], 5160);
  EXPECT_EQ(info["detector"]["modules_tilted"], 0);
  EXPECT_EQ(info["ice"]["name"], "my-ice");
  EXPECT_EQ(info["ice"]["tilt"], "1D");
}

// A layer of 1/e_scattering = b (400/400)^-alpha - A S, and dust plus heat for absorption.
TEST(Info, TableFollowsFromTheLayersNumbers) {
  const TemporaryFolder folder;
  write_model_directory(folder.path() / "my-ice");
  const IceTables tables = read_ice_tables(folder.path() / "my-ice");
  const Json info = info_of("--ice my-ice --step 0.1", folder);
  const double S = info["ice"]["birefringence"]["mean_scattering_per_m"];
  EXPECT_NEAR(S, 0.00246854, 1e-7);
  ASSERT_EQ(info["ice"]["table"].size(), tables.layers.size());
  const std::size_t row = 90;  // below the bubbles
  const IceLayerRow& layer = tables.layers[row];
  const Json& printed = info["ice"]["table"][row];
  const double thermal =
      tables.wavelength.A * std::exp(-tables.wavelength.B / 400) * (1 + 0.01 * layer.temperature_difference);
  EXPECT_NEAR(printed["depth_m"], layer.depth, 1e-6);
  EXPECT_NEAR(printed["effective_scattering_length_m"], 1 / layer.effective_scattering,
              1e-6 / layer.effective_scattering);
  EXPECT_NEAR(printed["without_crystals_m"],
              1 / (layer.effective_scattering - layer.birefringence_strength * S), 1e-3);
  EXPECT_NEAR(printed["absorption_length_m"], 1 / (layer.dust_absorption + thermal), 1e-3);
}

TEST(Info, HashNamesTheNumbersNotTheDirectory) {
  const TemporaryFolder folder;
  write_model_directory(folder.path() / "a");
  write_model_directory(folder.path() / "b");
  const Json a = info_of("--ice a", folder);
  EXPECT_EQ(a["ice"]["hash"], info_of("--ice b", folder)["ice"]["hash"]);
  EXPECT_NE(a["ice"]["hash"], info_of("--ice a --without tilt", folder)["ice"]["hash"]);
}

}  // namespace
}  // namespace floe::test
