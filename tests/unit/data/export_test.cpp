#include <gtest/gtest.h>

#include <sstream>

#include "data/base/error.h"
#include "data/base/text.h"
#include "tests/unit/data/sample_events.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe {

using namespace test;

namespace {

class ExportTest : public ::testing::Test {
 protected:
  // Writes events and gives back what a reader makes of them.
  std::vector<Hit> round_trip(const char* name, const std::vector<Hit>& hits) const {
    const std::vector<Event> events = {{"a", hits, {}, 1}};
    export_events(folder.path() / name, event_format_of(name), events);
    return read_event_file(folder.path() / name).events.at(0).hits;
  }
  std::string refusal(EventFormat format, const std::vector<Event>& events) const {
    const auto message = message_of<UsageError>([&] { export_events(folder.path() / "a", format, events); });
    EXPECT_EQ(folder.file_count(), 0u) << "a refused export leaves no file";
    return message;
  }
  TemporaryFolder folder;
};

}  // namespace

TEST_F(ExportTest, HitTextsAreExactToTheirDigits) {
  const std::vector<Hit> hits = photon_hits(30'000);  // more than one portion of text
  for (const char* name : {"a.hits", "b.hits.gz"}) {
    const std::vector<Hit> got = round_trip(name, hits);
    ASSERT_EQ(got.size(), hits.size());
    for (std::size_t i = 0; i < hits.size(); ++i) {
      ASSERT_EQ(got[i].module, hits[i].module);
      ASSERT_NEAR(got[i].time, hits[i].time, 0.5001e-3);
      ASSERT_NEAR(got[i].wavelength, hits[i].wavelength, 0.6e-3);
      // Half a digit in each angle, and the rounding of three floats.
      ASSERT_LT((got[i].direction - hits[i].direction).norm(), 1e-6f);
      ASSERT_LT((got[i].inward - hits[i].inward).norm(), 1e-6f);
    }
  }
}

TEST_F(ExportTest, DirectionsNearThePolesKeepTheirPrecision) {
  Hit hit = photon_hits(1)[0];
  hit.direction = unit_vector(1e-4, 1).cast<float>();
  hit.inward = unit_vector(pi - 1e-4, -2).cast<float>();
  const Hit got = round_trip("a.hits", {hit})[0];
  EXPECT_LT((got.direction - hit.direction).norm(), 1e-6f);
  EXPECT_LT((got.inward - hit.inward).norm(), 1e-6f);
}

TEST_F(ExportTest, ChargeListsKeepModuleTimeAndCharge) {
  const std::vector<Hit> hits = pulse_hits(1000);
  expect_same(round_trip("a.dat", hits), hits);
  expect_same(round_trip("b.dat.gz", hits), hits);
}

TEST_F(ExportTest, CsvNamesEventsAndLeavesTheUnknownEmpty) {
  Hit photon = photon_hits(1)[0];
  photon.module = {63, 20};
  photon.time = 1.0625;
  photon.wavelength = 400;
  photon.direction = {0, 0, 1};
  photon.inward = {0, -1, 0};
  const std::vector<Event> events = {{"a", {photon}, {}, 1}, {"b, \"c\"", {pulse_hits(2)[1]}, {}, 1}};
  export_events(folder.path() / "a.csv", EventFormat::csv, events);
  EXPECT_EQ(bytes_of(folder.path() / "a.csv"),
            "event,string,dom,time_ns,charge_pe,wavelength_nm,direction_x,direction_y,direction_z,"
            "inward_x,inward_y,inward_z\n"
            "a,63,20,1.062,1,400,0,0,1,0,-1,0\n"
            "\"b, \"\"c\"\"\",2,2,0.125,0.11,,,,,,,\n");
  export_events(folder.path() / "a.csv.gz", EventFormat::csv, events);
  EXPECT_EQ(read_whole_file(folder.path() / "a.csv.gz"), bytes_of(folder.path() / "a.csv"));
}

TEST_F(ExportTest, WhatAFormatCannotSayIsRefused) {
  EXPECT_NE(refusal(EventFormat::hits, {{"a", pulse_hits(1), {}, 1}}).find(".dat"), std::string::npos);
  Hit heavy = photon_hits(1)[0];
  heavy.charge = 2;
  EXPECT_NE(refusal(EventFormat::hits, {{"a", {heavy}, {}, 1}}).find("2 photoelectrons"), std::string::npos);
  Hit colourless = photon_hits(1)[0];
  colourless.wavelength = Hit::unknown;
  EXPECT_NE(refusal(EventFormat::hits, {{"a", {colourless}, {}, 1}}).find("wavelength"), std::string::npos);
  const Event event{"a", photon_hits(1), {}, 1};
  EXPECT_NE(refusal(EventFormat::hits, {event, event}).find(".csv"), std::string::npos);
  EXPECT_NE(refusal(EventFormat::dat, {event, event}).find(".csv"), std::string::npos);
  EXPECT_NE(refusal(EventFormat::dat, {}).find("no event"), std::string::npos);
}

TEST(EventFormatTest, GoesBySuffix) {
  EXPECT_EQ(event_format_of("x/a.hits"), EventFormat::hits);
  EXPECT_EQ(event_format_of("a.dat.gz"), EventFormat::dat);
  EXPECT_EQ(event_format_of("a.b.csv"), EventFormat::csv);
  for (const char* name : {"a", "a.h5", "a.gz", "a.hits.bz2", ".csv"})
    EXPECT_THROW(event_format_of(name), UsageError) << name;
}

}  // namespace floe
