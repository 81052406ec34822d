// floe simulate --shard and floe merge: parts that are exactly the whole, and files that do not belong
// together.
#include <gtest/gtest.h>

#include <fstream>

#include "data/event_files.h"
#include "data/event_stream.h"
#include "tests/app/floe_runner.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

constexpr const char* run = "simulate --cascade 20,-40,-300,70,130,400 --quiet ";

class Merge : public ::testing::Test {
 protected:
  Outcome floe(const std::string& arguments) const { return run_floe(folder_.path(), arguments); }
  void floe_well(const std::string& arguments) const {
    const Outcome outcome = floe(arguments);
    ASSERT_EQ(outcome.code, 0) << arguments << "\n" << outcome.err;
  }
  void simulate_shards(int count) const {
    for (int k = 1; k <= count; ++k)
      floe_well(std::string(run) + "--shard " + std::to_string(k) + "/" + std::to_string(count) + " -o part" +
                std::to_string(k) + ".h5");
  }
  std::string text_of(const std::string& file) const {
    floe_well("export " + file + ".h5 -o " + file + ".csv --quiet");
    std::ifstream text(folder_.path() / (file + ".csv"));
    return {std::istreambuf_iterator<char>(text), {}};
  }
  TemporaryFolder folder_;
};

TEST_F(Merge, ShardsAreTheWholePhotonByPhoton) {
  simulate_shards(3);
  floe_well(std::string(run) + "-o whole.h5");
  floe_well("merge part2.h5 part3.h5 part1.h5 -o merged.h5");
  EXPECT_EQ(text_of("merged"), text_of("whole"));
  const auto merged = read_event_file(folder_.path() / "merged.h5").provenance;
  const auto whole = read_event_file(folder_.path() / "whole.h5").provenance;
  EXPECT_EQ(merged->configuration, whole->configuration);
}

TEST_F(Merge, RefusesShardsThatAreMissingOrTwiceOrStrange) {
  simulate_shards(2);
  floe_well(std::string(run) + "--seed 2 --shard 2/2 -o strange.h5");
  floe_well(std::string(run) + "-o whole.h5");
  expect_error(floe("merge part1.h5 -o x.h5"), 3, "no file with shard 2 of 2");
  expect_error(floe("merge part1.h5 part1.h5 -o x.h5"), 3, "shard 1 again");
  expect_error(floe("merge part1.h5 strange.h5 -o x.h5"), 3, "another simulation");
  expect_error(floe("merge part1.h5 whole.h5 -o x.h5"), 3, "one of 2 shards");
  EXPECT_FALSE(files_in(folder_.path()).contains("x.h5"));
}

TEST_F(Merge, PutsDifferentEventsTogether) {
  floe_well(std::string(run) + "-o one.h5");
  floe_well("simulate --flasher 63,20 --photons 1e6 --quiet -o two.h5");
  floe_well("merge one.h5 two.h5 -o both.h5");
  const auto events = read_event_file(folder_.path() / "both.h5").events;
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[1].id, "flasher-63-20");
  expect_error(floe("merge one.h5 both.h5 -o x.h5"), 3, "again");
}

TEST_F(Merge, KeepsWhatStandsBesidePulses) {
  floe_well(std::string(run) + "-o light.h5");
  floe_well("simulate --flasher 63,20 --photons 1e6 --quiet -o flash.h5");
  for (const char* name : {"light", "flash"})
    floe_well(std::string("respond ") + name + ".h5 --keep photons,photoelectrons,waveforms --quiet -o " +
              name + "-record.h5");
  floe_well("merge light-record.h5 flash-record.h5 -o both.h5");
  const EventFileReader both(folder_.path() / "both.h5");
  ASSERT_EQ(both.size(), 2U);
  std::size_t e = 0;
  for (const char* name : {"light", "flash"}) {
    const EventFileReader alone(folder_.path() / (std::string(name) + "-record.h5"));
    EXPECT_GT(alone.photons(0).size(), 0U) << name;
    EXPECT_EQ(both.photons(e).size(), alone.photons(0).size()) << name;
    EXPECT_GT(alone.photoelectrons(0).size(), 0U) << name;
    EXPECT_EQ(both.photoelectrons(e).size(), alone.photoelectrons(0).size()) << name;
    const auto waveforms = both.waveforms(e), expected = alone.waveforms(0);
    ASSERT_EQ(waveforms.size(), expected.size()) << name;
    ASSERT_GT(expected.size(), 0U) << name;
    EXPECT_EQ(waveforms.back().counts, expected.back().counts) << name;
    EXPECT_TRUE(both.read(e).readout.has_value()) << name;
    ++e;
  }
}

TEST_F(Merge, RefusesWrongShards) {
  for (const char* shard : {"0/2", "3/2", "2", "1/0", "a/b", "1/2/3"})
    EXPECT_EQ(floe(std::string(run) + "--shard " + shard + " -o x.h5").code, 2) << shard;
}

}  // namespace
}  // namespace floe::test
