#include "bench/program_symbols.h"

#include <cxxabi.h>
#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>

#include "data/base/error.h"

namespace floe {

namespace {

constexpr const char* own_file = "/proc/self/exe";

std::string readable(const char* symbol) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> text(abi::__cxa_demangle(symbol, nullptr, nullptr, &status),
                                                    std::free);
  return status == 0 ? text.get() : symbol;
}

// The program is the first object that the loader lists.
std::uintptr_t load_address() {
  std::uintptr_t address = 0;
  const auto take_first = [](dl_phdr_info* info, std::size_t, void* result) {
    *static_cast<std::uintptr_t*>(result) = info->dlpi_addr;
    return 1;
  };
  dl_iterate_phdr(take_first, &address);
  return address;
}

template <typename T>
std::vector<T> table_at(const std::vector<char>& file, std::size_t offset, std::size_t count) {
  if (offset + count * sizeof(T) > file.size()) return {};
  std::vector<T> table(count);
  std::memcpy(table.data(), file.data() + offset, count * sizeof(T));
  return table;
}

}  // namespace

ProgramSymbols::ProgramSymbols() : base_(load_address()) {
  std::ifstream stream(own_file, std::ios::binary);
  const std::vector<char> file{std::istreambuf_iterator<char>(stream), {}};
  const auto header = table_at<ElfW(Ehdr)>(file, 0, 1);
  if (!header.empty()) {
    const auto sections = table_at<ElfW(Shdr)>(file, header[0].e_shoff, header[0].e_shnum);
    for (const auto& section : sections) {
      if (section.sh_type != SHT_SYMTAB) continue;
      const std::size_t names = sections.at(section.sh_link).sh_offset;
      for (const auto& symbol :
           table_at<ElfW(Sym)>(file, section.sh_offset, section.sh_size / sizeof(ElfW(Sym))))
        if (ELF64_ST_TYPE(symbol.st_info) == STT_FUNC && symbol.st_size > 0)
          symbols_.push_back({symbol.st_value, symbol.st_value + symbol.st_size,
                              readable(file.data() + names + symbol.st_name)});
    }
  }
  if (symbols_.empty())
    throw InputError(
        "this program has no symbol table; the profile needs the names of its functions. "
        "Build it without stripping it");
  std::sort(symbols_.begin(), symbols_.end(),
            [](const Symbol& a, const Symbol& b) { return a.begin < b.begin; });
}

std::string ProgramSymbols::function_at(const void* address) const {
  const std::uintptr_t place = reinterpret_cast<std::uintptr_t>(address) - base_;
  const auto after = std::upper_bound(symbols_.begin(), symbols_.end(), place,
                                      [](std::uintptr_t p, const Symbol& s) { return p < s.begin; });
  if (after == symbols_.begin()) return {};
  const Symbol& symbol = *std::prev(after);
  return place < symbol.end ? symbol.name : std::string();
}

}  // namespace floe
