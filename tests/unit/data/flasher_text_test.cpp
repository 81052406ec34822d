// Sets of flasher runs as text: read run by run, and written again.
#include <gtest/gtest.h>

#include "data/base/atomic_file.h"
#include "data/base/error.h"
#include "data/base/text.h"
#include "data/flasher_text.h"
#include "tests/unit/data/sample_events.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe {

using namespace test;

namespace {

#define GOOD_HIT "HIT 1 2 3.5 400 1 1 1 1\n"
#define GOOD_RECEIVER "1 2 3.5 0.25\n"

class FlasherText : public ::testing::Test {
 protected:
  std::vector<Event> read(const char* name, std::string_view content) const {
    write_whole_file(folder.path() / name, content);
    return read(folder.path() / name);
  }
  static std::vector<Event> read(const std::filesystem::path& file) {
    std::vector<Event> runs;
    for_each_flasher_run(file, [&runs](const Event& run) { runs.push_back(run); });
    return runs;
  }
  TemporaryFolder folder;
};

}  // namespace

TEST_F(FlasherText, ALineOpensEachRun) {
  for (const char* name : {"set.txt", "set.hits", "set.txt.gz"}) {
    const auto runs =
        read(name,
             "# two runs and a dark one\n"
             "FLASHER 63 20 wavelength_nm=405 width_deg=9.7 photons=2000000000 oversize=16\n" GOOD_HIT
             "HIT 63 22 552.3 406 1.135 2.094 0.793 2.030\n"
             "FLASHER 55 44\n"
             "FLASHER 63 20 leds=3 orientation_deg=-30 pulse_width_ns=70\n" GOOD_HIT);
    ASSERT_EQ(runs.size(), 3u);
    EXPECT_EQ(runs[0].id, "63,20");
    EXPECT_EQ(runs[1].id, "55,44");
    EXPECT_EQ(runs[2].id, "63,20-2");
    ASSERT_EQ(runs[0].hits.size(), 2u);
    EXPECT_EQ(runs[0].hits[1].module, (ModuleId{63, 22}));
    EXPECT_EQ(runs[0].hits[1].charge, 1);
    EXPECT_TRUE(runs[1].hits.empty());
    EXPECT_EQ(runs[2].hits.size(), 1u);
    expect_same(*runs[0].flasher, {{63, 20}, {}, FlasherRun::unknown, 405, 9.7 * degree, 0, 2e9, 16});
    FlasherRun bare;
    bare.module = {55, 44};
    expect_same(*runs[1].flasher, bare);
    expect_same(*runs[2].flasher, {{63, 20},
                                   {LedPattern::Kind::single, 3},
                                   -30 * degree,
                                   405,
                                   9.7 * degree,
                                   70,
                                   FlasherRun::unknown,
                                   1});
  }
}

// Photons of four flashes are worth a quarter each; averages stay what they are.
TEST_F(FlasherText, RepeatedFlashesAreAnAverage) {
  const auto photons = read("a.hits", "FLASHER 1 1 repeats=4\n" GOOD_HIT GOOD_HIT);
  EXPECT_EQ(photons.at(0).repeats, 4);
  EXPECT_EQ(photons[0].hits[0].charge, 0.25f);
  const auto charges =
      read("a.dat", "FLASHER 1 1 repeats=240\n" GOOD_RECEIVER "1 2 -3 12\nFLASHER 1 2\n" GOOD_RECEIVER);
  ASSERT_EQ(charges.size(), 2u);
  EXPECT_EQ(charges[0].repeats, 240);
  EXPECT_EQ(charges[0].hits.at(1).charge, 12);
  EXPECT_EQ(charges[1].repeats, 1);
}

TEST_F(FlasherText, IsWrittenAgainByExport) {
  std::vector<Hit> quarter = photon_hits(2, 7);
  for (Hit& hit : quarter) hit.charge = 0.25f;
  FlasherRun bare;
  bare.module = {55, 44};
  const std::vector<Event> expected = {{"63,20", photon_hits(100), {}, 1, sample_flasher()},
                                       {"dark", {}, {}, 1, bare},
                                       {"repeated", quarter, {}, 4, sample_flasher()}};
  for (const char* name : {"out.hits", "out.hits.gz"}) {
    const auto file = folder.path() / name;
    export_events(file, EventFormat::hits, expected);
    const auto runs = read(file);
    ASSERT_EQ(runs.size(), expected.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
      expect_same(*runs[i].flasher, *expected[i].flasher);
      EXPECT_EQ(runs[i].repeats, expected[i].repeats);
      ASSERT_EQ(runs[i].hits.size(), expected[i].hits.size());
      for (std::size_t k = 0; k < runs[i].hits.size(); ++k) {
        EXPECT_EQ(runs[i].hits[k].module, expected[i].hits[k].module);
        EXPECT_EQ(runs[i].hits[k].charge, expected[i].hits[k].charge);
        EXPECT_NEAR(runs[i].hits[k].time, expected[i].hits[k].time, 0.5001e-3);
      }
    }
    EXPECT_EQ(runs[2].id, "63,20-2");
  }
}

