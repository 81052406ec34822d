#include "geometry/acceptance.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "data/base/constants.h"
#include "data/base/error.h"

namespace floe {
namespace {

namespace fs = std::filesystem;

Vec3 photon_at(double cos_eta) {
  return unit_vector(std::acos(cos_eta), 0.7);
}

double at(const AngularAcceptance& acceptance, double cos_eta) {
  return acceptance.probability(photon_at(cos_eta), Vec3::UnitX(), Vec3::UnitZ());
}

TEST(AngularAcceptance, FollowsThePolynomial) {
  const auto acceptance = AngularAcceptance::polynomial(0.8, {0.4, 0.3, 0, 0.1});
  for (const double x : {-0.9, -0.3, 0.0, 0.5, 1.0})
    EXPECT_NEAR(at(acceptance, x), (0.4 + 0.3 * x + 0.1 * x * x * x) / 0.8, 1e-12);
}

TEST(AngularAcceptance, IsClippedToProbabilities) {
  const auto acceptance = AngularAcceptance::polynomial(1, {0, 1.02});
  EXPECT_EQ(at(acceptance, -0.5), 0);
  EXPECT_EQ(at(acceptance, 1), 1);
}

TEST(AngularAcceptance, TurnsWithTheUpAxis) {
  const auto acceptance = AngularAcceptance::polynomial(1, {0.5, 0.5});
  EXPECT_NEAR(acceptance.probability(Vec3::UnitX(), Vec3::UnitZ(), Vec3::UnitX()), 1, 1e-12);
  EXPECT_NEAR(acceptance.probability(Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitX()), 0, 1e-12);
}

TEST(AngularAcceptance, RefusesWhatIsNoAcceptance) {
  EXPECT_THROW(AngularAcceptance::polynomial(0, {1}), InputError);
  EXPECT_THROW(AngularAcceptance::polynomial(-1, {1}), InputError);
  EXPECT_THROW(AngularAcceptance::polynomial(std::nan(""), {1}), InputError);
  EXPECT_THROW(AngularAcceptance::polynomial(1, {}), InputError);
  EXPECT_THROW(AngularAcceptance::polynomial(1, {-1}), InputError);
  EXPECT_THROW(AngularAcceptance::polynomial(1, {0, 0}), InputError);
  EXPECT_THROW(AngularAcceptance::polynomial(1, {0, 1.06}), InputError);
  EXPECT_THROW(AngularAcceptance::polynomial(1, {0.5, std::nan("")}), InputError);
  EXPECT_THROW(AngularAcceptance::surface(1), InputError);
  EXPECT_THROW(AngularAcceptance::surface(-1.01), InputError);
}

// A cap of height 1 - c around the lower pole is a share (1 - c)/2 of the sphere.
TEST(AngularAcceptance, SurfaceAcceptsACapAroundTheLowerPole) {
  const double cut = 0.3;
  const auto acceptance = AngularAcceptance::surface(cut);
  EXPECT_TRUE(acceptance.is_surface());
  EXPECT_EQ(acceptance.maximum(), 1);
  // A photon that goes up lands on the lower pole: inward is up.
  EXPECT_EQ(acceptance.probability(Vec3::UnitZ(), Vec3::UnitZ(), Vec3::UnitZ()), 1);
  EXPECT_EQ(acceptance.probability(-Vec3::UnitZ(), -Vec3::UnitZ(), Vec3::UnitZ()), 0);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> cosine(-1, 1);
  constexpr int n = 200'000;
  int accepted = 0;
  for (int k = 0; k < n; ++k)
    accepted += acceptance.probability(Vec3::UnitX(), photon_at(cosine(random)), Vec3::UnitZ()) > 0;
  const double share = (1 - cut) / 2;
  EXPECT_NEAR(accepted, n * share, 5 * std::sqrt(n * share * (1 - share)));
}

TEST(WavelengthSpectrum, SampleInvertsTheCumulative) {
  const WavelengthSpectrum spectrum({{0, 300}, {0.25, 350}, {0.25, 400}, {1, 500}});
  EXPECT_EQ(spectrum.sample(0), 300);
  EXPECT_NEAR(spectrum.sample(0.125), 325, 1e-9);
  EXPECT_NEAR(spectrum.sample(0.25), 400, 1e-9);  // nothing between 350 and 400
  EXPECT_NEAR(spectrum.sample(0.625), 450, 1e-9);
  EXPECT_EQ(spectrum.sample(1), 500);
  EXPECT_NEAR(spectrum.density(320), 0.005, 1e-12);
  EXPECT_EQ(spectrum.density(375), 0);
  EXPECT_NEAR(spectrum.density(450), 0.0075, 1e-12);
  EXPECT_EQ(spectrum.density(299), 0);
  EXPECT_EQ(spectrum.density(501), 0);
}

TEST(WavelengthSpectrum, FlatEndsAreNeverSampled) {
  const WavelengthSpectrum spectrum({{0, 300}, {0, 310}, {1, 400}, {1, 450}});
  EXPECT_EQ(spectrum.sample(0), 310);
  EXPECT_EQ(spectrum.sample(1), 400);
}

TEST(WavelengthSpectrum, RefusesWhatIsNoDistribution) {
  using Points = std::vector<WavelengthSpectrum::Point>;
  for (const Points& bad :
       {Points{}, Points{{0, 300}}, Points{{0.1, 300}, {1, 400}}, Points{{0, 300}, {0.9, 400}},
        Points{{0, 300}, {1, 300}}, Points{{0, 300}, {0.6, 350}, {0.5, 400}, {1, 450}},
        Points{{0, 400}, {1, 300}}, Points{{0, 3}, {1, 400}}, Points{{0, 300}, {1, std::nan("")}},
        Points{{0, 300}, {std::nan(""), 350}, {1, 400}}})
    EXPECT_THROW(WavelengthSpectrum{bad}, InputError);
}

TEST(HighQeRatio, IsLinearBetweenPointsAndConstantBeyond) {
  const HighQeRatio ratio({{300, 1}, {400, 1.5}, {500, 1.2}});
  EXPECT_EQ(ratio(200), 1);
  EXPECT_NEAR(ratio(350), 1.25, 1e-12);
  EXPECT_NEAR(ratio(450), 1.35, 1e-12);
  EXPECT_EQ(ratio(600), 1.2);
  EXPECT_EQ(ratio.maximum(), 1.5);
}

TEST(HighQeRatio, RefusesWhatIsNoRatio) {
  using Points = std::vector<HighQeRatio::Point>;
  for (const Points& bad : {Points{}, Points{{300, -1}}, Points{{300, 0}}, Points{{300, 1}, {300, 1}},
                            Points{{400, 1}, {300, 1}}, Points{{300, std::nan("")}}, Points{{1e5, 1}}})
    EXPECT_THROW(HighQeRatio{bad}, InputError);
}

class AcceptanceFile : public testing::Test {
 protected:
  fs::path write(const std::string& content) {
    path_ = fs::path(testing::TempDir()) /
            ("floe-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::ofstream(path_) << content;
    return path_;
  }
  void TearDown() override { fs::remove(path_); }
  template <typename Read>
  void expect_refused(const Read& read, const std::string& content, const std::string& message) {
    const fs::path file = write(content);
    try {
      read(file);
      ADD_FAILURE() << "was read: " << content;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }

 private:
  fs::path path_;
};

TEST_F(AcceptanceFile, Angular) {
  const auto polynomial = read_angular_acceptance(write("0.8\n0.4\n0.3 # linear\n0\n0.1\n"));
  EXPECT_EQ(polynomial.maximum(), 0.8);
  EXPECT_EQ(polynomial.coefficients(), (std::vector<double>{0.4, 0.3, 0, 0.1}));
  const auto surface = read_angular_acceptance(write("0\n0.33\n"));
  EXPECT_TRUE(surface.is_surface());
  EXPECT_EQ(surface.cut(), 0.33);
}

TEST_F(AcceptanceFile, MalformedAngular) {
  expect_refused(read_angular_acceptance, "", "0 numbers");
  expect_refused(read_angular_acceptance, "0.68\n", "1 numbers");
  expect_refused(read_angular_acceptance, "0.68\n0.3\nx\n", ":3");
  expect_refused(read_angular_acceptance, "-0.68 0.3\n", "-0.68");
  expect_refused(read_angular_acceptance, "0 0.3 0.1\n", "the cut");
  expect_refused(read_angular_acceptance, "0 1.5\n", "cut 1.5");
  expect_refused(read_angular_acceptance, "0.5 0.3 0.3\n", "rises to 0.6");
}

TEST_F(AcceptanceFile, Spectra) {
  EXPECT_NEAR(read_wavelength_spectrum(write("0 300\n0.5 400\n1 600\n")).sample(0.75), 500, 1e-9);
  EXPECT_NEAR(read_high_qe_ratio(write("300 1\n400 2\n"))(350), 1.5, 1e-12);
}

TEST_F(AcceptanceFile, MalformedSpectra) {
  expect_refused(read_wavelength_spectrum, "0 300\n1\n", ":2");
  expect_refused(read_wavelength_spectrum, "0 300\n0.5 4OO\n1 500\n", ":2");
  expect_refused(read_wavelength_spectrum, "0 300\n0.9 400\n", "0 to 1");
  expect_refused(read_wavelength_spectrum, "0 300\n1 250\n", "rise");
  expect_refused(read_high_qe_ratio, "300 1 1\n", ":1");
  expect_refused(read_high_qe_ratio, "300 -1\n", "-1");
}

// The family of arXiv:2307.15298 keeps the head-on value for any p, and vanishes from behind.
TEST(BuiltinAcceptance, LooksLikeAModuleInTheHole) {
  const ModuleAcceptance acceptance = builtin_acceptance();
  EXPECT_EQ(acceptance.overall_efficiency, 1);
  EXPECT_NEAR(at(acceptance.angular, 1), 1, 1e-12);
  EXPECT_NEAR(at(acceptance.angular, 0), 0.5, 1e-12);
  EXPECT_NEAR(at(acceptance.angular, -1), 0, 1e-12);
  EXPECT_FALSE(acceptance.high_qe.has_value());
}

TEST(BuiltinAcceptance, SpectrumIsBlueAndBounded) {
  const WavelengthSpectrum spectrum = builtin_acceptance().spectrum;
  EXPECT_EQ(spectrum.density(295), 0);
  EXPECT_EQ(spectrum.density(670), 0);
  const double median = spectrum.sample(0.5);
  EXPECT_GT(median, 390);
  EXPECT_LT(median, 440);
  // Frank and Tamm: with equal areas 1/lambda^2 prefers the shorter wavelength, so the maximum lies
  // below the 420 nm of the sensitivity.
  double best = 300;
  for (double wavelength = 305; wavelength < 660; wavelength += 10)
    if (spectrum.density(wavelength) > spectrum.density(best)) best = wavelength;
  EXPECT_GT(best, 360);
  EXPECT_LT(best, 420);
}

}  // namespace
}  // namespace floe
