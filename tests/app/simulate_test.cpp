// floe simulate, export and import: what is written can be read again, and depends on nothing but what
// was asked for.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "data/event_files.h"
#include "tests/app/floe_runner.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::json;

const std::string cascade = "simulate --cascade 20,-40,-300,70,130,200 ";

Outcome run_well(const TemporaryFolder& folder, const std::string& arguments) {
  const Outcome outcome = run_floe(folder.path(), arguments);
  EXPECT_EQ(outcome.code, 0) << "floe " << arguments << "\n" << outcome.err;
  return outcome;
}

std::vector<Hit> hits_of(const TemporaryFolder& folder, const std::string& file) {
  return read_event_file(folder.path() / file).events.at(0).hits;
}

bool same(const Hit& a, const Hit& b) {
  return a.module == b.module && a.time == b.time && a.charge == b.charge && a.wavelength == b.wavelength &&
         a.direction == b.direction && a.inward == b.inward;
}
bool same(const std::vector<Hit>& a, const std::vector<Hit>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Hit& x, const Hit& y) { return same(x, y); });
}

TEST(Simulate, SameSeedGivesTheSameHitsForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  run_well(folder, cascade + "--threads 1 -o one.h5");
  run_well(folder, cascade + "--threads 2 -o two.h5");
  run_well(folder, cascade + "--threads 2 --seed 2 -o other.h5");
  const auto one = hits_of(folder, "one.h5");
  EXPECT_GT(one.size(), 50u);
  EXPECT_TRUE(same(one, hits_of(folder, "two.h5")));
  EXPECT_FALSE(same(one, hits_of(folder, "other.h5")));
}

TEST(Simulate, WritesWhereTheHitsComeFrom) {
  const TemporaryFolder folder;
  run_well(folder,
           cascade +
               "--without tilt,birefringence.deflection --seed 7 --oversize 4 -o event.h5 --json event.json");
  const EventFile file = read_event_file(folder.path() / "event.h5");
  ASSERT_TRUE(file.provenance.has_value());
  EXPECT_EQ(file.provenance->seed, 7u);
  EXPECT_EQ(file.provenance->oversize, 4);
  EXPECT_TRUE(file.provenance->command.starts_with("floe simulate --cascade 20,-40,-300,70,130,200 "));
  const Json configuration = Json::parse(file.provenance->configuration);
  EXPECT_EQ(configuration["model"]["without"], (Json{"tilt", "birefringence.deflection"}));
  EXPECT_EQ(configuration["source"]["cascade"]["energy_gev"], 200);
  const Json results = Json::parse(bytes_of(folder.path() / "event.json"));
  EXPECT_EQ(results["hits"], file.events.at(0).hits.size());
  EXPECT_EQ(results["model"]["ice"]["hash"], file.provenance->ice_hash);

  ASSERT_EQ(file.events.at(0).truth.size(), 1u);
  const Particle& truth = file.events[0].truth[0];
  EXPECT_EQ(truth.name, "e-");
  EXPECT_EQ(truth.position, Vec3(20, -40, -300));
  EXPECT_NEAR(truth.azimuth, 130 * degree, 1e-12);
}

TEST(Simulate, SurvivesExportAndImport) {
  const TemporaryFolder folder;
  run_well(folder, cascade + "-o event.h5");
  run_well(folder, "export event.h5 -o event.hits.gz");
  run_well(folder, "import event.hits.gz -o again.h5");
  const auto before = hits_of(folder, "event.h5"), after = hits_of(folder, "again.h5");
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].module, after[i].module);
    EXPECT_NEAR(before[i].time, after[i].time, 1e-3);
    EXPECT_NEAR(before[i].wavelength, after[i].wavelength, 1e-2);
    // Angles are written to 1e-6 rad.
    EXPECT_LT((before[i].direction - after[i].direction).norm(), 3e-6f);
    EXPECT_LT((before[i].inward - after[i].inward).norm(), 3e-6f);
  }
}

TEST(Simulate, FlasherWithAWavelengthIsSimulatedWhole) {
  const TemporaryFolder folder;
  const auto propagated = [&folder](const std::string& options) {
    run_well(folder, "simulate --flasher 63,20 --photons 1e7 -o f.h5 --json f.json --oversize 16 " + options);
    return Json::parse(bytes_of(folder.path() / "f.json"))["photons_propagated"].get<double>();
  };
  // Of the line at 405 nm, 0.68 lies in the middle; both counts are Poisson draws around 1e7/256 times
  // the efficiencies, some 2e4 and more, so that 5% is beyond five sigma.
  EXPECT_NEAR(propagated("") / propagated("--wavelength 405"), 0.68, 0.05);
}

TEST(Simulate, EveryEventOfF2kIsWritten) {
  const TemporaryFolder folder;
  write_bytes(
      folder.path() / "two.f2k",
      "EM 1 1 1970 0 0 0\nTR 1 0 e- 20 -40 -300 70 130 0 100 0\nTR 2 1 hadr 20 -40 -300 70 130 0 50 10\n"
      "EM 2 1 1970 0 0 0\nTR 1 0 ph 0 0 -300 90 0 0 100000 0\n");
  run_well(folder, "simulate --f2k two.f2k -o two.h5");
  const EventFile file = read_event_file(folder.path() / "two.h5");
  ASSERT_EQ(file.events.size(), 2u);
  EXPECT_EQ(file.events[0].truth.size(), 2u);
  EXPECT_EQ(file.events[1].truth.at(0).name, "ph");
  EXPECT_GT(file.events[0].hits.size(), 0u);
}

TEST(Simulate, EventWithoutLightIsWrittenWithAWarning) {
  const TemporaryFolder folder;
  const Outcome outcome = run_well(folder, "simulate --cascade 5000,0,-300,70,130,1 -o dark.h5 --quiet");
  EXPECT_NE(outcome.err.find("floe: warning: event cascade: no light reached a module"), std::string::npos);
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(hits_of(folder, "dark.h5").empty());
}

TEST(Simulate, LeavesNothingButItsOutput) {
  const TemporaryFolder folder;
  const Outcome outcome = run_well(folder, cascade + "-o event.h5");
  EXPECT_EQ(files_in(folder.path()), std::set<std::string>{"event.h5"});
  EXPECT_EQ(outcome.err, "") << "no bar where there is no terminal";
  EXPECT_NE(outcome.out.find("photons/s"), std::string::npos);
}

}  // namespace
}  // namespace floe::test
