// HDF5 files that are wrong in one place each, made by editing a good one with the HDF5 library.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "data/base/error.h"
#include "data/event_stream.h"
#include "data/hdf5_readout_schema.h"
#include "data/hdf5_schema.h"
#include "tests/unit/data/sample_events.h"
#include "tests/unit/data/temporary_folder.h"

#ifdef __SANITIZE_ADDRESS__
// HDF5 1.10 itself loses memory when it gives up on a damaged file.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}
#endif

namespace floe {

using namespace test;
using namespace hdf5;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr float not_a_number = Hit::unknown;

// Two events: 20 photons with two particles, 10 pulses with none.
std::filesystem::path good_file(const TemporaryFolder& folder) {
  const auto path = folder.path() / "events.h5";
  write_events(path, {{"one", photon_hits(20), sample_truth(), 1}, {"two", pulse_hits(10), {}, 1}});
  return path;
}

Hdf5Handle editable(const std::filesystem::path& path) {
  return {H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open"};
}

template <typename Row>
void edit_row(hid_t file, hsize_t index, const std::function<void(Row&)>& edit) {
  const Hdf5Handle type = row_type_in_memory(Table<Row>::columns(), sizeof(Row));
  const Hdf5Handle table(H5Dopen2(file, Table<Row>::name, H5P_DEFAULT), H5Dclose, "open");
  const Hdf5Handle in_file(H5Dget_space(table), H5Sclose, "select");
  const hsize_t one = 1;
  checked(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, &index, nullptr, &one, nullptr), "select");
  const Hdf5Handle in_memory(H5Screate_simple(1, &one, nullptr), H5Sclose, "select");
  Row row;
  checked(H5Dread(table, type, in_memory, in_file, H5P_DEFAULT, &row), "read");
  edit(row);
  checked(H5Dwrite(table, type, in_memory, in_file, H5P_DEFAULT, &row), "write");
}

void set_attribute(hid_t file, const char* name, hid_t type, const void* value) {
  checked(H5Adelete(file, name), "delete");
  const Hdf5Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "describe");
  const Hdf5Handle attribute(H5Acreate2(file, name, type, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                             "create");
  checked(H5Awrite(attribute, type, value), "write");
}

void set_extent(hid_t file, const char* name, hsize_t rows) {
  const Hdf5Handle table(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose, "open");
  checked(H5Dset_extent(table, &rows), "extend");
}

// A table like the good one of hits, with other columns.
void replace_hits(hid_t file, const std::vector<Column>& columns) {
  checked(H5Ldelete(file, "hits", H5P_DEFAULT), "delete");
  const hsize_t rows = 30;
  const Hdf5Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose, "describe");
  const Hdf5Handle table(
      H5Dcreate2(file, "hits", row_type_in_file(columns), space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose, "create");
}

std::vector<Column> hit_columns() {
  const auto columns = Table<HitRow>::columns();
  return {columns.begin(), columns.end()};
}

}  // namespace

struct MalformedHdf5 {
  const char* what;  // is wrong
  std::function<void(hid_t file)> edit;
  const char* message;  // part of the error
};
void PrintTo(const MalformedHdf5& malformed, std::ostream* out) {
  *out << malformed.what;
}

class MalformedHdf5Test : public ::testing::TestWithParam<MalformedHdf5> {};

TEST_P(MalformedHdf5Test, IsRefusedWithAMessageThatHelps) {
  const TemporaryFolder folder;
  const auto path = good_file(folder);
  GetParam().edit(editable(path));
  const std::string message = message_of<InputError>([&] { read_event_file(path); });
  EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
  EXPECT_EQ(message.find(path.string()), 0u) << message;
}

template <typename Row>
MalformedHdf5 bad_row(const char* what, hsize_t index, std::function<void(Row&)> edit, const char* message) {
  return {what, [=](hid_t file) { edit_row<Row>(file, index, edit); }, message};
}
MalformedHdf5 bad_hit(const char* what, std::function<void(HitRow&)> edit, const char* message) {
  return bad_row<HitRow>(what, 25, std::move(edit), message);
}
MalformedHdf5 bad_event(const char* what, std::function<void(EventRow&)> edit, const char* message) {
  return bad_row<EventRow>(what, 1, std::move(edit), message);
}
MalformedHdf5 bad_particle(const char* what, std::function<void(ParticleRow&)> edit, const char* message) {
  return bad_row<ParticleRow>(what, 1, std::move(edit), message);
}

