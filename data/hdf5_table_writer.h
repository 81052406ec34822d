// Tables of event files, to which rows are appended in constant memory.
#pragma once

#include <span>
#include <vector>

#include "data/hdf5_output.h"
#include "data/hdf5_schema.h"

namespace floe::hdf5 {

// One table of the file, to which rows are appended; a chunk's worth of them is kept in memory. Functions
// throw Hdf5Failure.
template <typename Row>
class TableWriter {
 public:
  explicit TableWriter(hid_t file, std::span<const Column> columns = Table<Row>::columns(),
                       const char* name = Table<Row>::name)
      : row_type_(row_type_in_memory(columns, sizeof(Row))) {
    const hsize_t none = 0, unlimited = H5S_UNLIMITED, chunk = Table<Row>::rows_per_chunk;
    const Hdf5Handle space(H5Screate_simple(1, &none, &unlimited), H5Sclose, "describe a table");
    const Hdf5Handle layout = compressed_layout({&chunk, 1});
    table_ =
        Hdf5Handle(H5Dcreate2(file, name, row_type_in_file(columns), space, H5P_DEFAULT, layout, H5P_DEFAULT),
                   H5Dclose, "create a table");
    rows_.reserve(chunk);
  }

  void append(const Row& row) {
    rows_.push_back(row);
    if (rows_.size() == Table<Row>::rows_per_chunk) write_rows();
  }
  hsize_t size() const { return written_ + rows_.size(); }
  void close() {
    write_rows();
    table_.close("close a table");
  }

 private:
  void write_rows() {
    if (rows_.empty()) return;
    const hsize_t count = rows_.size(), end = written_ + count;
    checked(H5Dset_extent(table_, &end), "extend a table");
    const Hdf5Handle in_file(H5Dget_space(table_), H5Sclose, "select rows");
    checked(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, &written_, nullptr, &count, nullptr), "select rows");
    const Hdf5Handle in_memory(H5Screate_simple(1, &count, nullptr), H5Sclose, "select rows");
    checked(H5Dwrite(table_, row_type_, in_memory, in_file, H5P_DEFAULT, rows_.data()), "write rows");
    written_ = end;
    rows_.clear();
  }

  Hdf5Handle row_type_, table_;
  std::vector<Row> rows_;
  hsize_t written_ = 0;
};

}  // namespace floe::hdf5
