// Light too bright to simulate photon by photon, and the sources of light on the command line.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "data/event_files.h"
#include "tests/app/floe_runner.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::json;

class Sources : public ::testing::Test {
 protected:
  Outcome floe_well(const std::string& arguments) const {
    const Outcome outcome = run_floe(folder_.path(), arguments);
    EXPECT_EQ(outcome.code, 0) << "floe " << arguments << "\n" << outcome.err;
    return outcome;
  }
  void write(const std::string& file, const std::string& text) const {
    write_bytes(folder_.path() / file, text);
  }
  Json json_of(const std::string& file) const { return Json::parse(bytes_of(folder_.path() / file)); }
  Event event_of(const std::string& file) const {
    return read_event_file(folder_.path() / file).events.at(0);
  }
  static double charge(const Event& event) {
    double sum = 0;
    for (const Hit& hit : event.hits) sum += hit.charge;
    return sum;
  }
  TemporaryFolder folder_;
};

TEST_F(Sources, OfTooMuchLightAreSimulatedInPartWithTheRightCharge) {
  floe_well("simulate --flasher 63,20 --photons 1e7 --oversize 5 --seed 2 -o whole.h5");
  const Outcome outcome = floe_well(
      "simulate --flasher 63,20 --photons 1e16 --seed 3 --most-photons 247746 --json part.json -o part.h5");
  EXPECT_NE(outcome.err.find("--most-photons"), std::string::npos) << outcome.err;
  const Event whole = event_of("whole.h5"), part = event_of("part.h5");
  const Json event = json_of("part.json")["events"][0];
  EXPECT_EQ(event["repeats"].get<double>(), part.repeats);
  EXPECT_NEAR(part.repeats, 1e-9, 1e-12);  // 1e7 photons of 1e16
  EXPECT_EQ(event["share_simulated"].get<double>(), part.repeats);
  const Json configuration =
      Json::parse(read_event_file(folder_.path() / "part.h5").provenance->configuration);
  EXPECT_EQ(configuration["most_photons"], 247746);
  // Two Poisson counts of the same mean, some 60, of which one is taken 1e9 times.
  const double a = static_cast<double>(whole.hits.size()), b = charge(part) * 1e-9;
  EXPECT_GT(a, 20);
  EXPECT_NEAR(a, b, 5 * std::sqrt(a + b));
  EXPECT_NEAR(b, static_cast<double>(part.hits.size()), 1e-3 * b);
}

TEST_F(Sources, OfOneEventShareItsPart) {
  // Two cascades of 1e9 GeV: what is left is shared between them, and the weights stay whole.
  write("two.f2k", "TR 1 0 e- 0 0 -300 0 0 0 1e9 0\nTR 2 0 e- 0 0 -300 180 0 0 1e9 0\n");
  floe_well("simulate --f2k two.f2k --most-photons 1e5 --weighted --json two.json -o two.h5");
  const Json summary = json_of("two.json");
  EXPECT_NEAR(summary["photons_propagated"].get<double>(), 1e5, 5 * std::sqrt(1e5));
  const Event event = event_of("two.h5");
  EXPECT_NEAR(charge(event) * event.repeats, summary["weight_sum"].get<double>(),
              1e-5 * summary["weight_sum"].get<double>());
}

TEST_F(Sources, BelowTheLimitAreWhole) {
  const Outcome outcome = floe_well("simulate --cascade 20,-40,-300,70,130,50 --json c.json -o c.h5");
  EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
  EXPECT_EQ(json_of("c.json")["events"][0]["repeats"], 1);
  EXPECT_EQ(event_of("c.h5").repeats, 1);
}

TEST_F(Sources, OfShardsHaveTheSameShare) {
  for (const char* shard : {"1", "2"})
    floe_well(std::string("simulate --flasher 63,20 --photons 1e12 --most-photons 2e5 --quiet --shard ") +
              shard + "/2 -o part" + shard + ".h5");
  floe_well("merge part1.h5 part2.h5 -o merged.h5");
  floe_well("simulate --flasher 63,20 --photons 1e12 --most-photons 2e5 --quiet -o whole.h5");
  EXPECT_EQ(event_of("merged.h5").repeats, event_of("whole.h5").repeats);
  EXPECT_EQ(event_of("merged.h5").hits.size(), event_of("whole.h5").hits.size());
}

