// Flasher runs in event files: what is known of a run comes back with its event.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "data/base/error.h"
#include "data/hdf5_schema.h"
#include "tests/unit/data/sample_events.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe {

using namespace test;
using namespace hdf5;

namespace {

class FlasherEvents : public ::testing::Test {
 protected:
  // An event that is no run between two that are, the last one with nothing known.
  static std::vector<Event> runs() {
    FlasherRun bare;
    bare.module = {1, 2};
    return {{"63,20", photon_hits(20), {}, 1, sample_flasher()},
            {"cascade", photon_hits(3), sample_truth(), 1},
            {"1,2", pulse_hits(4), {}, 240, bare}};
  }
  Hdf5Handle open(unsigned mode) const {
    return {H5Fopen(path.c_str(), mode, H5P_DEFAULT), H5Fclose, "open"};
  }
  bool has_runs() const { return H5Lexists(open(H5F_ACC_RDONLY), "flashers", H5P_DEFAULT) > 0; }

  // Writes good runs, changes the second row of their table, and gives back what a reader says.
  std::string refusal_of(const std::function<void(FlasherRow&)>& edit) const {
    write_events(path, runs());
    {
      const Hdf5Handle file = open(H5F_ACC_RDWR);
      const Hdf5Handle table(H5Dopen2(file, "flashers", H5P_DEFAULT), H5Dclose, "open");
      const Hdf5Handle type = row_type_in_memory(Table<FlasherRow>::columns(), sizeof(FlasherRow));
      std::vector<FlasherRow> rows(2);
      checked(H5Dread(table, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()), "read");
      edit(rows[1]);
      checked(H5Dwrite(table, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()), "write");
    }
    return message_of<InputError>([&] { read_event_file(path); });
  }

  TemporaryFolder folder;
  std::filesystem::path path = folder.path() / "flashers.h5";
};

}  // namespace

TEST_F(FlasherEvents, ComeBackAsTheyWere) {
  const std::vector<Event> expected = runs();
  write_events(path, expected);
  EXPECT_TRUE(has_runs());
  const std::vector<Event> events = read_event_file(path).events;
  ASSERT_EQ(events.size(), 3u);
  for (std::size_t i : {0, 2}) {
    ASSERT_TRUE(events[i].flasher) << i;
    expect_same(*events[i].flasher, *expected[i].flasher);
    EXPECT_EQ(events[i].repeats, expected[i].repeats);
    expect_same(events[i].hits, expected[i].hits);
  }
  EXPECT_FALSE(events[1].flasher);
}

TEST_F(FlasherEvents, TheLastRowIsWrittenToo) {
  std::vector<Event> many;
  for (int i = 0; i < 300; ++i) many.push_back({std::to_string(i), {}, {}, 1, sample_flasher()});
  write_events(path, many);
  for (const Event& event : read_event_file(path).events) EXPECT_TRUE(event.flasher) << event.id;
}

TEST_F(FlasherEvents, WithoutRunsThereIsNoTable) {
  write_events(path, {{"a", photon_hits(3), {}, 1}});
  EXPECT_FALSE(has_runs());
  EXPECT_FALSE(read_event_file(path).events[0].flasher);
}

TEST_F(FlasherEvents, ImpossibleRunsAreNotStored) {
  FlasherRun run = sample_flasher();
  run.photons = -1;
  EventFileWriter writer(path, {});
  EXPECT_THROW(writer.begin_event("a", {}, 1, run), UsageError);
}

TEST_F(FlasherEvents, WrongRowsAreRefused) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  struct Case {
    const char* said;
    std::function<void(FlasherRow&)> edit;
  };
  const Case cases[] = {
      {"event 3 in row 1 of 'flashers'", [](FlasherRow& row) { row.event = 3; }},
      {"event 0 in row 1 of 'flashers'", [](FlasherRow& row) { row.event = 0; }},
      {"event 18446744073709551615 in row 1", [](FlasherRow& row) { row.event = ~0ull; }},
      {"LEDs 'rung' in row 1 of 'flashers'; expected ring, horizontal",
       [](FlasherRow& row) { memcpy(row.leds, "rung", 4); }},
      {"LEDs '' in row 1", [](FlasherRow& row) { memset(row.leds, 0, sizeof(row.leds)); }},
      {"LEDs 'xxxxxxxxxxxxxxxx' in row 1", [](FlasherRow& row) { memset(row.leds, 'x', sizeof(row.leds)); }},
      {"string 0 in row 1", [](FlasherRow& row) { row.string = 0; }},
      {"DOM -1 in row 1", [](FlasherRow& row) { row.dom = -1; }},
      {"orientation inf", [=](FlasherRow& row) { row.orientation_deg = infinite; }},
      {"wavelength 40.5", [](FlasherRow& row) { row.wavelength_nm = 40.5; }},
      {"beam width nan", [](FlasherRow& row) { row.width_deg = FlasherRun::unknown; }},
      {"pulse width inf", [=](FlasherRow& row) { row.pulse_width_ns = infinite; }},
      {"number of photons 0", [](FlasherRow& row) { row.photons = 0; }},
      {"oversize 0", [](FlasherRow& row) { row.oversize = 0; }},
  };
  for (const Case& test_case : cases) {
    const std::string message = refusal_of(test_case.edit);
    EXPECT_NE(message.find(test_case.said), std::string::npos) << message;
    EXPECT_EQ(message.find(path.string()), 0u) << message;
  }
}

TEST_F(FlasherEvents, ATableOfOtherColumnsIsRefused) {
  write_events(path, {{"a", photon_hits(3), {}, 1}});
  {
    const Hdf5Handle file = open(H5F_ACC_RDWR);
    const auto all = Table<FlasherRow>::columns();
    const hsize_t rows = 1;
    const Hdf5Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose, "describe");
    const Hdf5Handle table(H5Dcreate2(file, "flashers", row_type_in_file(all.first(all.size() - 1)), space,
                                      H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           H5Dclose, "create");
  }
  const std::string message = message_of<InputError>([&] { read_event_file(path); });
  EXPECT_NE(message.find("no column 'oversize' in 'flashers'"), std::string::npos) << message;
}

}  // namespace floe
