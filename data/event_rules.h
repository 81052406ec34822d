// Which values an event may hold: one place for every reader and writer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "data/event.h"

namespace floe {

inline constexpr std::uint64_t most_shards = 1000000;  // of a simulation
inline constexpr int largest_string = 10000;           // strings are 1..10000
inline constexpr int largest_dom = 1000;               // modules of a string are 1..1000
inline constexpr std::size_t longest_event_id = 128;   // [bytes]

// What is wrong with a value, in the two parts that an error message needs.
struct Problem {
  std::string found, expected;
};

// Module within its range, time finite, charge finite and above 0, wavelength above 0 or unknown,
// directions unit vectors (within 0.001) or unknown, width 0 or more or unknown. Whether the detector has the
// module is not asked.
std::optional<Problem> problem_of(const Hit& hit);

// Name known, everything finite, zenith in 0..pi, azimuth in 0..2 pi, energy above 0, length not
// below 0.
std::optional<Problem> problem_of(const Particle& particle);

// Module within its range, LEDs that exist, orientation -360 to 360 deg or unknown, wavelength 300 to 600 nm,
// beam width 0 to 90 deg, pulse width 0 to 1000 ns, photons finite and above 0 or unknown, oversize 1 to 100.
std::optional<Problem> problem_of(const FlasherRun& run);

// Identifier of 1 to 128 bytes without control characters; repeats finite and above 0.
std::optional<Problem> problem_of_event(std::string_view id, double repeats);

// The name of an event that has none of its own: the file's, without suffix.
std::string event_name_of(const std::filesystem::path& file);
// The suffix that says what a text holds: ".hits" of "a.hits" and of "a.hits.gz".
std::string text_suffix_of(const std::filesystem::path& file);

// Names of f2k particles: known_particle_names() lists them.
bool is_particle_name(std::string_view name);
std::string known_particle_names();  // for messages

}  // namespace floe
