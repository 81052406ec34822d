// Flasher runs on the command line: simulated from TOML, exported, imported again, and wrong files refused.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "data/event_files.h"
#include "tests/app/floe_runner.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Flashers : public ::testing::Test {
 protected:
  Outcome floe(const std::string& arguments) const { return run_floe(folder_.path(), arguments); }
  Outcome floe_well(const std::string& arguments) const {
    const Outcome outcome = floe(arguments);
    EXPECT_EQ(outcome.code, 0) << "floe " << arguments << "\n" << outcome.err;
    return outcome;
  }
  void write(const std::string& file, const std::string& text) const {
    write_bytes(folder_.path() / file, text);
  }
  EventFile read(const std::string& file) const { return read_event_file(folder_.path() / file); }
  double propagated(const std::string& runs) const {
    write("runs.toml", runs);
    floe_well("simulate --flashers runs.toml --oversize 16 -o runs.h5 --json runs.json --quiet");
    return Json::parse(bytes_of(folder_.path() / "runs.json"))["photons_propagated"].get<double>();
  }
  TemporaryFolder folder_;
};

const std::string two_runs =
    "# defaults hold for every run\n"
    "[defaults]\n"
    "photons = 2e7\n"
    "repeats = 4\n"
    "\n"
    "[[run]]\n"
    "module = [63, 20]\n"
    "\n"
    "[[run]]\n"
    "string = 63\n"
    "dom = 20\n"
    "leds = 3\n"
    "orientation_deg = -30\n"
    "wavelength_nm = 405\n"
    "width_deg = 5\n"
    "pulse_width_ns = 70\n"
    "photons = 1e7\n"
    "repeats = 1\n";

TEST_F(Flashers, AreSimulatedAndKnowWhatTheyAre) {
  write("runs.toml", two_runs);
  floe_well("simulate --flashers runs.toml --oversize 16 -o runs.h5");
  const EventFile file = read("runs.h5");
  ASSERT_EQ(file.events.size(), 2u);
  const Event &ring = file.events[0], &single = file.events[1];
  EXPECT_EQ(ring.id, "63,20");
  EXPECT_EQ(ring.repeats, 4);
  ASSERT_TRUE(ring.flasher);
  EXPECT_EQ(ring.flasher->module, (ModuleId{63, 20}));
  EXPECT_EQ(name_of(ring.flasher->leds), "ring");
  EXPECT_EQ(ring.flasher->photons, 2e7);
  EXPECT_EQ(ring.flasher->oversize, 16);
  ASSERT_GT(ring.hits.size(), 0u);
  // The hits of four flashes, each a quarter: together the average.
  for (const Hit& hit : ring.hits) ASSERT_EQ(hit.charge, 0.25f);

  EXPECT_EQ(single.id, "63,20-2");
  EXPECT_EQ(single.repeats, 1);
  ASSERT_TRUE(single.flasher);
  EXPECT_EQ(name_of(single.flasher->leds), "3");
  EXPECT_NEAR(single.flasher->orientation, -30 * degree, 1e-12);
  EXPECT_NEAR(single.flasher->beam_width, 5 * degree, 1e-12);
  EXPECT_EQ(single.flasher->wavelength, 405);
  EXPECT_EQ(single.flasher->pulse_width, 70);
  EXPECT_EQ(single.flasher->photons, 1e7);
  const Json source = Json::parse(file.provenance->configuration)["source"];
  EXPECT_EQ(source["flashers"][1]["leds"], "3");
}

// The ring is the light of --flasher, number by number.
TEST_F(Flashers, OfOneRingAreTheFlasherOfTheCommandLine) {
  write("runs.toml", "[[run]]\nmodule = [63, 20]\nphotons = 2e7\n");
  floe_well("simulate --flashers runs.toml --oversize 10 --seed 5 -o runs.h5");
  floe_well("simulate --flasher 63,20 --photons 2e7 --oversize 10 --seed 5 -o flasher.h5");
  const auto runs = read("runs.h5").events.at(0).hits, flasher = read("flasher.h5").events.at(0).hits;
  ASSERT_EQ(runs.size(), flasher.size());
  ASSERT_GT(runs.size(), 0u);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(runs[i].module, flasher[i].module);
    EXPECT_EQ(runs[i].time, flasher[i].time);
  }
}

