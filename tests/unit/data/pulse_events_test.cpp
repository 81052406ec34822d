// Event files of pulses: what stands beside them comes back, event by event; and IceTray's tables.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/unit/data/sample_events.h"
#include "tests/unit/data/temporary_folder.h"

#include "data/base/error.h"
#include "data/event_stream.h"
#include "data/hdf5_output.h"
#include "data/icetray_tables.h"

namespace floe {

using namespace test;

namespace {

Event pulse_event(const std::string& id, std::size_t count,
                  const std::shared_ptr<const RecordingModules>& modules) {
  Event event;
  event.id = id;
  event.hits = pulse_hits(count);
  for (Hit& hit : event.hits) hit.width = 1.5f;
  event.readout =
      Readout{-4000, 6000, {0.059, 300, 11000}, {}, modules, {{0.015, 25, 65}, {0.02, 64.5, 77.5}}};
  event.readout->unusable = {{{1, 2}, 10, 20.5, UnusableTimes::Reason::saturated},
                             {{3, 4}, -5, 2445, UnusableTimes::Reason::dead}};
  return event;
}

ModuleWaveform sample_waveform(int repeat, int samples) {
  ModuleWaveform waveform{{Digitiser::atwd1, 12.5, 10.0 / 3, 1.117, 130, {}}, repeat, 3, {5, 6}};
  for (int i = 0; i < samples; ++i) waveform.counts.push_back(130 + i);
  return waveform;
}

class PulseEvents : public ::testing::Test {
 protected:
  std::string message_of_reading(const std::filesystem::path& file,
                                 const std::optional<std::string>& table = {}) {
    try {
      read_icetray_pulses(file, table);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no InputError";
  }

  TemporaryFolder folder;
  std::filesystem::path path = folder.path() / "pulses.h5";
  std::shared_ptr<const RecordingModules> modules =
      std::make_shared<const RecordingModules>(RecordingModules{{{1, 2}, true, 431.5}, {{3, 4}, false, 0}});
};

}  // namespace

TEST_F(PulseEvents, ComeBackWithAllThatStandsBesideThem) {
  Provenance provenance = sample_provenance();
  provenance.pulses = true;
  const std::vector<Hit> photons = photon_hits(7);
  {
    EventFileWriter writer(path, provenance);
    for (const int e : {0, 1, 2}) {
      const Event event = pulse_event("event " + std::to_string(e), static_cast<std::size_t>(5 * e), modules);
      writer.begin_event(event);
      writer.append(event.hits);
      writer.append_photons(e == 1 ? std::span<const Hit>() : photons);
      const ModulePhotoelectron pe{{e + 0.5, 0.25f, PhotoelectronOrigin::afterpulse}, 4, {7, 8}};
      writer.append_photoelectrons(std::vector(static_cast<std::size_t>(e), pe));
      writer.append_waveforms(std::vector{sample_waveform(e, 128), sample_waveform(9, 3)});
    }
    writer.close();
  }
  const EventFileReader reader(path);
  EXPECT_TRUE(reader.provenance().pulses);
  ASSERT_EQ(reader.size(), 3u);
  for (const std::size_t e : {2, 0, 1}) {  // in any order
    SCOPED_TRACE(e);
    const Event expected = pulse_event("event " + std::to_string(e), 5 * e, modules), event = reader.read(e);
    EXPECT_EQ(event.id, expected.id);
    EXPECT_EQ(reader.hit_count(e), expected.hits.size());
    expect_same(event.hits, expected.hits);
    for (const Hit& hit : event.hits) EXPECT_EQ(hit.width, 1.5f);
    ASSERT_TRUE(event.readout);
    EXPECT_EQ(event.readout->begin, -4000);
    EXPECT_EQ(event.readout->end, 6000);
    EXPECT_EQ(event.readout->afterpulses, expected.readout->afterpulses);
    EXPECT_EQ(*event.readout->modules, *modules);
    ASSERT_EQ(event.readout->unusable.size(), 2u);
    EXPECT_EQ(event.readout->unusable[0].module, ModuleId({1, 2}));
    EXPECT_EQ(event.readout->unusable[0].end, 20.5);
    EXPECT_EQ(event.readout->unusable[1].reason, UnusableTimes::Reason::dead);
    EXPECT_EQ(event.readout->delays, expected.readout->delays);
    EXPECT_EQ(reader.photons(e).size(), e == 1 ? 0u : 7u);
    const auto photoelectrons = reader.photoelectrons(e);
    ASSERT_EQ(photoelectrons.size(), e);
    for (const auto& pe : photoelectrons) {
      EXPECT_EQ(pe.time, static_cast<double>(e) + 0.5);
      EXPECT_EQ(pe.origin, PhotoelectronOrigin::afterpulse);
      EXPECT_EQ(pe.repeat, 4);
    }
    const auto waveforms = reader.waveforms(e);
    ASSERT_EQ(waveforms.size(), 2u);
    EXPECT_EQ(waveforms[0].counts, sample_waveform(0, 128).counts);
    EXPECT_EQ(waveforms[0].repeat, static_cast<int>(e));
    EXPECT_EQ(waveforms[0].digitiser, Digitiser::atwd1);
    EXPECT_EQ(waveforms[1].counts.size(), 3u);
    EXPECT_EQ(waveforms[1].launch, 3);
  }
}

TEST_F(PulseEvents, OfOtherModulesAreRefused) {
  Provenance provenance;
  provenance.pulses = true;
  EventFileWriter writer(path, provenance);
  writer.begin_event(pulse_event("a", 1, modules));
  auto others = std::make_shared<const RecordingModules>(RecordingModules{{{1, 2}, true, 0}});
  EXPECT_THROW(writer.begin_event(pulse_event("b", 1, others)), UsageError);
}

TEST_F(PulseEvents, GoThroughIceTraysTables) {
  const std::filesystem::path file = folder.path() / "pulses.i3.h5";
  std::vector<Event> events = {pulse_event("118-5", 200, modules), pulse_event("118-6-1-2", 0, modules),
                               pulse_event("another", 3, modules)};
  write_icetray_pulses(file, events);
  EXPECT_TRUE(is_icetray_file(file));
  const std::vector<Event> back = read_icetray_pulses(file);
  ASSERT_EQ(back.size(), 3u);
  EXPECT_EQ(back[0].id, "118-5");
  EXPECT_EQ(back[1].id, "118-6-1-2");
  EXPECT_EQ(back[2].id, "0-2");
  EXPECT_TRUE(back[1].hits.empty());
  ASSERT_EQ(back[0].hits.size(), 200u);
  double charge = 0, expected = 0;
  for (const Hit& hit : back[0].hits) charge += hit.charge;
  for (const Hit& hit : events[0].hits) expected += hit.charge;
  EXPECT_NEAR(charge, expected, 1e-3);
  for (std::size_t i = 1; i < 200; ++i)  // by module, then time
    EXPECT_LE(std::pair(back[0].hits[i - 1].module, back[0].hits[i - 1].time),
              std::pair(back[0].hits[i].module, back[0].hits[i].time));
  EXPECT_EQ(back[0].hits[0].width, 1.5f);
  EXPECT_EQ(read_event_file(file).events.size(), 3u);
  events[0].repeats = 2;
  EXPECT_THROW(write_icetray_pulses(file, events), UsageError);
}

TEST_F(PulseEvents, TroubleWithIceTraysTablesIsNamed) {
  const std::filesystem::path file = folder.path() / "pulses.i3.h5";
  write_icetray_pulses(file, std::vector{pulse_event("1-1", 3, modules)}, "MyPulses");
  EXPECT_NE(message_of_reading(file, "Other").find("no table 'Other'; expected one of MyPulses"),
            std::string::npos);
  {  // a second table and its index: the same under another name
    const Hdf5Handle h5(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open");
    H5Lcreate_hard(h5, "MyPulses", h5, "MorePulses", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_hard(h5, "__I3Index__/MyPulses", h5, "__I3Index__/MorePulses", H5P_DEFAULT, H5P_DEFAULT);
  }
  EXPECT_NE(message_of_reading(file).find("2 tables of pulses: MorePulses, MyPulses; expected one"),
            std::string::npos)
      << message_of_reading(file);
  EXPECT_EQ(read_icetray_pulses(file, "MorePulses").front().hits.size(), 3u);
  {
    const Hdf5Handle h5(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open");
    H5Ldelete(h5, "MyPulses", H5P_DEFAULT);
    H5Ldelete(h5, "MorePulses", H5P_DEFAULT);
  }
  EXPECT_NE(message_of_reading(file).find("no table with the columns"), std::string::npos);
}

}  // namespace floe
