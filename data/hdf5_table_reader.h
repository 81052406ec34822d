// Tables of event files, read in portions.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "data/base/error.h"
#include "data/hdf5_schema.h"

namespace floe::hdf5 {

enum class OtherColumns { refused, allowed };
// Throws InputError unless the type is a compound of these columns.
void expect_columns(const Hdf5Handle& type, std::span<const Column> columns, const char* table,
                    const Location& where, OtherColumns others);
bool has_table(hid_t file, const char* name);
bool has_column(hid_t file, const char* table, const char* column);  // of a table that is there

// One table of the file. Functions throw Hdf5Failure.
template <typename Row>
class TableReader {
 public:
  // Throws InputError when the table is not there, or is another. `where` must outlive this.
  TableReader(hid_t file, const Location& where, std::span<const Column> columns = Table<Row>::columns(),
              const char* name = Table<Row>::name, OtherColumns others = OtherColumns::refused)
      : where_(where) {
    if (!has_table(file, name))
      throw InputError(where, std::string("no table '") + name + "'",
                       "the tables events, particles and hits");
    table_ = Hdf5Handle(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose, "open a table");
    const Hdf5Handle type(H5Dget_type(table_), H5Tclose, "read a table's columns");
    expect_columns(type, columns, name, where, others);
    row_type_ = row_type_in_memory(columns, sizeof(Row));
    const Hdf5Handle space(H5Dget_space(table_), H5Sclose, "read a table's size");
    if (H5Sget_simple_extent_ndims(space) != 1)
      throw InputError(where, std::string("a table '") + name + "' that is no list of rows", "one dimension");
    checked(H5Sget_simple_extent_dims(space, &size_, nullptr), "read a table's size");
  }

  hsize_t size() const { return size_; }
  const Location& where() const { return where_; }

  // Calls use(row, index) for each row, or each in [begin, end), holding one chunk of them in memory.
  template <typename Use>
  void for_each(const Use& use) const {
    for_each(0, size_, use);
  }
  template <typename Use>
  void for_each(hsize_t begin, hsize_t end, const Use& use) const {
    std::vector<Row> rows(std::min<hsize_t>(Table<Row>::rows_per_chunk, end - begin));
    for (; begin < end; begin += rows.size()) {
      const hsize_t count = std::min<hsize_t>(rows.size(), end - begin);
      read_rows(begin, count, rows.data());
      for (hsize_t i = 0; i < count; ++i) use(rows[i], begin + i);
    }
  }

  // The rows of an event, of a table whose rows go by their column `event`: [first, second).
  std::pair<hsize_t, hsize_t> rows_of(std::uint64_t event) const {
    return {first_row_from(event), first_row_from(event + 1)};
  }

 private:
  hsize_t first_row_from(std::uint64_t event) const {
    hsize_t low = 0, high = size_;
    while (low < high) {
      const hsize_t middle = low + (high - low) / 2;
      Row row;
      read_rows(middle, 1, &row);
      (row.event < event ? low : high) = row.event < event ? middle + 1 : middle;
    }
    return low;
  }
  void read_rows(hsize_t begin, hsize_t count, Row* rows) const {
    const Hdf5Handle in_file(H5Dget_space(table_), H5Sclose, "select rows");
    checked(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, &begin, nullptr, &count, nullptr), "select rows");
    const Hdf5Handle in_memory(H5Screate_simple(1, &count, nullptr), H5Sclose, "select rows");
    checked(H5Dread(table_, row_type_, in_memory, in_file, H5P_DEFAULT, rows), "read rows");
  }

  const Location& where_;
  Hdf5Handle row_type_, table_;
  hsize_t size_ = 0;
};

}  // namespace floe::hdf5
