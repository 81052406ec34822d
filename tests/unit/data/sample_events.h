// Events that use every field, for the tests of event files.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "data/event_files.h"

namespace floe::test {

inline Vec3f random_direction(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double z = uniform(random);
  return unit_vector(std::acos(z), pi * uniform(random)).cast<float>();
}

// Photons with everything known, at times from -1e3 to 1e4 ns.
inline std::vector<Hit> photon_hits(std::size_t count, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> string(1, 86), dom(1, 60);
  std::uniform_real_distribution<double> time(-1e3, 1e4);
  std::uniform_real_distribution<float> wavelength(300, 600);
  std::vector<Hit> hits(count);
  for (Hit& hit : hits) {
    hit.module = {string(random), dom(random)};
    hit.time = time(random);
    hit.wavelength = wavelength(random);
    hit.direction = random_direction(random);
    hit.inward = random_direction(random);
  }
  return hits;
}

// Pulses: only module, time and charge known.
inline std::vector<Hit> pulse_hits(std::size_t count) {
  std::vector<Hit> hits(count);
  for (std::size_t i = 0; i < count; ++i) {
    hits[i].module = {1 + static_cast<int>(i % 86), 1 + static_cast<int>(i % 60)};
    hits[i].time = 0.125 * static_cast<double>(i);
    hits[i].charge = 0.1f + 0.01f * static_cast<float>(i);
  }
  return hits;
}

inline std::vector<Particle> sample_truth() {
  return {{"e-", {20, -40, -300}, 70 * degree, 130 * degree, 0, 5e4, 0},
          {"amu+", {1.5, 2.5, -3.5}, pi, 0, 12.25, 1e3, -7.5}};
}

// A run with everything known.
inline FlasherRun sample_flasher() {
  return {{63, 20}, {LedPattern::Kind::single, 9}, -30 * degree, 370, 5 * degree, 70, 2.5e10, 16};
}

inline Provenance sample_provenance() {
  return {"0.1.0",
          "floe simulate --seed 7",
          R"({"seed": 7, "name": "é"})",
          "south-pole",
          "0123456789abcdef",
          "ic86",
          "fedcba9876543210",
          18446744073709551615ull,
          5};
}

inline void write_events(const std::filesystem::path& path, const std::vector<Event>& events) {
  EventFileWriter writer(path, sample_provenance());
  for (const Event& event : events) {
    writer.begin_event(event.id, event.truth, event.repeats, event.flasher);
    writer.append(event.hits);
  }
  writer.close();
}

inline bool same_float(float a, float b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

inline bool same_number(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

inline bool same_vector(const Vec3f& a, const Vec3f& b) {
  return same_float(a.x(), b.x()) && same_float(a.y(), b.y()) && same_float(a.z(), b.z());
}

inline void expect_same(const std::vector<Hit>& got, const std::vector<Hit>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(got[i].module, expected[i].module);
    EXPECT_EQ(got[i].time, expected[i].time);
    EXPECT_EQ(got[i].charge, expected[i].charge);
    EXPECT_TRUE(same_float(got[i].wavelength, expected[i].wavelength));
    EXPECT_TRUE(same_vector(got[i].direction, expected[i].direction));
    EXPECT_TRUE(same_vector(got[i].inward, expected[i].inward));
    if (::testing::Test::HasFailure()) return;
  }
}

// Angles go through degrees, which costs their last bits.
inline void expect_same(const std::vector<Particle>& got, const std::vector<Particle>& expected) {
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(got[i].name, expected[i].name);
    EXPECT_EQ(got[i].position, expected[i].position);
    EXPECT_DOUBLE_EQ(got[i].zenith, expected[i].zenith);
    EXPECT_DOUBLE_EQ(got[i].azimuth, expected[i].azimuth);
    EXPECT_EQ(got[i].length, expected[i].length);
    EXPECT_EQ(got[i].energy, expected[i].energy);
    EXPECT_EQ(got[i].time, expected[i].time);
  }
}

// Angles within the rounding of a conversion to degrees, or of the digits of text.
inline void expect_same(const FlasherRun& got, const FlasherRun& expected) {
  constexpr double rounding = 1e-11;
  EXPECT_EQ(got.module, expected.module);
  EXPECT_EQ(got.leds, expected.leds);
  if (std::isnan(expected.orientation))
    EXPECT_TRUE(std::isnan(got.orientation));
  else
    EXPECT_NEAR(got.orientation, expected.orientation, rounding);
  EXPECT_EQ(got.wavelength, expected.wavelength);
  EXPECT_NEAR(got.beam_width, expected.beam_width, rounding);
  EXPECT_EQ(got.pulse_width, expected.pulse_width);
  EXPECT_TRUE(same_number(got.photons, expected.photons)) << got.photons << " " << expected.photons;
  EXPECT_EQ(got.oversize, expected.oversize);
}

}  // namespace floe::test
