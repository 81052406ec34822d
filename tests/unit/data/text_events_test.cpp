// Hits and charges as other tools write them.
#include <gtest/gtest.h>

#include <chrono>

#include "data/base/atomic_file.h"
#include "tests/unit/data/sample_events.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe {

using namespace test;

namespace {

class TextEventsTest : public ::testing::Test {
 protected:
  EventFile read(const char* name, std::string_view content) const {
    write_bytes(folder.path() / name, content);
    return read_event_file(folder.path() / name);
  }
  TemporaryFolder folder;
};

}  // namespace

TEST_F(TextEventsTest, HitLinesHoldPhotons) {
  const EventFile file = read("run.7.hits", "HIT 63 20 123.4 405 0 0 1.5707963 3.1415927\n");
  EXPECT_FALSE(file.provenance);
  ASSERT_EQ(file.events.size(), 1u);
  EXPECT_EQ(file.events[0].id, "run.7");
  EXPECT_TRUE(file.events[0].truth.empty());
  EXPECT_EQ(file.events[0].repeats, 1);
  ASSERT_EQ(file.events[0].hits.size(), 1u);
  const Hit& hit = file.events[0].hits[0];
  EXPECT_EQ(hit.module, (ModuleId{63, 20}));
  EXPECT_EQ(hit.time, 123.4);
  EXPECT_EQ(hit.charge, 1);
  EXPECT_EQ(hit.wavelength, 405);
  EXPECT_TRUE(hit.direction.isApprox(Vec3f(0, 0, 1), 1e-6f));
  EXPECT_TRUE(hit.inward.isApprox(Vec3f(-1, 0, 0), 1e-6f));
}

TEST_F(TextEventsTest, ThePmtOfAModuleIsDropped) {
  const Hit hit = read("a.hits", "HIT 87 5_13 1 400 1 1 1 1").events[0].hits[0];
  EXPECT_EQ(hit.module, (ModuleId{87, 5}));
}

TEST_F(TextEventsTest, AnglesRoundedToAMilliradianMayPassTheirRange) {
  EXPECT_NO_THROW(read("a.hits", "HIT 1 1 1 400 3.142 3.142 0.000 -3.142"));
}

TEST_F(TextEventsTest, TracksAmongTheHitsAreTheTruth) {
  const EventFile file = read("a.hits",
                              "V 2000.1.2\nTBEGIN ? ? ?\nEM 1 1 1970 0 0 0\n"
                              "TR 1 0 e- 20 -40 -300 70 130 0 50000 0\n"
                              "TR 2 1 amu+ 1.5 2.5 -3.5 180 -360 12.25 1000 -7.5\n"
                              "HIT 1 2 3 400 1 1 1 1\nEE\nTEND ? ? ?\nEND\n");
  EXPECT_EQ(file.events[0].hits.size(), 1u);
  expect_same(file.events[0].truth, sample_truth());
}

TEST_F(TextEventsTest, ChargeListsHoldPulses) {
  const EventFile file = read("a.dat", "# string DOM time charge\n1 2 -3.5 0.25\n86 60 1e4 12\n");
  ASSERT_EQ(file.events[0].hits.size(), 2u);
  const Hit& hit = file.events[0].hits[0];
  EXPECT_EQ(hit.module, (ModuleId{1, 2}));
  EXPECT_EQ(hit.time, -3.5);
  EXPECT_EQ(hit.charge, 0.25f);
  EXPECT_FALSE(hit.has_direction());
  EXPECT_TRUE(std::isnan(hit.wavelength));
  EXPECT_EQ(file.events[0].hits[1].module, (ModuleId{86, 60}));
}

TEST_F(TextEventsTest, GzippedTextsAreNamedWithoutBothSuffixes) {
  write_whole_file(folder.path() / "a.dat.gz", "1 2 3 4\n");
  EXPECT_EQ(read_event_file(folder.path() / "a.dat.gz").events[0].id, "a");
}

TEST_F(TextEventsTest, TheReferenceCascadeIsReadWholeAndFast) {
  const std::filesystem::path file = FLOE_SHARED_DIR "/reference/cascade-50tev.hits.gz";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const auto start = std::chrono::steady_clock::now();
  const EventFile result = read_event_file(file);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  RecordProperty("seconds", std::to_string(seconds.count()));
  ASSERT_EQ(result.events.size(), 1u);
  EXPECT_EQ(result.events[0].hits.size(), 103'686u);
  // Photons come from outside the module: the two directions never point against each other by more
  // than their rounding to 1 mrad explains.
  for (const Hit& hit : result.events[0].hits) ASSERT_GT(hit.direction.dot(hit.inward), -2e-3f);
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__)
  EXPECT_LT(seconds.count(), 1.0);  // 0.15 s when measured; the rest is for busy machines
#endif
}

}  // namespace floe
