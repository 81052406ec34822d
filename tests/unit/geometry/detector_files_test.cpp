#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "geometry/acceptance.h"
#include "geometry/detector.h"

namespace floe {
namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;

// Two modules in the ice on string 1, one of a later string with a high number, and two at the surface.
const Files sound_files{{"geo-f2k",
                         "AB1C0001 0x1b2c3d4e5f60 10.5 -20.25 -1450.07 1 1\n"
                         "AB1C0002 1b2c3d4e5f61 10.5 -20.25 -1467 1 2\n"
                         "AB1C0003 0x1b2c3d4e5f62 100 0 -2300 87 104\n"
                         "AB1C0004 0x1b2c3d4e5f63 12 -22 -1.9 1 61\n"
                         "AMAC0005 0x1b2c3d4e5f64 300 100 -1700 0 91\n"}};

class Folder {
 public:
  explicit Folder(const Files& files) : path_(fs::path(testing::TempDir()) / unique_name()) {
    fs::create_directories(path_);
    for (const auto& [name, content] : files) std::ofstream(path_ / name) << content;
  }
  ~Folder() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }

 private:
  static std::string unique_name() {
    std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    std::replace(name.begin(), name.end(), '/', '_');
    return "floe-detector-" + name;
  }
  fs::path path_;
};

Files with(const std::string& name, const std::string& content) {
  Files files = sound_files;
  files[name] = content;
  return files;
}

Module module_of(const Detector& detector, int string, int dom) {
  return detector.modules()[detector.index_of({string, dom})];
}

TEST(DetectorFiles, ReadsPositionsOfModulesInTheIce) {
  const Folder folder(sound_files);
  const Detector detector = read_detector(folder.path());
  EXPECT_EQ(detector.size(), 3U);
  EXPECT_EQ(detector.name(), folder.path().filename().string());
  EXPECT_TRUE(module_of(detector, 1, 1).position.isApprox(Vec3(10.5, -20.25, 498.0), 1e-12));
  EXPECT_EQ(detector.find({1, 61}), std::nullopt);
  EXPECT_EQ(detector.find({0, 91}), std::nullopt);
  EXPECT_TRUE(detector.find({87, 104}).has_value());
  EXPECT_EQ(read_detector_geometry(folder.path() / "geo-f2k").hash(), detector.hash());
  EXPECT_EQ(read_detector(folder.path() / "").name(), detector.name());
}

TEST(DetectorFiles, ReadsEfficienciesAndTheirType) {
  const Folder folder(with("eff-f2k", "1 1 1.35 1\n1 2 0.9\n1 61 1.1\n"));
  const Detector detector = read_detector(folder.path());
  EXPECT_EQ(module_of(detector, 1, 1).relative_efficiency, 1.35);
  EXPECT_TRUE(module_of(detector, 1, 1).high_qe_spectrum);
  EXPECT_EQ(module_of(detector, 1, 2).relative_efficiency, 0.9);
  EXPECT_FALSE(module_of(detector, 1, 2).high_qe_spectrum);
  EXPECT_EQ(module_of(detector, 87, 104).relative_efficiency, 1);
}

TEST(DetectorFiles, ModulesWithoutVoltageAreOff) {
  const Folder folder(with("hvs-f2k", "1 1 1300.5\n1 2 -1 # broken\n"));
  const Detector detector = read_detector(folder.path());
  EXPECT_TRUE(module_of(detector, 1, 1).on);
  EXPECT_FALSE(module_of(detector, 1, 2).on);
  EXPECT_FALSE(module_of(detector, 87, 104).on);  // not listed
}

TEST(DetectorFiles, ReadsTiltsCablesAndDrillHoles) {
  Files files = with("cx.dat", "1 1 0.6 0 0.8 2.5\n");
  files["dx.dat"] = "1 1 90 5\n1 2 -90 5\n";
  files["str-f2k"] = "1 10.25 -20\n";
  const Folder folder(files);
  const Detector detector = read_detector(folder.path());
  EXPECT_TRUE(module_of(detector, 1, 1).up_axis.isApprox(Vec3(0.6, 0, 0.8), 1e-12));
  EXPECT_EQ(module_of(detector, 1, 2).up_axis, Vec3(Vec3::UnitZ()));
  EXPECT_NEAR(module_of(detector, 1, 1).cable_azimuth.value(), pi / 2, 1e-12);
  EXPECT_NEAR(module_of(detector, 1, 2).cable_azimuth.value(), 3 * pi / 2, 1e-12);
  EXPECT_FALSE(module_of(detector, 87, 104).cable_azimuth.has_value());
  EXPECT_EQ(detector.strings().at(1), Eigen::Vector2d(10.25, -20));
  EXPECT_EQ(detector.strings().at(87), Eigen::Vector2d(100, 0));
}

struct Malformed {
  const char* name;
  const char* file;
  const char* content;
  const char* message;  // a part of it
};

class MalformedDetector : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedDetector, IsRefusedWithAReason) {
  const Malformed& bad = GetParam();
  const Folder folder(with(bad.file, bad.content));
  try {
    read_detector(folder.path());
    FAIL() << "was read without an error";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(bad.message), std::string::npos) << message;
    EXPECT_NE(message.find((folder.path() / bad.file).string()), std::string::npos) << message;
  }
}