TEST_F(Sources, OfMuonsAndHadronsComeFromF2k) {
  write("muon.f2k",
        "TR 1 0 amu- 0 0 -300 180 0 100 1000 0\nTR 2 0 pi- 0 0 -300 180 0 0 50 0\nTR 3 0 amu 0 0 0 90 0 0 9 "
        "0\n");
  floe_well("simulate --f2k muon.f2k --json muon.json -o muon.h5");
  const Event event = event_of("muon.h5");
  ASSERT_EQ(event.truth.size(), 3u);
  EXPECT_EQ(event.truth[0].length, 100);
  EXPECT_EQ(event.truth[1].name, "pi-");
  // Most light is the segment's: 2450.08 * 100 m * 1.326; the share propagated is that of flashers,
  // 0.0247738.
  const double muon = 2450.08 * 100 * 1.3261423;
  const double pion = 2450.08 * 5.25402 * 50 * 0.7;  // within its fluctuations
  EXPECT_NEAR(json_of("muon.json")["photons_propagated"].get<double>(), 0.0364 * (muon + pion),
              0.15 * 0.0364 * (muon + pion));
}

TEST_F(Sources, FromAPointAndFromAStandardCandle) {
  floe_well("simulate --point 0,0,-300 --photons 1e6 --time 50 -o point.h5");
  floe_well("simulate --standard-candle 0,0,-300 --emitted 2e7 -o candle.h5");
  for (const Hit& hit : event_of("point.h5").hits) {
    EXPECT_EQ(hit.wavelength, 405);
    EXPECT_GT(hit.time, 50);
  }
  const Event candle = event_of("candle.h5");
  ASSERT_GT(candle.hits.size(), 20u);
  for (const Hit& hit : candle.hits) EXPECT_EQ(hit.wavelength, 337);
  const Json light = Json::parse(
      read_event_file(folder_.path() / "candle.h5").provenance->configuration)["source"]["standard-candle"];
  EXPECT_NEAR(light["opening_deg"].get<double>(), 41.1, 0.05);
  EXPECT_EQ(light["emitted"], 2e7);
}

TEST_F(Sources, TakeMeasuredBeamsAndPulses) {
  write("beam.txt", "# angle [deg], intensity\n0 1\n30 0\n");
  write("pulse.txt", "0 0\n10 1\n20 0\n");
  write("runs.toml",
        "[defaults]\nphotons = 1e6\nbeam = \"beam.txt\"\n[[run]]\nmodule = [63, 20]\npulse = \"pulse.txt\"\n"
        "[[run]]\nmodule = [63, 20]\nwidth_deg = 5\n");
  floe_well("simulate --flashers runs.toml -o runs.h5");
  const EventFile runs = read_event_file(folder_.path() / "runs.h5");
  // A triangle of half-width w has the variance w^2/6: the equivalent box is sqrt(2) w wide.
  EXPECT_NEAR(runs.events[0].flasher->pulse_width, 10 * std::sqrt(2), 1e-2);
  EXPECT_GT(runs.events[0].flasher->beam_width, 8 * degree);
  EXPECT_EQ(runs.events[1].flasher->beam_width, 5 * degree);
  const Json source = Json::parse(runs.provenance->configuration)["source"]["flashers"];
  EXPECT_NEAR(source[0]["beam"][1][0].get<double>(), 30, 1e-9);
  EXPECT_EQ(source[0]["pulse"], (Json{{0, 0}, {10, 1}, {20, 0}}));
  EXPECT_FALSE(source[1].contains("beam"));

  floe_well("simulate --flasher 63,20 --photons 1e6 --beam beam.txt --pulse pulse.txt -o one.h5");
  write("both.toml", "[[run]]\nmodule = [63, 20]\nphotons = 1e6\nwidth_deg = 5\nbeam = \"beam.txt\"\n");
  expect_error(run_floe(folder_.path(), "simulate --flashers both.toml -o x.h5"), 3,
               "both.toml:5: found beam beside width_deg");
  write("beam.txt", "0 1\n30 zero\n");
  expect_error(run_floe(folder_.path(), "simulate --flasher 63,20 --photons 1e6 --beam beam.txt -o x.h5"), 3,
               "beam.txt:2: found 'zero'");
}

}  // namespace
}  // namespace floe::test
