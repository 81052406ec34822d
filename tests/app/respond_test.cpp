// floe respond: pulses from photons, in files that every other command takes as they are; a run that is
// killed goes on and loses and repeats nothing.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/app/floe_runner.h"
#include "tests/app/same_events.h"
#include "tests/app/small_detector.h"
#include "tests/unit/data/temporary_folder.h"

#include "data/event_stream.h"
#include "data/icetray_tables.h"

namespace floe::test {
namespace {

using Json = nlohmann::ordered_json;

std::string bytes_of_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

double charge_of(const Event& event) {
  double sum = 0;
  for (const Hit& hit : event.hits) sum += hit.charge;
  return sum;
}

std::map<ModuleId, double> charges_of(const Event& event) {
  std::map<ModuleId, double> charges;
  for (const Hit& hit : event.hits) charges[hit.module] += hit.charge;
  return charges;
}

class Respond : public testing::Test {
 protected:
  void SetUp() override { write_small_detector(file("geo"), 40); }
  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
  Outcome floe(const std::string& arguments) const { return run_floe(folder_.path(), arguments); }
  void expect_done(const std::string& arguments) const {
    const Outcome outcome = floe(arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.err;
  }
  // Several events of one cascade each, named FILE-1, FILE-2, ...
  void simulate_events(int count, double energy) const {
    std::ofstream f2k(file("events.f2k"));
    for (int i = 0; i < count; ++i)
      f2k << "EM\nTR 1 1 e- 20 " << i % 7 << " -300 60 " << 10 * (i % 36) << " 0 " << energy << " 0\n";
    f2k.close();
    expect_done("simulate --f2k events.f2k --detector geo -o photons.h5 --quiet");
  }
  EventFile read(const std::string& name) const { return read_event_file(file(name)); }

  TemporaryFolder folder_;
};

TEST_F(Respond, WritesPulsesAndWhatWasAskedFor) {
  simulate_events(2, 300);
  const Outcome outcome = floe(
      "respond photons.h5 --detector geo -o pulses.h5 --keep truth,photons,photoelectrons,waveforms --json "
      "out.json --off 4,5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("event events-1: "), std::string::npos) << outcome.out;
  const EventFile photons = read("photons.h5"), pulses = read("pulses.h5");
  ASSERT_EQ(pulses.events.size(), 2u);
  EXPECT_TRUE(pulses.provenance->pulses);
  EXPECT_EQ(pulses.provenance->ice_hash, photons.provenance->ice_hash);
  const EventFileReader reader(file("pulses.h5"));
  for (std::size_t e = 0; e < 2; ++e) {
    const Event& event = pulses.events[e];
    EXPECT_EQ(event.truth.size(), 1u);
    ASSERT_TRUE(event.readout);
    EXPECT_EQ(event.readout->modules->size(), 63u);
    EXPECT_EQ(reader.photons(e).size(), photons.events[e].hits.size());
    EXPECT_GT(reader.photoelectrons(e).size(), photons.events[e].hits.size() / 2);
    const auto waveforms = reader.waveforms(e);
    ASSERT_FALSE(waveforms.empty());
    for (const ModuleWaveform& waveform : waveforms) {
      EXPECT_EQ(waveform.counts.size(), waveform.digitiser != Digitiser::fadc ? 128u
                                        : waveform.counts.size() == 3         ? 3u
                                                                              : 256u);
      EXPECT_FALSE(waveform.module == ModuleId({4, 5}));
    }
    EXPECT_FALSE(charges_of(event).contains({4, 5}));
  }
  const Json json = Json::parse(bytes_of_file(file("out.json")));
  EXPECT_EQ(json["events"][0]["pulses"], pulses.events[0].hits.size());
  EXPECT_FALSE(std::filesystem::exists(file("pulses.h5.parts")));

  // The same seed gives the same pulses for any number of threads.
  expect_done("respond photons.h5 --detector geo -o again.h5 --off 4,5 --threads 1 --quiet");
  const EventFile again = read("again.h5");
  for (std::size_t e = 0; e < 2; ++e) EXPECT_EQ(charge_of(again.events[e]), charge_of(pulses.events[e]));
}

TEST_F(Respond, FlasherRunsStayFlasherRunsWithTheirCharges) {
  std::ofstream(file("runs.toml")) << "[[run]]\nmodule = [1, 5]\nphotons = 2e6\nrepeats = 10\n";
  std::ofstream(file("quiet.toml")) << "[noise]\nsingle_rate = 0\nburst_rate = 0\n[afterpulses]\nshare = 0\n"
                                       "[local_coincidence]\nmode = \"none\"\n";
  expect_done("simulate --flashers runs.toml --detector geo --oversize 1 -o runs.h5 --quiet");
  expect_done("respond runs.h5 --response quiet.toml --detector geo -o measured.h5 --quiet");
  const Event photons = read("runs.h5").events.at(0), pulses = read("measured.h5").events.at(0);
  ASSERT_TRUE(pulses.flasher);
  EXPECT_EQ(pulses.flasher->module, photons.flasher->module);
  EXPECT_EQ(pulses.flasher->photons, photons.flasher->photons);
  EXPECT_EQ(pulses.repeats, 10);
  std::set<ModuleId> saturated;
  for (const UnusableTimes& times : pulses.readout->unusable) saturated.insert(times.module);
  const auto seen = charges_of(pulses);
  double pull_square = 0, light = 0, charge = 0;
  int modules = 0;
  for (const auto& [module, expected] : charges_of(photons)) {
    if (saturated.contains(module) || expected * 10 < 20) continue;
    const auto found = seen.find(module);
    ASSERT_NE(found, seen.end());
    // The width of a photoelectron's charge is 0.53 of its mean.
    const double pull = (found->second - expected) / (0.53 * std::sqrt(expected / 10));
    pull_square += pull * pull;
    light += expected;
    charge += found->second;
    ++modules;
  }
  ASSERT_GT(modules, 10);
  EXPECT_LT(pull_square, modules + 5 * std::sqrt(2.0 * modules) + 0.5 * modules);
  // Prepulses lack 0.3%, pulses below the discriminator up to 2%.
  EXPECT_NEAR(charge / light, 0.99, 0.015 + 4 * 0.53 / std::sqrt(10 * light));
}

TEST_F(Respond, PulsesGoThroughIceTraysTablesAndBack) {
  simulate_events(2, 300);
  expect_done("respond photons.h5 --detector geo -o pulses.h5 --quiet");
  expect_done("export pulses.h5 -o pulses.i3.h5 --quiet");
  expect_done("export pulses.h5 -o same.h5 --format icetray --quiet");
  const std::vector<Event> pulses = read("pulses.h5").events, back = read("pulses.i3.h5").events;
  EXPECT_EQ(read("same.h5").events[0].hits.size(), back[0].hits.size());
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[1].id, "0-1");
  for (std::size_t e = 0; e < 2; ++e) {
    EXPECT_EQ(back[e].hits.size(), pulses[e].hits.size());
    EXPECT_EQ(charges_of(back[e]).size(), charges_of(pulses[e]).size());
    EXPECT_NEAR(charge_of(back[e]), charge_of(pulses[e]), 1e-3);
  }
  expect_done("import pulses.i3.h5 --table InIcePulses -o imported.h5 --quiet");
  EXPECT_EQ(read("imported.h5").events[0].hits.size(), pulses[0].hits.size());
  expect_error(floe("import pulses.i3.h5 --table Other -o imported.h5"), 3, "expected one of InIcePulses");
}

TEST_F(Respond, KilledAgainAndAgainItSaysWhatAnUndisturbedRunSays) {
  simulate_events(30, 100);
  const std::string command = "respond photons.h5 --detector geo -o pulses.h5 --keep truth,waveforms --quiet";
  const auto start = std::chrono::steady_clock::now();
  expect_done(command);
  const auto duration = std::chrono::steady_clock::now() - start;
  std::filesystem::rename(file("pulses.h5"), file("whole.h5"));
  int kills = 0;
  std::string said;
  for (int i = 1; i <= 6 && !std::filesystem::exists(file("pulses.h5")); ++i) {
    const pid_t process = start_floe(folder_.path(), command + " 2>said");
    std::this_thread::sleep_for(duration * (i + 1) / 9);
    ::kill(process, SIGKILL);
    int status = 0;
    ::waitpid(process, &status, 0);
    kills += WIFSIGNALED(status);
    said += bytes_of_file(file("said"));
  }
  EXPECT_GE(kills, 2);
  expect_done(command);
  EXPECT_NE(said.find("going on after"), std::string::npos) << said;
  expect_same_events(file("pulses.h5"), file("whole.h5"));
  EXPECT_FALSE(std::filesystem::exists(file("pulses.h5.parts")));
}

TEST_F(Respond, OtherSettingsBeginAnew) {
  simulate_events(2, 100);
  std::filesystem::create_directory(file("pulses.h5.parts"));
  std::ofstream(file("pulses.h5.parts/journal")) << R"({"journal":"floe respond 1","version":"other"})"
                                                 << "\n";
  expect_done("respond photons.h5 --detector geo -o pulses.h5 --quiet");
  EXPECT_EQ(read("pulses.h5").events.size(), 2u);
}

TEST_F(Respond, WritesItsSettings) {
  expect_done("respond --write-response response.toml");
  simulate_events(1, 100);
  expect_done("respond photons.h5 --detector geo -o default.h5 --quiet");
  expect_done("respond photons.h5 --detector geo --response response.toml -o named.h5 --quiet");
  EXPECT_EQ(charge_of(read("default.h5").events[0]), charge_of(read("named.h5").events[0]));
}

TEST_F(Respond, SaysWhatIsWrong) {
  simulate_events(1, 100);
  expect_error(floe("respond photons.h5"), 2, "-o FILE.h5");
  expect_error(floe("respond photons.h5 --detector geo -o pulses.h5 --keep waves"), 2,
               "expected truth, photons");
  expect_error(floe("respond photons.h5 --detector geo -o pulses.h5 --off 99,1"), 3, "99,1");
  std::ofstream(file("bad.toml")) << "[atwd]\nstep = 0\n";
  expect_error(floe("respond photons.h5 --detector geo --response bad.toml -o pulses.h5"), 3,
               "bad.toml:2: found");
  expect_done("respond photons.h5 --detector geo -o pulses.h5 --quiet");
  expect_error(floe("respond pulses.h5 --detector geo -o twice.h5"), 3, "no photons");
  expect_error(floe("respond geo --detector geo -o pulses.h5"), 3, "floe import");
  EXPECT_FALSE(std::filesystem::exists(file("twice.h5")));
}

}  // namespace
}  // namespace floe::test
