// A short checksum that names data in outputs (not cryptographic).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace floe {

// Collects values in a fixed order; hex() is 32 hexadecimal digits (XXH3, 128 bits). Numbers are
// hashed by their IEEE-754 bits, strings with their length.
class Hasher {
 public:
  Hasher& add(double value);
  Hasher& add(std::int64_t value);
  Hasher& add(std::string_view text);
  std::string hex() const;

 private:
  std::string bytes_;
};

}  // namespace floe
