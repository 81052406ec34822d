// Rows of a table, fetched by many lanes at once.
#include "propagation/engine/table_rows.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace floe {
namespace {

template <int Count>
void expect_what_rows_hold(std::mt19937& random) {
  std::vector<TableRow> rows(97);
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (std::size_t k = 0; k < 8; ++k) rows[row].values[k] = static_cast<float>(10 * row + k);
  for (int round = 0; round < 200; ++round) {
    std::int32_t index[Count];
    for (std::int32_t& i : index) i = std::uniform_int_distribution<std::int32_t>(0, 96)(random);
    float columns[8][Count];
    fetch_rows(rows.data(), index, columns);
    for (int k = 0; k < 8; ++k)
      for (int i = 0; i < Count; ++i) ASSERT_EQ(columns[k][i], static_cast<float>(10 * index[i] + k));
  }
}

TEST(TableRows, AreFetchedIntoColumns) {
  std::mt19937 random(1);
  expect_what_rows_hold<8>(random);
  expect_what_rows_hold<16>(random);
  expect_what_rows_hold<64>(random);
}

}  // namespace
}  // namespace floe
