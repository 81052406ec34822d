#include "data/base/file_hash.h"

#include <fstream>

#include "data/base/hash.h"

namespace floe {

std::string hash_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string portion(1 << 20, '\0');
  Hasher whole;
  while (stream.read(portion.data(), static_cast<std::streamsize>(portion.size())), stream.gcount() > 0)
    whole.add(
        Hasher().add(std::string_view(portion).substr(0, static_cast<std::size_t>(stream.gcount()))).hex());
  return whole.hex();
}

}  // namespace floe
