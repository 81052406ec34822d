// A table of text with aligned columns.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace floe {

// The first column is aligned to the left, as are the last ones where they hold text, the others to the
// right; two blanks between columns.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header, std::size_t text_columns_at_end = 0)
      : rows_{std::move(header)}, first_text_(rows_[0].size() - text_columns_at_end) {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string str() const;  // ends in a newline

 private:
  std::vector<std::vector<std::string>> rows_;
  std::size_t first_text_;
};

}  // namespace floe
