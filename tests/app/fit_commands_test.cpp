// floe reconstruct and floe compare on a small event, with little effort: what they write, and what they
// say when there is no result.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/floe_runner.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::json;

void simulate(const TemporaryFolder& folder, const std::string& energy) {
  const Outcome outcome =
      run_floe(folder.path(), "simulate --cascade 20,-40,-300,70,130," + energy + " -o event.h5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
}

Json json_in(const TemporaryFolder& folder, const std::string& file) {
  return Json::parse(bytes_of(folder.path() / file));
}

// Every run took other time.
Json without_seconds(Json json) {
  for (Json& event : json["events"]) {
    event.erase("seconds");
    event["fit"].erase("seconds");
  }
  return json;
}

void expect_covariance(const Json& fit) {
  const Json& covariance = fit["covariance"];
  ASSERT_EQ(covariance.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) {
    ASSERT_EQ(covariance[i].size(), 7u);
    EXPECT_GT(covariance[i][i].get<double>(), 0);
    for (std::size_t j = 0; j < i; ++j) {
      const double one = covariance[i][j], other = covariance[j][i];
      EXPECT_NEAR(one, other, 1e-9 * (std::abs(one) + 1));
    }
  }
}

// What --profile and --skymap add.
void expect_profile_and_map(const Json& fit) {
  for (const char* key : {"x", "y", "z", "time_ns", "zenith_deg", "azimuth_deg", "energy_gev"}) {
    const Json& interval = fit["profile"][key];
    EXPECT_LT(interval[0].get<double>(), fit[key].get<double>()) << key;
    EXPECT_GT(interval[1].get<double>(), fit[key].get<double>()) << key;
  }
  const double half = fit["sky_map"]["area_50_deg2"], most = fit["sky_map"]["area_90_deg2"];
  EXPECT_GT(half, 0);
  EXPECT_GT(most, half);
  EXPECT_EQ(fit["sky_map"]["errors_are_wider"], fit["errors_beyond_likelihood"]);
}

// Within five of its own standard errors.
void expect_near_truth(const Json& fit, const char* key, std::size_t index, double truth) {
  const double error = std::sqrt(fit["covariance"][index][index].get<double>());
  EXPECT_NEAR(fit[key].get<double>(), truth, 5 * error) << key;
}

TEST(Reconstruct, FindsTheSimulatedCascadeAndSaysSoInJson) {
  const TemporaryFolder folder;
  simulate(folder, "300");
  const Outcome outcome = run_floe(
      folder.path(),
      "reconstruct event.h5 --effort 0.05 --json fit.json --profile --skymap map.h5 --skymap-picture "
      "map.svg");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const Json event = json_in(folder, "fit.json")["events"].at(0);
  EXPECT_EQ(event["event"], "cascade");
  EXPECT_EQ(event["status"], "ok");
  EXPECT_GT(event["seconds"].get<double>(), 0);
  const Json& fit = event["fit"];
  expect_covariance(fit);
  expect_near_truth(fit, "x", 0, 20);
  expect_near_truth(fit, "y", 1, -40);
  expect_near_truth(fit, "z", 2, -300);
  expect_near_truth(fit, "time_ns", 3, 0);
  expect_near_truth(fit, "zenith_deg", 4, 70);
  expect_near_truth(fit, "azimuth_deg", 5, 130);
  expect_near_truth(fit, "energy_gev", 6, 300);
  for (const char* key : {"neg_llh", "ndof", "p_value"}) EXPECT_TRUE(fit[key].is_number()) << key;
  const double of_simulations = fit["simulation_errors"]["x"];
  EXPECT_GT(of_simulations, 0);
  EXPECT_LT(of_simulations, std::sqrt(fit["covariance"][0][0].get<double>()));
  expect_profile_and_map(fit);
  EXPECT_GT(bytes_of(folder.path() / "map.h5").size(), 1000u);
  EXPECT_NE(bytes_of(folder.path() / "map.svg").find("90%"), std::string::npos);
}

TEST(Reconstruct, DoesNotDependOnThreads) {
  const TemporaryFolder folder;
  simulate(folder, "300");
  const std::string command = "reconstruct event.h5 --quiet --effort 0.02 ";
  const Outcome one = run_floe(folder.path(), command + "--threads 1 --json one.json");
  const Outcome two = run_floe(folder.path(), command + "--threads 2 --json two.json");
  EXPECT_EQ(one.code, two.code);
  EXPECT_EQ(one.out, "");
  EXPECT_EQ(without_seconds(json_in(folder, "one.json")), without_seconds(json_in(folder, "two.json")));
}

TEST(Reconstruct, OfTooLittleLightHasNoResultAndSaysWhy) {
  const TemporaryFolder folder;
  write_bytes(folder.path() / "event.hits", "HIT 20 30 100.0 400.0 1.5 0.5 1.5 0.5\n");
  const Outcome outcome = run_floe(folder.path(), "reconstruct event.hits --quiet --json fit.json");
  expect_error(outcome, 4, "not enough light");
  const Json event = json_in(folder, "fit.json")["events"].at(0);
  EXPECT_EQ(event["status"], "not_enough_light");
  EXPECT_NE(event["reason"].get<std::string>().find("not enough light"), std::string::npos);
  EXPECT_TRUE(event["fit"]["x"].is_null());
}

TEST(Compare, WritesBothFitsTheirDifferenceAndAPicture) {
  const TemporaryFolder folder;
  simulate(folder, "1000");
  const Outcome outcome = run_floe(
      folder.path(), "compare event.h5 --without birefringence --effort 0.2 --json both.json -o both.svg");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json event = json_in(folder, "both.json")["events"].at(0);
  ASSERT_EQ(event["fits"].size(), 2u);
  for (const Json& fit : event["fits"]) {
    EXPECT_EQ(fit["status"], "ok");
    expect_covariance(fit);
    expect_near_truth(fit, "energy_gev", 6, 1000);
  }
  EXPECT_NE(event["fits"][0]["ice"]["hash"], event["fits"][1]["ice"]["hash"]);
  EXPECT_TRUE(event["delta_neg_llh"].is_number());
  EXPECT_NE(outcome.out.find("B: south-pole without birefringence"), std::string::npos);
  const std::string picture = bytes_of(folder.path() / "both.svg");
  EXPECT_NE(picture.find("<svg"), std::string::npos);
  EXPECT_NE(picture.find("</svg>"), std::string::npos);
  EXPECT_NE(picture.find("south-pole without birefringence"), std::string::npos);
}

TEST(Compare, OfTooLittleLightHasNoResultAndNoPicture) {
  const TemporaryFolder folder;
  write_bytes(folder.path() / "event.hits", "HIT 20 30 100.0 400.0 1.5 0.5 1.5 0.5\n");
  const Outcome outcome = run_floe(
      folder.path(), "compare event.hits --without birefringence --quiet --json both.json -o both.svg");
  expect_error(outcome, 4, "not enough light");
  EXPECT_EQ(files_in(folder.path()), (std::set<std::string>{"both.json", "event.hits"}));
  EXPECT_EQ(json_in(folder, "both.json")["events"].at(0)["status"], "not_enough_light");
}

}  // namespace
}  // namespace floe::test