// Counts are Poisson draws around 1e8/256 times the efficiencies: some 2e5 and more, so that 1.5% is beyond
// five sigma.
TEST_F(Flashers, PhotonsAreThoseOfOneFlash) {
  const std::string run = "[[run]]\nmodule = [63, 20]\n";
  const double one = propagated(run + "photons = 1e8\n");
  EXPECT_NEAR(propagated(run + "photons = 1e8\nrepeats = 3\n") / one, 3, 0.05);
  EXPECT_NEAR(one / propagated(run + "photons = 1e8\nwavelength_nm = 405\n"), 0.68, 0.02);
}

TEST_F(Flashers, SurviveExportAndImport) {
  write("runs.toml", two_runs);
  floe_well("simulate --flashers runs.toml --oversize 16 -o runs.h5");
  floe_well("export runs.h5 -o runs.hits.gz");
  floe_well("import --flashers runs.hits.gz -o again.h5 --json again.json");
  const EventFile before = read("runs.h5"), after = read("again.h5");
  EXPECT_EQ(after.provenance->oversize, 16);
  ASSERT_EQ(after.events.size(), before.events.size());
  for (std::size_t i = 0; i < before.events.size(); ++i) {
    const Event &a = before.events[i], &b = after.events[i];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.repeats, b.repeats);
    ASSERT_TRUE(b.flasher);
    EXPECT_EQ(a.flasher->leds, b.flasher->leds);
    EXPECT_EQ(a.flasher->photons, b.flasher->photons);
    EXPECT_EQ(a.flasher->oversize, b.flasher->oversize);
    ASSERT_EQ(a.hits.size(), b.hits.size());
    for (std::size_t k = 0; k < a.hits.size(); ++k) {
      EXPECT_EQ(a.hits[k].module, b.hits[k].module);
      EXPECT_EQ(a.hits[k].charge, b.hits[k].charge);
      EXPECT_NEAR(a.hits[k].time, b.hits[k].time, 1e-3);
    }
  }
  const Json json = Json::parse(bytes_of(folder_.path() / "again.json"));
  EXPECT_EQ(json["events"][1]["event"], "63,20-2");
  EXPECT_EQ(json["events"][1]["hits"], before.events[1].hits.size());
  expect_error(floe("export runs.h5 -o runs.dat"), 2, "one event, not 2");
  floe_well("export runs.h5 --event 63,20-2 -o one.dat");
  expect_error(floe("import runs.hits.gz -o x.h5"), 3, "floe import --flashers");
}

TEST_F(Flashers, SurviveMerging) {
  write("runs.toml", two_runs);
  const std::string run = "simulate --flashers runs.toml --oversize 16 --quiet ";
  floe_well(run + "-o whole.h5");
  for (const std::string k : {"1", "2"}) floe_well(run + "--shard " + k + "/2 -o part" + k + ".h5");
  floe_well("merge part1.h5 part2.h5 -o merged.h5");
  const EventFile whole = read("whole.h5"), merged = read("merged.h5");
  ASSERT_EQ(merged.events.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(merged.events[i].flasher);
    EXPECT_EQ(merged.events[i].flasher->leds, whole.events[i].flasher->leds);
    EXPECT_EQ(merged.events[i].repeats, whole.events[i].repeats);
    EXPECT_EQ(merged.events[i].hits.size(), whole.events[i].hits.size());
  }
}

