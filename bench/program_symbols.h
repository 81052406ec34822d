// Which function of this program an address belongs to, read from the program's own symbol table: functions
// that only their own file can call are in it, too.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace floe {

class ProgramSymbols {
 public:
  // Throws InputError when the program's file has no symbol table (it was stripped).
  ProgramSymbols();

  // Readable name, "" when the address is in no function of the program itself.
  std::string function_at(const void* address) const;

 private:
  struct Symbol {
    std::uintptr_t begin, end;  // relative to where the program is loaded
    std::string name;
  };
  std::uintptr_t base_ = 0;
  std::vector<Symbol> symbols_;  // by begin
};

}  // namespace floe
