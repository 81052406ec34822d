// floe simulate --weighted: weights and their sums in files and summaries, through shards and merges.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "data/event_files.h"
#include "data/weights.h"
#include "tests/app/floe_runner.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::json;

const std::string run = "simulate --cascade 20,-40,-300,70,130,100 --oversize 10 ";

class Weighted : public ::testing::Test {
 protected:
  Outcome floe(const std::string& arguments) const { return run_floe(folder_.path(), arguments); }
  std::string floe_well(const std::string& arguments) const {
    const Outcome outcome = floe(arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.err;
    return outcome.out;
  }
  EventFile events_of(const std::string& file) const { return read_event_file(folder_.path() / file); }
  Json json_of(const std::string& file) const {
    std::ifstream stream(folder_.path() / file);
    return Json::parse(stream);
  }
  static WeightSums sums_of(const EventFile& file) {
    WeightSums sums;
    for (const Event& event : file.events)
      for (const Hit& hit : event.hits) sums.add(hit.charge);
    return sums;
  }
  TemporaryFolder folder_;
};

TEST_F(Weighted, SummariesCarryTheSumsOfTheFile) {
  const std::string printed = floe_well(run + "--weighted -o w.h5 --json w.json");
  const EventFile file = events_of("w.h5");
  const WeightSums sums = sums_of(file);
  EXPECT_TRUE(file.provenance->weighted);
  EXPECT_EQ(Json::parse(file.provenance->configuration)["weighted"], 4);
  ASSERT_GT(sums.hits, 50U);
  for (const Hit& hit : file.events[0].hits) {
    ASSERT_GT(hit.charge, 0);
    ASSERT_LE(hit.charge, 1);
  }
  const Json json = json_of("w.json");
  for (const Json& part : {json, json["events"][0]}) {
    EXPECT_EQ(part["hits"], sums.hits);
    EXPECT_NEAR(part["weight_sum"], sums.sum, 1e-9 * sums.sum);
    EXPECT_NEAR(part["squared_weight_sum"], sums.squares, 1e-9 * sums.squares);
    EXPECT_NEAR(part["effective_hits"], sums.effective_hits(), 1e-6 * sums.effective_hits());
  }
  EXPECT_EQ(json["absorption_stretch"], 4);
  EXPECT_NE(printed.find("weights "), std::string::npos) << printed;
}

TEST_F(Weighted, UnweightedRunsStayAsTheyWere) {
  const std::string printed = floe_well(run + "-o plain.h5 --json plain.json");
  EXPECT_EQ(printed.find("weight"), std::string::npos) << printed;
  const EventFile file = events_of("plain.h5");
  EXPECT_FALSE(file.provenance->weighted);
  EXPECT_FALSE(Json::parse(file.provenance->configuration).contains("weighted"));
  const Json json = json_of("plain.json");
  EXPECT_EQ(json["weight_sum"], json["hits"]);
  EXPECT_EQ(json["effective_hits"], json["hits"]);
}

TEST_F(Weighted, ShardsMergeToTheSumsOfTheWhole) {
  floe_well(run + "--weighted=6 -o whole.h5");
  for (const char* k : {"1", "2"}) floe_well(run + "--weighted=6 --shard " + k + "/2 -o part" + k + ".h5");
  floe_well("merge part1.h5 part2.h5 -o merged.h5");  // reading checks the table of sums
  const EventFile merged = events_of("merged.h5"), whole = events_of("whole.h5");
  EXPECT_TRUE(merged.provenance->weighted);
  EXPECT_EQ(merged.provenance->configuration, whole.provenance->configuration);
  EXPECT_EQ(sums_of(merged).hits, sums_of(whole).hits);
  EXPECT_EQ(sums_of(merged).sum, sums_of(whole).sum);
  EXPECT_EQ(sums_of(merged).squares, sums_of(whole).squares);
  floe_well(run + "--weighted=5 --shard 2/2 -o other.h5");
  expect_error(floe("merge part1.h5 other.h5 -o x.h5"), 3, "another simulation");
  floe_well("simulate --flasher 63,20 --photons 1e5 -o plain.h5");
  floe_well("merge whole.h5 plain.h5 -o both.h5");
  EXPECT_TRUE(events_of("both.h5").provenance->weighted);
}

TEST_F(Weighted, PhotonsWithWeightsAreNoHitText) {
  floe_well(run + "--weighted -o w.h5");
  expect_error(floe("export w.h5 -o w.hits"), 2, "photons of that weight");
  floe_well("export w.h5 -o w.dat");
  EXPECT_EQ(sums_of(events_of("w.dat")).hits, sums_of(events_of("w.h5")).hits);
}

TEST_F(Weighted, RefusesStretchesThatMakeNoSense) {
  for (const char* stretch : {"1", "0.5", "100.5", "-4", "nan", "inf", "4x", "four"}) {
    const Outcome outcome = floe(run + "-o x.h5 --weighted=" + stretch);
    expect_error(outcome, 2, "--weighted");
  }
  EXPECT_FALSE(files_in(folder_.path()).contains("x.h5"));
}

}  // namespace
}  // namespace floe::test
