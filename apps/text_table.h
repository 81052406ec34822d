// A table of text with aligned columns.
#pragma once

#include <string>
#include <vector>

namespace floe {

// The first column is aligned to the left, the others to the right; two blanks between columns.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string str() const;  // ends in a newline

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace floe
