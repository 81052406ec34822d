// floe's own event files: what goes in comes out, and a file is whole or not there.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include "tests/unit/data/sample_events.h"
#include "tests/unit/data/temporary_folder.h"

#include "data/base/error.h"

namespace floe {

using namespace test;

namespace {

// Ends the process with 5 and the message when the writer throws OutputError.
void write_on_a_full_disk(const std::filesystem::path& path) {
  signal(SIGXFSZ, SIG_IGN);
  const rlimit small{200'000, 200'000};
  setrlimit(RLIMIT_FSIZE, &small);
  try {
    write_events(path, {{"a", photon_hits(40'000), {}, 1}});
  } catch (const OutputError& error) {
    fprintf(stderr, "%s", error.what());
    _exit(5);
  }
}

class Hdf5EventsTest : public ::testing::Test {
 protected:
  TemporaryFolder folder;
  std::filesystem::path path = folder.path() / "events.h5";
};

}  // namespace

TEST_F(Hdf5EventsTest, EventsComeBackAsTheyWere) {
  const std::vector<Event> events = {{"first", photon_hits(1000), sample_truth(), 1},
                                     {"without hits", {}, {sample_truth()[0]}, 2.5},
                                     {"pulses, \"é\"", pulse_hits(3), {}, 10}};
  write_events(path, events);
  const EventFile file = read_event_file(path);
  ASSERT_EQ(file.events.size(), events.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    SCOPED_TRACE(events[i].id);
    EXPECT_EQ(file.events[i].id, events[i].id);
    EXPECT_EQ(file.events[i].repeats, events[i].repeats);
    expect_same(file.events[i].hits, events[i].hits);
    expect_same(file.events[i].truth, events[i].truth);
  }
}

TEST_F(Hdf5EventsTest, ProvenanceComesBack) {
  write_events(path, {{"a", photon_hits(1), {}, 1}});
  const Provenance expected = sample_provenance();
  const std::optional<Provenance> got = read_event_file(path).provenance;
  ASSERT_TRUE(got);
  EXPECT_EQ(got->version, expected.version);
  EXPECT_EQ(got->command, expected.command);
  EXPECT_EQ(got->configuration, expected.configuration);
  EXPECT_EQ(got->ice_name, expected.ice_name);
  EXPECT_EQ(got->ice_hash, expected.ice_hash);
  EXPECT_EQ(got->detector_name, expected.detector_name);
  EXPECT_EQ(got->detector_hash, expected.detector_hash);
  EXPECT_EQ(got->seed, expected.seed);
  EXPECT_EQ(got->oversize, expected.oversize);
}

TEST_F(Hdf5EventsTest, ProvenanceMayBeEmptyOrLong) {
  Provenance provenance;
  provenance.configuration = std::string(300'000, 'x');
  EventFileWriter writer(path, provenance);
  writer.begin_event("a", {});
  writer.close();
  const EventFile file = read_event_file(path);
  EXPECT_EQ(file.provenance->configuration, provenance.configuration);
  EXPECT_EQ(file.provenance->command, "");
}

// More rows than a chunk, handed over in portions that fit none.
TEST_F(Hdf5EventsTest, HitsMayComeInPortions) {
  const std::vector<Hit> hits = photon_hits(50'000);
  EventFileWriter writer(path, {});
  writer.begin_event("before", {});
  writer.append(std::span(hits).first(7));
  writer.begin_event("long", sample_truth());
  for (std::size_t i = 0; i < hits.size(); i += 777)
    writer.append(std::span(hits).subspan(i, std::min<std::size_t>(777, hits.size() - i)));
  writer.append({});
  writer.close();
  const EventFile file = read_event_file(path);
  EXPECT_EQ(file.events[0].hits.size(), 7u);
  expect_same(file.events[1].hits, hits);
}

TEST_F(Hdf5EventsTest, ManyEventsKeepTheirHits) {
  std::vector<Event> events;
  for (int i = 0; i < 1000; ++i)
    events.push_back({std::to_string(i), photon_hits(static_cast<std::size_t>(i % 5), 1 + i), {}, 1});
  write_events(path, events);
  const EventFile file = read_event_file(path);
  ASSERT_EQ(file.events.size(), events.size());
  for (std::size_t i = 0; i < events.size(); ++i) expect_same(file.events[i].hits, events[i].hits);
}

TEST_F(Hdf5EventsTest, TheSameEventsGiveTheSameBytes) {
  const std::vector<Event> events = {{"a", photon_hits(100), sample_truth(), 1}};
  write_events(path, events);
  write_events(folder.path() / "again.h5", events);
  EXPECT_EQ(bytes_of(path), bytes_of(folder.path() / "again.h5"));
}

TEST_F(Hdf5EventsTest, IsKnownByContentWhateverItsName) {
  write_events(folder.path() / "events.dat", {{"a", photon_hits(3), {}, 1}});
  EXPECT_EQ(read_event_file(folder.path() / "events.dat").events[0].hits.size(), 3u);
}

TEST_F(Hdf5EventsTest, AWriterThatDiesLeavesNothing) {
  {
    EventFileWriter writer(path, sample_provenance());
    writer.begin_event("a", sample_truth());
    writer.append(photon_hits(40'000));
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST_F(Hdf5EventsTest, AWriterThatDiesLeavesTheOldFile) {
  write_bytes(path, "old");
  {
    EventFileWriter writer(path, sample_provenance());
    writer.begin_event("a", {});
  }
  EXPECT_EQ(bytes_of(path), "old");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST_F(Hdf5EventsTest, AKilledProcessLeavesNothingUnderTheName) {
  EXPECT_EXIT(
      {
        EventFileWriter writer(path, sample_provenance());
        writer.begin_event("a", {});
        writer.append(photon_hits(40'000));
        raise(SIGKILL);
      },
      ::testing::KilledBySignal(SIGKILL), "");
  EXPECT_FALSE(std::filesystem::exists(path));
}

// A limit on the size of files stands for a full disk.
TEST_F(Hdf5EventsTest, AFullDiskIsAnError) {
  EXPECT_EXIT(write_on_a_full_disk(path), ::testing::ExitedWithCode(5), "cannot be written");
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST_F(Hdf5EventsTest, TheFolderMustExist) {
  EXPECT_THROW(EventFileWriter(folder.path() / "none" / "a.h5", {}), OutputError);
}

TEST_F(Hdf5EventsTest, NothingIsStoredThatCouldNotBeRead) {
  EventFileWriter writer(path, {});
  EXPECT_THROW(writer.append(photon_hits(1)), std::logic_error);
  EXPECT_THROW(writer.close(), std::logic_error);
  EXPECT_THROW(writer.begin_event("", {}), UsageError);
  EXPECT_THROW(writer.begin_event("a", {}, 0), UsageError);
  Particle unknown = sample_truth()[0];
  unknown.name = "tau";
  EXPECT_THROW(writer.begin_event("a", {unknown}), UsageError);
  writer.begin_event("a", {});
  EXPECT_THROW(writer.begin_event("a", {}), UsageError);
  Hit late = photon_hits(1)[0];
  late.time = std::numeric_limits<double>::infinity();
  EXPECT_THROW(writer.append({&late, 1}), UsageError);
}

}  // namespace floe
