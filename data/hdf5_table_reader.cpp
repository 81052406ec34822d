#include "data/hdf5_table_reader.h"

#include <fmt/format.h>

namespace floe::hdf5 {

namespace {

H5T_class_t class_of(ColumnKind kind) {
  switch (kind) {
    case ColumnKind::text:
      return H5T_STRING;
    case ColumnKind::float32:
    case ColumnKind::float64:
      return H5T_FLOAT;
    default:
      return H5T_INTEGER;
  }
}

}  // namespace

// HDF5 leaves a member that the file lacks as it is, so the columns are compared before reading.
void expect_columns(const Hdf5Handle& type, std::span<const Column> columns, const char* table,
                    const Location& where, OtherColumns others) {
  if (H5Tget_class(type) != H5T_COMPOUND)
    throw InputError(where, fmt::format("a data set '{}' of another kind", table), "a table of compounds");
  for (const Column& column : columns) {
    const int index = H5Tget_member_index(type, column.name);
    if (index < 0)
      throw InputError(where, fmt::format("no column '{}' in '{}'", column.name, table),
                       "the columns of docs/formats.md");
    if (H5Tget_member_class(type, static_cast<unsigned>(index)) != class_of(column.kind))
      throw InputError(where, fmt::format("a column '{}' of another kind in '{}'", column.name, table),
                       "the columns of docs/formats.md");
  }
  const int count = checked(H5Tget_nmembers(type), "read a table's columns");
  if (others == OtherColumns::refused && count != static_cast<int>(columns.size()))
    throw InputError(where, fmt::format("{} columns in '{}'", count, table),
                     fmt::format("the {} columns of docs/formats.md", columns.size()));
}

bool has_table(hid_t file, const char* name) {
  return checked(H5Lexists(file, name, H5P_DEFAULT), "look for a table") > 0;
}

bool has_column(hid_t file, const char* table, const char* column) {
  const Hdf5Handle data(H5Dopen2(file, table, H5P_DEFAULT), H5Dclose, "open a table");
  const Hdf5Handle type(H5Dget_type(data), H5Tclose, "read a table's columns");
  return H5Tget_class(type) == H5T_COMPOUND && H5Tget_member_index(type, column) >= 0;
}

}  // namespace floe::hdf5