TEST_F(Flashers, MeasuredChargesAreImported) {
  write("runs.dat",
        "# averages over 240 flashes\n"
        "FLASHER 63 20 leds=horizontal repeats=240 pulse_width_ns=70\n"
        "63 21 85.5 12.75\n63 22 190 0.0125\n"
        "FLASHER 36 45 repeats=100\n36 46 90 3\n");
  const Outcome outcome = floe_well("import --flashers runs.dat -o runs.h5");
  EXPECT_EQ(outcome.out, "runs.h5: 2 events, 3 hits\n");
  const auto events = read("runs.h5").events;
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].id, "63,20");
  EXPECT_EQ(events[0].repeats, 240);
  EXPECT_EQ(events[0].hits.at(1).charge, 0.0125f);
  EXPECT_TRUE(std::isnan(events[0].flasher->photons));
  EXPECT_TRUE(std::isnan(events[0].flasher->orientation));
  EXPECT_EQ(events[0].flasher->oversize, 1);
}

TEST_F(Flashers, TheReferenceSetIsImported) {
  const fs::path file = FLOE_SHARED_DIR "/reference/hidden-T0/hits.txt.gz";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not there";
  floe_well("import --flashers '" + file.string() + "' -o set.h5");
  const EventFile set = read("set.h5");
  ASSERT_EQ(set.events.size(), 6u);
  EXPECT_EQ(set.events[0].id, "63,20");
  EXPECT_EQ(set.events[5].id, "71,36");
  EXPECT_EQ(set.provenance->oversize, 16);
  for (const Event& event : set.events) {
    EXPECT_EQ(event.flasher->photons, 2e9);
    EXPECT_GT(event.hits.size(), 1000u);
  }
}

// What is wrong, and what must be said; nothing is left behind.
struct WrongFile {
  const char *text, *said;
};

