// Weighted photons in event files: sums per event and module that are those of the hits.
#include <gtest/gtest.h>

#include "data/base/error.h"
#include "data/hdf5_schema.h"
#include "tests/unit/data/sample_events.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe {

using namespace test;
using namespace hdf5;

namespace {

class WeightedEvents : public ::testing::Test {
 protected:
  void write(bool weighted) const {
    Provenance provenance = sample_provenance();
    provenance.weighted = weighted;
    EventFileWriter writer(path, provenance);
    writer.begin_event("one", {});
    writer.append(std::vector<Hit>{hit(3, 7, 0.5F), hit(3, 6, 1)});
    writer.append(std::vector<Hit>{hit(3, 7, 0.25F)});
    writer.begin_event("dark", {});
    writer.begin_event("two", {});
    writer.append(std::vector<Hit>{hit(1, 2, 0.125F)});
    writer.close();
  }
  static Hit hit(int string, int dom, float weight) {
    Hit hit = photon_hits(1)[0];
    hit.module = {string, dom};
    hit.charge = weight;
    return hit;
  }
  Hdf5Handle open(unsigned mode) const {
    return {H5Fopen(path.c_str(), mode, H5P_DEFAULT), H5Fclose, "open"};
  }

  // The table of sums, read and, when `write`, written back after `edit`.
  std::vector<WeightRow> rows(const std::function<void(WeightRow&)>& edit = {}) const {
    const Hdf5Handle file = open(edit ? H5F_ACC_RDWR : H5F_ACC_RDONLY);
    const Hdf5Handle table(H5Dopen2(file, "weights", H5P_DEFAULT), H5Dclose, "open");
    const Hdf5Handle space(H5Dget_space(table), H5Sclose, "size");
    const Hdf5Handle type = row_type_in_memory(Table<WeightRow>::columns(), sizeof(WeightRow));
    std::vector<WeightRow> rows(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    checked(H5Dread(table, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()), "read");
    if (!edit) return rows;
    edit(rows[1]);
    checked(H5Dwrite(table, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()), "write");
    return rows;
  }

  TemporaryFolder folder;
  std::filesystem::path path = folder.path() / "weighted.h5";
};

TEST_F(WeightedEvents, CarryTheirSums) {
  write(true);
  const auto sums = rows();
  ASSERT_EQ(sums.size(), 3U);
  const auto expect_row = [](const WeightRow& row, std::uint64_t event, int string, int dom,
                             std::uint64_t hits, double sum, double squares) {
    EXPECT_EQ(row.event, event);
    EXPECT_EQ(row.string, string);
    EXPECT_EQ(row.dom, dom);
    EXPECT_EQ(row.hit_count, hits);
    EXPECT_EQ(row.weight_sum, sum);
    EXPECT_EQ(row.squared_weight_sum, squares);
  };
  expect_row(sums[0], 0, 3, 6, 1, 1, 1);
  expect_row(sums[1], 0, 3, 7, 2, 0.75, 0.3125);
  expect_row(sums[2], 2, 1, 2, 1, 0.125, 0.015625);
}

TEST_F(WeightedEvents, ComeBackAsWeighted) {
  write(true);
  const EventFile file = read_event_file(path);
  EXPECT_TRUE(file.provenance->weighted);
  EXPECT_EQ(file.events[0].hits[2].charge, 0.25F);
}

TEST_F(WeightedEvents, WithoutWeightsThereAreNoSums) {
  write(false);
  EXPECT_EQ(H5Lexists(open(H5F_ACC_RDONLY), "weights", H5P_DEFAULT), 0);
  EXPECT_FALSE(read_event_file(path).provenance->weighted);
}

TEST_F(WeightedEvents, SumsOfOtherHitsAreRefused) {
  const std::function<void(WeightRow&)> edits[] = {[](WeightRow& row) { row.weight_sum *= 1.001; },
                                                   [](WeightRow& row) { row.squared_weight_sum = 0; },
                                                   [](WeightRow& row) { row.hit_count = 3; },
                                                   [](WeightRow& row) { row.event = 1; },
                                                   [](WeightRow& row) { row.dom = 8; },
                                                   [](WeightRow& row) { row.weight_sum = Hit::unknown; }};
  for (const auto& edit : edits) {
    write(true);
    rows(edit);
    const std::string message = message_of<InputError>([&] { read_event_file(path); });
    EXPECT_NE(message.find("in row 1 of 'weights'"), std::string::npos) << message;
  }
}

TEST_F(WeightedEvents, CannotBeExportedAsPhotons) {
  write(true);
  const auto events = read_event_file(path).events;
  const std::string message = message_of<UsageError>(
      [&] { export_events(folder.path() / "out.hits", EventFormat::hits, std::span(events).first(1)); });
  EXPECT_NE(message.find("photons of that weight"), std::string::npos) << message;
  export_events(folder.path() / "out.dat", EventFormat::dat, std::span(events).first(1));
  const auto back = read_event_file(folder.path() / "out.dat").events[0].hits;
  ASSERT_EQ(back.size(), 3U);
  EXPECT_EQ(back[0].charge, 0.5F);
}

TEST(WeightSums, EffectiveHitsAreThoseOfEqualWeights) {
  WeightSums sums;
  EXPECT_EQ(sums.effective_hits(), 0);
  for (int i = 0; i < 8; ++i) sums.add(0.25);
  EXPECT_EQ(sums.effective_hits(), 8);
  WeightSums more;
  more.add(1);
  sums += more;
  EXPECT_EQ(sums.hits, 9U);
  EXPECT_DOUBLE_EQ(sums.sum, 3);
  EXPECT_DOUBLE_EQ(sums.effective_hits(), 9 / 1.5);
}

}  // namespace
}  // namespace floe