INSTANTIATE_TEST_SUITE_P(
    Values, MalformedHdf5Test,
    ::testing::Values(
        bad_hit(
            "NaN time", [](auto& r) { r.time_ns = not_a_number; },
            "time nan (not finite) in row 25 of 'hits'"),
        bad_hit(
            "infinite time", [](auto& r) { r.time_ns = infinity; }, "time inf (not finite)"),
        bad_hit(
            "zero charge", [](auto& r) { r.charge_pe = 0; }, "charge 0"),
        bad_hit(
            "infinite charge", [](auto& r) { r.charge_pe = float(infinity); }, "charge inf"),
        bad_hit(
            "NaN charge", [](auto& r) { r.charge_pe = not_a_number; }, "charge nan"),
        bad_hit(
            "string 0", [](auto& r) { r.string = 0; }, "string 0 in row 25"),
        bad_hit(
            "negative DOM", [](auto& r) { r.dom = -5; }, "DOM -5"),
        bad_hit(
            "infinite wavelength", [](auto& r) { r.wavelength_nm = float(infinity); }, "wavelength inf"),
        bad_hit(
            "half a direction", [](auto& r) { r.direction_x = 1; }, "photon direction (1, nan, nan)"),
        bad_hit(
            "direction of length 2", [](auto& r) { r.inward_x = 2, r.inward_y = r.inward_z = 0; },
            "expected a unit vector"),
        bad_event(
            "hits from the event before", [](auto& r) { r.first_hit = 19; }, "begin at 19; expected 20"),
        bad_event(
            "hits after a gap", [](auto& r) { r.first_hit = 21; }, "begin at 21; expected 20"),
        bad_event(
            "more hits than rows", [](auto& r) { r.hit_count = 11; }, "with 11 rows of 'hits'"),
        bad_event(
            "count that wraps around", [](auto& r) { r.hit_count = ~0ull; }, "at most the 10 that are left"),
        bad_event(
            "hits of no event", [](auto& r) { r.hit_count = 9; }, "1 rows of 'hits' that belong to no event"),
        bad_event(
            "more particles than rows", [](auto& r) { r.particle_count = 1; }, "rows of 'particles'"),
        bad_event(
            "no name", [](auto& r) { r.id[0] = 0; }, "event name ''"),
        bad_event(
            "a name twice", [](auto& r) { memcpy(r.id, "one", 3); }, "a second event named 'one'"),
        bad_event(
            "repeats 0", [](auto& r) { r.repeats = 0; }, "number of repeats 0"),
        bad_particle(
            "unknown particle", [](auto& r) { r.name[0] = 'x'; }, "particle 'xmu+' in row 1"),
        bad_particle(
            "NaN position", [](auto& r) { r.y = not_a_number; }, "position (1.5, nan, -3.5)"),
        bad_particle(
            "zenith beyond 180", [](auto& r) { r.zenith_deg = 181; }, "expected 0 to 180 [deg]"),
        bad_particle(
            "negative energy", [](auto& r) { r.energy_gev = -1; }, "energy -1")));

INSTANTIATE_TEST_SUITE_P(
    Layout, MalformedHdf5Test,
    ::testing::Values(
        MalformedHdf5{"no format", [](hid_t file) { H5Adelete(file, "format"); }, "no attribute 'format'"},
        MalformedHdf5{"another format",
                      [](hid_t file) { set_attribute(file, "format", utf8_type(5), "other"); },
                      "found the format 'other'; expected 'floe-events'"},
        MalformedHdf5{"a number as format",
                      [](hid_t file) { set_attribute(file, "format", H5T_NATIVE_DOUBLE, &infinity); },
                      "an attribute 'format' of another kind"},
        MalformedHdf5{"a later version",
                      [](hid_t file) {
                        const int two = 2;
                        set_attribute(file, "format_version", H5T_NATIVE_INT, &two);
                      },
                      "found version 2 of the format; expected version 1"},
        MalformedHdf5{"no ice hash", [](hid_t file) { H5Adelete(file, "ice_hash"); },
                      "no attribute 'ice_hash'"},
        MalformedHdf5{"infinite oversize",
                      [](hid_t file) { set_attribute(file, "oversize", H5T_NATIVE_DOUBLE, &infinity); },
                      "oversize inf"},
        MalformedHdf5{"no hits", [](hid_t file) { H5Ldelete(file, "hits", H5P_DEFAULT); }, "no table 'hits'"},
        MalformedHdf5{"fewer hits than events say", [](hid_t file) { set_extent(file, "hits", 29); },
                      "with 10 rows of 'hits'; expected at most the 9"},
        MalformedHdf5{"rows never written", [](hid_t file) { set_extent(file, "events", 1ull << 40); },
                      "event name '' in row 2"},
        MalformedHdf5{"no events", [](hid_t file) { set_extent(file, "events", 0); }, "found no events"},
        MalformedHdf5{"missing column",
                      [](hid_t file) {
                        auto columns = hit_columns();
                        columns.pop_back();
                        replace_hits(file, columns);
                      },
                      "no column 'inward_z' in 'hits'"},
        MalformedHdf5{"unknown column",
                      [](hid_t file) {
                        auto columns = hit_columns();
                        columns.push_back({"colour", ColumnKind::int32, 0, 4});
                        replace_hits(file, columns);
                      },
                      "12 columns in 'hits'"},
        MalformedHdf5{"column of another kind",
                      [](hid_t file) {
                        auto columns = hit_columns();
                        columns[2].kind = ColumnKind::uint64;
                        replace_hits(file, columns);
                      },
                      "a column 'time_ns' of another kind"}));