TEST_F(FlasherText, SaysWhatIsKnownInOneLine) {
  Event event;
  event.flasher = sample_flasher();
  event.repeats = 240;
  EXPECT_EQ(flasher_line(event),
            "FLASHER 63 20 leds=9 orientation_deg=-30 wavelength_nm=370 width_deg=5 pulse_width_ns=70 "
            "photons=25000000000 repeats=240 oversize=16\n");
  event.flasher = FlasherRun{};
  event.flasher->module = {1, 2};
  event.repeats = 1;
  EXPECT_EQ(flasher_line(event),
            "FLASHER 1 2 leds=ring wavelength_nm=405 width_deg=9.7 pulse_width_ns=0 repeats=1 oversize=1\n");
}

TEST_F(FlasherText, WhatAFormatCannotSayIsNotExported) {
  const auto refusal = [&](EventFormat format, const std::vector<Event>& events) {
    return message_of<UsageError>([&] { export_events(folder.path() / "x", format, events); });
  };
  const Event run{"63,20", photon_hits(1), {}, 1, sample_flasher()};
  const Event cascade{"cascade", photon_hits(1), {}, 1};
  EXPECT_NE(refusal(EventFormat::hits, {run, cascade}).find("set of flasher runs"), std::string::npos);
  EXPECT_NE(refusal(EventFormat::dat, {run, run}).find("one event, not 2"), std::string::npos);
  Event averaged = run;
  averaged.repeats = 3;
  EXPECT_NE(refusal(EventFormat::hits, {averaged}).find("1 photoelectrons"), std::string::npos);
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST_F(FlasherText, WrongLinesAreRefused) {
  struct Case {
    const char *name, *content, *said;
  };
  const Case cases[] = {
      {"a.hits", "", "found no flasher run"},
      {"a.hits", GOOD_HIT,
       ":1: found 'HIT 1 2 3.5 400 1 1 1 1'; expected 'FLASHER string DOM key=value ...'"},
      {"a.dat", GOOD_RECEIVER, ":1: found '1 2 3.5 0.25'; expected 'FLASHER"},
      {"a.hits", "FLASHER 63\n", ":1: found 2 fields"},
      {"a.hits", "FLASHER 63 twenty\n", "expected a whole number for DOM"},
      {"a.hits", "FLASHER 0 20\n", ":1: found string 0"},
      {"a.hits", "FLASHER 1 1\nFLASHER 63 20 wavelength=405\n",
       ":2: found 'wavelength=405'; expected key=value"},
      {"a.hits", "FLASHER 63 20 405\n",
       "found '405'; expected key=value with one of the keys leds, orientation"},
      {"a.hits", "FLASHER 63 20 leds\n", "found 'leds'"},
      {"a.hits", "FLASHER 63 20 leds=13\n", "found leds='13'; expected ring, horizontal, tilted"},
      {"a.hits", "FLASHER 63 20 photons=2e9x\n", "found '2e9x'; expected a number for photons in field 4"},
      {"a.hits", "FLASHER 63 20 photons=\n", "found ''; expected a number for photons"},
      {"a.hits", "FLASHER 63 20 photons=nan\n", "(not finite)"},
      {"a.hits", "FLASHER 63 20 photons=1 leds=ring photons=1\n",
       "found 'photons=1' again; expected each key once"},
      {"a.hits", "FLASHER 63 20 width_deg=180\n", "found beam width 1"},
      {"a.hits", "FLASHER 63 20 repeats=0\n", "found 0 for repeats"},
      {"a.hits", "FLASHER 63 20 oversize=0\n", "found oversize 0"},
      {"a.hits", "FLASHER 63 20\n" GOOD_RECEIVER, "read from a file named .dat"},
      {"a.hits", "FLASHER 63 20\nTR 1 0 e- 0 0 0 0 0 0 1 0\n", ":2: found 'TR 1 0"},
      {"a.hits", "FLASHER 63 20\nHIT 1 2 3.5 400 1 1 1\n", ":2: found 8 fields"},
      {"a.dat", "FLASHER 63 20\n" GOOD_HIT, ":2: found 9 fields"},
      {"a.dat", "FLASHER 63 20\n1 2 3 -1\n", ":2: found charge -1"},
      {"a.csv", "FLASHER 63 20\n", "found the suffix '.csv'"},
      {"a", "FLASHER 63 20\n", "found the suffix ''"},
  };
  for (const Case& test_case : cases) {
    const auto message = message_of<InputError>([&] { read(test_case.name, test_case.content); });
    EXPECT_NE(message.find(test_case.said), std::string::npos) << test_case.content << message;
    EXPECT_EQ(message.find((folder.path() / test_case.name).string()), 0u) << message;
  }
  EXPECT_NE(message_of<InputError>([&] { read(folder.path() / "none.hits"); }).find("no file"),
            std::string::npos);
}

TEST_F(FlasherText, TheReferenceSetIsReadWhole) {
  const std::filesystem::path file = FLOE_SHARED_DIR "/reference/hidden-T0/hits.txt.gz";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  std::vector<std::string> names;
  std::size_t hits = 0;
  for_each_flasher_run(file, [&](const Event& run) {
    names.push_back(run.id);
    hits += run.hits.size();
    EXPECT_EQ(run.flasher->photons, 2e9);
    EXPECT_EQ(run.flasher->oversize, 16);
    for (const Hit& hit : run.hits) ASSERT_NE(hit.module, run.flasher->module) << "its own light";
  });
  EXPECT_EQ(names, (std::vector<std::string>{"63,20", "55,44", "38,16", "47,30", "28,50", "71,36"}));
  EXPECT_GT(hits, 100'000u);
}

}  // namespace floe
