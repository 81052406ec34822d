#include "data/f2k.h"

#include <gtest/gtest.h>

#include "data/event_files.h"
#include "data/event_rules.h"
#include "tests/unit/data/sample_events.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe {

using namespace test;

namespace {

class F2kTest : public ::testing::Test {
 protected:
  std::vector<Event> read(std::string_view content) const {
    write_bytes(folder.path() / "nu.f2k", content);
    return read_f2k(folder.path() / "nu.f2k");
  }
  std::string refusal(std::string_view content) const {
    return message_of<InputError>([&] { read(content); });
  }
  TemporaryFolder folder;
};

}  // namespace

TEST_F(F2kTest, TracksAreParticles) {
  const auto events = read(
      "TR 1 0 e- 20 -40 -300 70 130 0 50000 0\n"
      "TR 2 1 amu+ 1.5 2.5 -3.5 180 720 12.25 1e3 -7.5\n");
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].id, "nu");
  EXPECT_TRUE(events[0].hits.empty());
  expect_same(events[0].truth, sample_truth());
}

// A particle from the zenith travels down; one from the horizon in the west (azimuth 180) travels east.
TEST_F(F2kTest, AnglesSayWhereAParticleComesFrom) {
  const auto truth = read("TR 1 0 e 0 0 0 0 0 0 1 0\nTR 1 0 e 0 0 0 90 -180 0 1 0\n")[0].truth;
  EXPECT_TRUE(travel_direction(truth[0].zenith, truth[0].azimuth).isApprox(Vec3(0, 0, -1), 1e-15));
  EXPECT_TRUE(travel_direction(truth[1].zenith, truth[1].azimuth).isApprox(Vec3(1, 0, 0), 1e-15));
  EXPECT_DOUBLE_EQ(truth[1].azimuth, pi);
}

TEST_F(F2kTest, EmLinesSeparateEvents) {
  const auto events = read(
      "V 2000.1.2\nTBEGIN ? ? ?\n"
      "EM 7 1 1970 0 0 0\nTR 1 0 hadr 0 0 0 10 20 0 1 0\nEE\n"
      "EM 7 1 1970 0 0 0\nTR 1 0 ph 0 0 0 10 20 0 1e6 0\nTR 1 0 munu 0 0 0 1 2 0 3 0\nEE\n"
      "TEND ? ? ?\nEND\n");
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].id, "nu-1");
  EXPECT_EQ(events[1].id, "nu-2");
  EXPECT_EQ(events[0].truth.size(), 1u);
  EXPECT_EQ(events[1].truth.size(), 2u);
}

TEST_F(F2kTest, EveryKnownNameIsTaken) {
  for (const char* name :
       {"e", "e-", "e+", "gamma", "delta", "brems", "epair", "hadr", "munu", "amu", "amu+", "amu-", "ph"}) {
    EXPECT_EQ(read(std::string("TR 1 0 ") + name + " 0 0 0 0 0 0 1 0")[0].truth[0].name, name);
    EXPECT_NE(known_particle_names().find(name), std::string::npos);
  }
}

struct BadTrack {
  const char* text;
  const char* message;
};
class BadTrackTest : public F2kTest, public ::testing::WithParamInterface<BadTrack> {};

TEST_P(BadTrackTest, IsRefusedWithItsLine) {
  const std::string message = refusal(std::string("V 2000.1.2\n") + GetParam().text + "\n");
  EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadTrackTest,
    ::testing::Values(BadTrack{"TR 1 0 nu_mu 0 0 0 0 0 0 1 0", ":2: found particle 'nu_mu'"},
                      BadTrack{"TR 1 0 e- 0 0 0 181 0 0 1 0", ":2: found 181 for zenith [deg]"},
                      BadTrack{"TR 1 0 e- 0 0 0 -1 0 0 1 0", "expected a value from 0 to 180"},
                      BadTrack{"TR 1 0 e- 0 0 0 0 inf 0 1 0", "not finite"},
                      BadTrack{"TR 1 0 e- nan 0 0 0 0 0 1 0", "'nan' (not finite)"},
                      BadTrack{"TR 1 0 e- 0 0 0 0 0 0 0 0", "found energy 0"},
                      BadTrack{"TR 1 0 e- 0 0 0 0 0 0 -5 0", "energy above 0"},
                      BadTrack{"TR 1 0 amu 0 0 0 0 0 -1 1 0", "found length -1"},
                      BadTrack{"TR 1 0 e- 0 0 0 0 0 0 1", "found 11 fields"},
                      BadTrack{"TR 1 0 e- 0 0 0 0 0 0 1 0 9", "found 13 fields"},
                      BadTrack{"TR 1 x e- 0 0 0 0 0 0 1 0", "number of the particle"},
                      BadTrack{"TR 1 0 e- 0 o 0 0 0 0 1 0", "found 'o'; expected a number for y [m]"},
                      BadTrack{"EM 1 1\nEE", ":2: found an event without a particle"},
                      BadTrack{"EM 1 1\nEM 1 2\nTR 1 0 e 0 0 0 0 0 0 1 0", ":2: found an event without"},
                      BadTrack{"END", "no particle"}, BadTrack{"e- 1 2 3", "or another line of f2k"},
                      BadTrack{"tr 1 0 e- 0 0 0 0 0 0 1 0", "or another line of f2k"}));

}  // namespace floe
