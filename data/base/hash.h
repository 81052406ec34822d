// A short checksum that names data in outputs (not cryptographic).
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace floe {

// Collects values in a fixed order; hex() is 32 hexadecimal digits (XXH3, 128 bits). Numbers are
// hashed by their IEEE-754 bits, whole numbers as 64 bits, strings with their length, each value with a
// mark of its kind.
class Hasher {
 public:
  Hasher& add(double value);
  Hasher& add(std::int64_t value);
  Hasher& add(std::string_view text);
  // Any other integer, so that a call with an int is not ambiguous.
  Hasher& add(std::integral auto value) { return add(static_cast<std::int64_t>(value)); }
  std::string hex() const;

 private:
  std::string bytes_;
};

}  // namespace floe
