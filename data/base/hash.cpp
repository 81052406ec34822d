#include "data/base/hash.h"

#include <fmt/format.h>

#include <bit>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace floe {

namespace {
// Byte by byte from the lowest, so that the hash is the same on every machine.
void append_bits(std::string& bytes, char kind, std::uint64_t bits) {
  bytes.push_back(kind);
  for (int shift = 0; shift < 64; shift += 8) bytes.push_back(static_cast<char>((bits >> shift) & 0xff));
}
}  // namespace

Hasher& Hasher::add(double value) {
  append_bits(bytes_, 'd', std::bit_cast<std::uint64_t>(value));
  return *this;
}

Hasher& Hasher::add(std::int64_t value) {
  append_bits(bytes_, 'i', static_cast<std::uint64_t>(value));
  return *this;
}

Hasher& Hasher::add(std::string_view text) {
  append_bits(bytes_, 's', text.size());
  bytes_.append(text);
  return *this;
}

std::string Hasher::hex() const {
  const XXH128_hash_t hash = XXH3_128bits(bytes_.data(), bytes_.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace floe