TEST_F(Flashers, WrongRunFilesAreRefusedWithTheLine) {
  const std::string good = "[[run]]\nmodule = [63, 20]\nphotons = 1e6\n";
  const WrongFile cases[] = {
      {"", "runs.toml: found no run; expected at least one table [[run]]"},
      {"[defaults]\nphotons = 1e6\n", "found no run"},
      {"[[run]]\nmodule = [63, 20]\nphotons = 1e6\nleds = \"rings\"\n",
       "runs.toml:4: found 'leds = \"rings\"'; expected ring, horizontal, tilted"},
      {"[[run]]\nmodule = [63, 20]\nphotons = 1e6\nleds = 13\n", "runs.toml:4: found 'leds = 13'"},
      {"[[run]]\nmodule = [63, 20]\nphotons = 1e6\nleds = 1.5\n", "runs.toml:4"},
      {"[[run]]\nmodule = [63, 20]\nphotns = 1e6\n", "runs.toml:3: found an unknown key 'photns'"},
      {"[[run]]\nmodule = [63, 20]\nphotns = 1e6\n", "Did you mean photons?"},
      {"[[run]]\nmodule = [63, 20]\n", "runs.toml:1: found a run without photons"},
      {"[[run]]\nphotons = 1e6\n", "runs.toml:1: found a run that does not name its module once"},
      {"[[run]]\nphotons = 1e6\nmodule = [63, 20]\ndom = 20\n", "does not name its module once"},
      {"[[run]]\nphotons = 1e6\nstring = 63\n", "does not name its module once"},
      {"[[run]]\nphotons = 1e6\nmodule = [63]\n",
       "runs.toml:3: found 'module = [63]'; expected [STRING, DOM]"},
      {"[[run]]\nphotons = 1e6\nmodule = [63, 20.5]\n", "runs.toml:3"},
      {"[[run]]\nphotons = 1e6\nmodule = \"63,20\"\n", "runs.toml:3"},
      {"[[run]]\nmodule = [63, 20]\nphotons = \"many\"\n",
       "runs.toml:3: found 'photons = \"many\"'; expected a number for photons"},
      {"[[run]]\nmodule = [63, 20]\nphotons = 0\n", "runs.toml:3: found number of photons 0"},
      {"[[run]]\nmodule = [63, 20]\nphotons = inf\n", "runs.toml:3"},
      {"[[run]]\nmodule = [63, 20]\nphotons = 1e6\nrepeats = 0\n", "runs.toml:4: found 'repeats = 0'"},
      {"[[run]]\nmodule = [63, 20]\nphotons = 1e6\nrepeats = 1.5\n", "runs.toml:4"},
      {"[[run]]\nmodule = [63, 20]\nphotons = 1e6\nwidth_deg = 91\n", "runs.toml:4: found beam width 91"},
      {"[[run]]\nmodule = [63, 20]\nphotons = 1e6\nwavelength_nm = 0.405\n", "runs.toml:4: found wavelength"},
      {"[[run]]\nmodule = [63, 20]\nphotons = 1e6\npulse_width_ns = -1\n",
       "runs.toml:4: found pulse width -1"},
      {"[[run]]\nmodule = [63, 20]\nphotons = 1e6\norientation_deg = nan\n", "runs.toml:4"},
      {"[defaults]\nmodule = [63, 20]\n[[run]]\nphotons = 1e6\n",
       "runs.toml:2: found an unknown key 'module'"},
      {"[default]\nphotons = 1e6\n[[run]]\nmodule = [63, 20]\n",
       "runs.toml:1: found an unknown key 'default'"},
      {"photons = 1e6\n[[run]]\nmodule = [63, 20]\n", "runs.toml:1: found an unknown key 'photons'"},
      {"defaults = 1\n[[run]]\nmodule = [63, 20]\n", "runs.toml:1"},
      {"run = 3\n", "runs.toml:1: found 'run = 3'; expected tables [[run]]"},
      {"run = [1, 2]\n", "runs.toml:1"},
      {"[run]\nmodule = [63, 20]\nphotons = 1e6\n", "runs.toml:1: found '[run]'; expected tables [[run]]"},
      {"[[run]]\nmodule = [63, 20]\nphotons = 1e6 1e7\n", "runs.toml:3"},
      {"[[run]]\nmodule = [63, 20]\nphotons = 1e6\nphotons = 1e6\n", "runs.toml:4"},
      {"[[run]]\nmodule = [63, 20\nphotons = 1e6\n", "runs.toml:"},
      {"[[run]]\nmodule = [63, 61]\nphotons = 1e6\n", "unknown"},
      {"\x7f\x45LF\x01", "runs.toml"},
  };
  write("good.toml", good);
  for (const WrongFile& wrong : cases) {
    write("runs.toml", wrong.text);
    SCOPED_TRACE(wrong.text);
    expect_error(floe("simulate --flashers runs.toml --oversize 50 -o x.h5 --json x.json"), 3, wrong.said);
  }
  floe_well("simulate --flashers good.toml --oversize 50 -o good.h5 --quiet");
  expect_error(floe("simulate --flashers none.toml -o x.h5"), 3, "none.toml: found no file of this name");
  EXPECT_EQ(files_in(folder_.path()), (std::set<std::string>{"good.h5", "good.toml", "runs.toml"}));
}

TEST_F(Flashers, WrongTextsAreRefusedWithTheLine) {
  const WrongFile cases[] = {
      {"HIT 20 30 100.0 400.0 1.5 0.5 1.5 0.5\n", "runs.hits:1"},
      {"FLASHER 63 20 wavelength=405\n", "runs.hits:1: found 'wavelength=405'; expected key=value"},
      {"FLASHER 63 20\nHIT 20 30 100.0 400.0\n", "runs.hits:2"},
      {"", "found no flasher run"},
  };
  for (const WrongFile& wrong : cases) {
    write("runs.hits", wrong.text);
    expect_error(floe("import --flashers runs.hits -o x.h5 --json x.json"), 3, wrong.said);
  }
  // After a good run the file has been begun, and goes again.
  write("runs.hits", "FLASHER 63 20\nHIT 20 30 100.0 400.0 1.5 0.5 1.5 0.5\nFLASHER 0 20\n");
  expect_error(floe("import --flashers runs.hits -o x.h5"), 3, "runs.hits:3: found string 0");
  EXPECT_EQ(files_in(folder_.path()), std::set<std::string>{"runs.hits"});
}

}  // namespace
}  // namespace floe::test