TEST(DamagedHdf5Test, TruncatedFilesSaySoAtEveryLength) {
  const TemporaryFolder folder;
  const auto path = good_file(folder);
  const std::string whole = bytes_of(path);
  for (std::size_t length = 8; length < whole.size(); length += whole.size() / 50) {
    SCOPED_TRACE(length);
    write_bytes(path, std::string_view(whole).substr(0, length));
    EXPECT_NE(message_of<InputError>([&] { read_event_file(path); }).find("truncated or damaged"),
              std::string::npos);
  }
  write_bytes(path, std::string_view(whole).substr(0, whole.size() - 1));
  EXPECT_NE(message_of<InputError>([&] { read_event_file(path); }).find("truncated file"), std::string::npos);
}

// Whichever byte is damaged: an error, or, where no information stands, the same events.
TEST(DamagedHdf5Test, DamageIsNeverTakenForData) {
  const TemporaryFolder folder;
  const auto path = good_file(folder);
  const std::string whole = bytes_of(path);
  const EventFile good = read_event_file(path);
  int refused = 0, read = 0;
  for (std::size_t i = 0; i < whole.size(); i += 7) {
    SCOPED_TRACE(i);
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ (1 << (i % 8)));
    write_bytes(path, damaged);
    try {
      const EventFile file = read_event_file(path);
      ++read;
      ASSERT_EQ(file.events.size(), 2u);
      EXPECT_EQ(file.provenance->configuration, good.provenance->configuration);
      for (std::size_t e = 0; e < 2; ++e) expect_same(file.events[e].hits, good.events[e].hits);
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, read / 4);  // most bytes of so small a file are reserved space
}

TEST(Hdf5MadeElsewhereTest, TextOfVariableLengthIsReadToo) {
  const TemporaryFolder folder;
  const auto path = good_file(folder);
  {
    const Hdf5Handle file = editable(path);
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "copy");
    H5Tset_size(type, H5T_VARIABLE);
    const char* name = "my own ice";
    set_attribute(file, "ice_name", type, &name);
  }
  EXPECT_EQ(read_event_file(path).provenance->ice_name, "my own ice");
}

// Rows beside pulses are found by their event: out of order, half of them would be passed over in silence.
TEST(Hdf5MadeElsewhereTest, RowsBesidePulsesGoByEvent) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "pulses.h5";
  Provenance provenance = sample_provenance();
  provenance.pulses = true;
  {
    EventFileWriter writer(path, provenance);
    for (const char* id : {"one", "two"}) {
      Event event;
      event.id = id;
      event.readout = Readout{
          0, 9, {}, {{{1, 2}, 1, 2}}, std::make_shared<const RecordingModules>(RecordingModules{{{1, 2}}}),
          {}};
      writer.begin_event(event);
    }
    writer.close();
  }
  EXPECT_EQ(read_event_file(path).events.size(), 2u);
  edit_row<UnusableRow>(editable(path), 0, [](auto& row) { row.event = 1; });
  edit_row<UnusableRow>(editable(path), 1, [](auto& row) { row.event = 0; });
  EXPECT_NE(message_of<InputError>([&] { read_event_file(path); }).find("event 0 in row 1 of 'unusable'"),
            std::string::npos);
  edit_row<UnusableRow>(editable(path), 1, [](auto& row) { row.event = 2; });
  EXPECT_NE(message_of<InputError>([&] { read_event_file(path); }).find("event 2 in row 1"),
            std::string::npos);
}

}  // namespace floe
