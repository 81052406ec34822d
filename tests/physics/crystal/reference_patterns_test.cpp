// Diffusion patterns against those of an independent program.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <span>

#include "data/base/text.h"
#include "propagation/crystal/pattern.h"
#include "reco/validation/two_sample_tests.h"

namespace floe {
namespace {

struct ReferencePattern {
  bool girdle;
  const char* elongation;
  int angle;  // [deg]
};

std::string file_name(const ReferencePattern& pattern) {
  return "crystal-" + std::to_string(pattern.girdle) + "-" + pattern.elongation + "-" +
         std::to_string(pattern.angle) + ".txt.gz";
}

std::vector<WalkedPhoton> read_pattern(const std::filesystem::path& file) {
  std::vector<WalkedPhoton> photons;
  for_each_text_line(file, [&](const TextLine& line) {
    expect_fields(line, 7, 7, "direction, position, crossings");
    const auto number = [&](std::size_t i) { return parse_number(line, i, "component"); };
    photons.push_back({{number(0), number(1), number(2)}, {number(3), number(4), number(5)}});
  });
  return photons;
}

double polar_angle(const WalkedPhoton& photon) {
  return std::atan2(photon.direction.head<2>().norm(), photon.direction.z());
}

// What is below the last digit of the files counts as that digit: across the flow of a girdle, light that is
// polarised along it is ordinary in every grain, and nothing turns it but rounding.
std::vector<double> polar_angles(const std::vector<WalkedPhoton>& photons) {
  std::vector<double> angles;
  for (const auto& photon : photons) angles.push_back(std::max(polar_angle(photon), 1e-6));
  return angles;
}

std::vector<WalkedPhoton> within(std::vector<WalkedPhoton> photons, double angle) {
  std::erase_if(photons, [&](const auto& photon) { return polar_angle(photon) > angle; });
  return photons;
}

class ReferencePatterns : public ::testing::TestWithParam<ReferencePattern> {
 protected:
  void SetUp() override {
    const auto file = std::filesystem::path(FLOE_SHARED_DIR) / "reference" / file_name(GetParam());
    if (!std::filesystem::exists(file))
      GTEST_SKIP() << "the reference results are not beside the project: " << file;
    reference_ = read_pattern(file);
    const Polycrystal ice{{1.3185, 1.3200},
                          GetParam().girdle ? Fabric::girdle() : Fabric::isotropic(),
                          spheroid(std::stod(GetParam().elongation))};
    ours_ = walk_photons(ice, {GetParam().angle * degree, 1000, 1e-3}, {1, 0, 0}, 20000, 0);
  }
  std::vector<WalkedPhoton> reference_, ours_;
};

void expect_alike(const PatternStatistics& ours, const PatternStatistics& theirs,
                  std::span<const PatternNumber> numbers) {
  for (const PatternNumber number : numbers) {
    const Estimate a = ours[number], b = theirs[number];
    const double difference = (a.value - b.value) / std::hypot(a.error, b.error);
    // Light that no boundary has turned differs by rounding.
    EXPECT_TRUE(std::abs(difference) < 4 || std::abs(a.value - b.value) < 1e-6)
        << name_of(number) << ": " << a.value << " +- " << a.error << ", reference " << b.value << " +- "
        << b.error;
    testing::Test::RecordProperty(std::string(name_of(number)),
                                  fmt::format("{:.5f} {:.5f} {:.5f}", a.value, b.value, b.error));
  }
}

// Ten patterns with 16 numbers, each within 4 standard errors.
TEST_P(ReferencePatterns, HaveTheSameCore) {
  using enum PatternNumber;
  expect_alike({ours_, 1}, {reference_, 1},
               std::array{core_mean_x, core_mean_y, median_x, core_sigma_x, core_sigma_y, core_skewness_x,
                          tail_share, shift_slope_x, shift_slope_y, shift_variance_x, shift_variance_y});
}

// A few photons in ten thousand rule moments of all photons; 4000 are too few to tell their error.
TEST_P(ReferencePatterns, HaveTheSameMomentsWithoutTheFarthest) {
  using enum PatternNumber;
  expect_alike({within(ours_, 0.4), 1}, {within(reference_, 0.4), 1},
               std::array{mean_x, mean_y, sigma_x, sigma_y, skewness_x, kurtosis_x, kurtosis_y});
}

TEST_P(ReferencePatterns, HaveTheSameTails) {
  for (const double angle : {0.25, 0.4, 0.7, 1.0}) {
    const auto beyond = [&](const auto& photons) {
      return static_cast<double>(photons.size() - within(photons, angle).size());
    };
    const double ratio = static_cast<double>(reference_.size()) / static_cast<double>(ours_.size());
    const double expected = ratio * beyond(ours_), variance = expected * (1 + ratio);
    EXPECT_LT(std::abs(beyond(reference_) - expected), 4 * std::sqrt(variance) + 1) << angle;
  }
}

TEST_P(ReferencePatterns, HaveTheSamePolarAngles) {
  const double probability = kolmogorov_smirnov(polar_angles(ours_), polar_angles(reference_)).probability;
  EXPECT_GT(probability, 1e-4);
  RecordProperty("ks_probability", std::to_string(probability));
}

INSTANTIATE_TEST_SUITE_P(
    Files, ReferencePatterns,
    ::testing::Values(ReferencePattern{true, "1.4", 0}, ReferencePattern{true, "1.4", 15},
                      ReferencePattern{true, "1.4", 30}, ReferencePattern{true, "1.4", 45},
                      ReferencePattern{true, "1.4", 60}, ReferencePattern{true, "1.4", 75},
                      ReferencePattern{true, "1.4", 90}, ReferencePattern{false, "1.4", 30},
                      ReferencePattern{false, "1.4", 60}, ReferencePattern{true, "2.0", 30}));

}  // namespace
}  // namespace floe