const Malformed malformed[] = {
    {"EmptyGeometry", "geo-f2k", "# nothing\n", "no module in the ice"},
    {"OnlySurfaceModules", "geo-f2k", "A 0x1 0 0 -1.9 1 61\n", "no module in the ice"},
    {"ColumnMissing", "geo-f2k", "A 0x1 0 0 -1500 1\n", ":1:"},
    {"ColumnTooMany", "geo-f2k", "A 0x1 0 0 -1500 1 1 9\n", ":1:"},
    {"LetterInCoordinate", "geo-f2k", "A 0x1 0 0 -1500 1 1\nB 0x2 1O 0 -1500 2 1\n", ":2:"},
    {"NotANumber", "geo-f2k", "A 0x1 nan 0 -1500 1 1\n", "nan"},
    {"Infinite", "geo-f2k", "A 0x1 0 inf -1500 1 1\n", "inf"},
    {"FarAway", "geo-f2k", "A 0x1 0 10001 -1500 1 1\n", "10001"},
    {"AboveTheSurface", "geo-f2k", "A 0x1 0 0 498 1 1\n", "z is measured from the surface"},
    {"MainboardNotHexadecimal", "geo-f2k", "A 0xfg 0 0 -1500 1 1\n", "'0xfg'"},
    {"MainboardEmptyPrefix", "geo-f2k", "A 0x 0 0 -1500 1 1\n", "mainboard id"},
    {"MainboardTooLong", "geo-f2k", "A 0x12345678901234567 0 0 -1500 1 1\n", "mainboard id"},
    {"StringNotWhole", "geo-f2k", "A 0x1 0 0 -1500 1.5 1\n", "1.5"},
    {"StringOutOfRange", "geo-f2k", "A 0x1 0 0 -1500 100000 1\n", "string number"},
    {"ModuleTwice", "geo-f2k", "A 0x1 0 0 -1500 1 1\nB 0x2 9 0 -1500 1 1\n",
     ":2: found a second row for module 1,1"},
    {"ModulesOverlap", "geo-f2k", "A 0x1 0 0 -1500 1 1\nB 0x2 0 0.1 -1500.1 1 2\n",
     "module 1,1 and module 1,2 overlap"},
    {"EfficiencyOfUnknownModule", "eff-f2k", "1 3 1.35\n", "unknown module 1,3"},
    {"EfficiencyZero", "eff-f2k", "1 1 0\n", "relative efficiency 0"},
    {"EfficiencyNegative", "eff-f2k", "1 1 -1\n", "relative efficiency -1"},
    {"EfficiencyHuge", "eff-f2k", "1 1 10.5\n", "10.5"},
    {"EfficiencyTwice", "eff-f2k", "1 1 1\n1 2 1\n1 1 1\n", ":3: found a second row"},
    {"EfficiencyType", "eff-f2k", "1 1 1 2\n", "type 2"},
    {"EfficiencyShortRow", "eff-f2k", "1 1\n", ":1:"},
    {"VoltageOfUnknownModule", "hvs-f2k", "1 1 1300\n87 1 1300\n", "unknown module 87,1"},
    {"VoltageMissing", "hvs-f2k", "1 1\n", ":1:"},
    {"VoltageNowhere", "hvs-f2k", "1 1 0\n1 2 -1\n", "no module with a high voltage"},
    {"TiltNotUnit", "cx.dat", "1 1 0 0 1.01 1\n", "1.01"},
    {"TiltNull", "cx.dat", "1 1 0 0 0 1\n", "up axis of length 0"},
    {"TiltShortRow", "cx.dat", "1 1 0 0 1\n", ":1:"},
    {"CableBeyondCircle", "dx.dat", "1 1 361 5\n", "361"},
    {"CableTwice", "dx.dat", "1 1 10 5\n1 1 20 5\n", "second row"},
    {"HoleOfUnknownString", "str-f2k", "2 0 0\n", "unknown string 2"},
    {"HoleTwice", "str-f2k", "1 10 -20\n1 10 -20\n", ":2: found a second row for string 1"},
};

INSTANTIATE_TEST_SUITE_P(DetectorFiles, MalformedDetector, testing::ValuesIn(malformed),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(DetectorFiles, MissingGeometryIsNamed) {
  const Folder folder(Files{{"eff-f2k", "1 1 1\n"}});
  try {
    read_detector(folder.path());
    FAIL() << "read a folder without geo-f2k";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("geo-f2k"), std::string::npos) << error.what();
  }
}

class PublicModel : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    folder_ = fs::path(FLOE_SHARED_DIR) / "ice" / GetParam();
    if (!fs::exists(folder_)) GTEST_SKIP() << "no ice model " << folder_;
  }
  fs::path folder_;
};

TEST_P(PublicModel, DetectorLoads) {
  const Detector detector = read_detector(folder_);
  EXPECT_EQ(detector.size(), 5160U);
  EXPECT_EQ(detector.strings().size(), 86U);
  EXPECT_EQ(detector.name(), GetParam());
}

TEST_P(PublicModel, AcceptanceLoads) {
  const AngularAcceptance angular = read_angular_acceptance(folder_ / "as.dat");
  EXPECT_EQ(angular.maximum(), 0.68);
  EXPECT_NEAR(angular.probability(Vec3::UnitZ(), Vec3::UnitZ(), Vec3::UnitZ()), 1, 0.01);
  const WavelengthSpectrum spectrum = read_wavelength_spectrum(folder_ / "wv.dat");
  EXPECT_GT(spectrum.density(400), spectrum.density(600));
  if (fs::exists(folder_ / "wv.rde")) {
    EXPECT_GT(read_high_qe_ratio(folder_ / "wv.rde").maximum(), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(DetectorFiles, PublicModel, testing::Values("spice_bfr-v2", "spice_ftp-v3m"),
                         [](const auto& each) { return std::string(each.param).substr(6, 3); });

}  // namespace
}  // namespace floe
