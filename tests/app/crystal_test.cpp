// floe crystal on the command line: few photons, short paths.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "propagation/ice/ice_model.h"
#include "propagation/ice/ice_tables.h"
#include "tests/app/floe_runner.h"
#include "tests/app/model_directory.h"
#include "tests/app/wrong_cases.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::json;

class Crystal : public ::testing::Test {
 protected:
  Outcome floe_well(const std::string& arguments) const {
    const Outcome outcome = run_floe(folder_.path(), "crystal " + arguments);
    EXPECT_EQ(outcome.code, 0) << "floe crystal " << arguments << "\n" << outcome.err;
    EXPECT_EQ(outcome.err, "") << "floe crystal " << arguments;
    return outcome;
  }
  Json json_of(const std::string& file) const { return Json::parse(bytes_of(folder_.path() / file)); }
  TemporaryFolder folder_;
};

const std::string quick = "--photons 1000 --crossings 200 --angles 0,15,30,45,60,75,90 ";

TEST_F(Crystal, PrintsAndWritesPatterns) {
  const Outcome outcome = floe_well(quick + "--fabric girdle --json p.json -o p.h5 --picture p.svg");
  for (const char* said : {"sigma_x core", "SpiceBFR v2", "chi2/dof", "Tails"})
    EXPECT_NE(outcome.out.find(said), std::string::npos) << said;
  const Json ice = json_of("p.json")["ice"][0];
  EXPECT_EQ(ice["fabric"], "girdle");
  ASSERT_EQ(ice["patterns"].size(), 7U);
  const auto width = [&](int i) { return ice["patterns"][i]["core_sigma_x"]["value"].get<double>(); };
  // Along the flow 0.079 after 1000 crossings; with the root of their number.
  EXPECT_NEAR(width(0), 0.079 * std::sqrt(0.2), 0.006);
  EXPECT_LT(width(6), 0.5 * width(0));
  EXPECT_GT(ice["fit_core"]["sigma_x"]["values"]["A"].get<double>(), 0.06);
  const std::string picture = bytes_of(folder_.path() / "p.svg");
  EXPECT_TRUE(picture.starts_with("<svg "));
  EXPECT_NE(picture.find("SpiceBFR v2"), std::string::npos);
}

TEST_F(Crystal, FileHoldsEveryPhoton) {
  floe_well(quick + "-o p.h5 --quiet");
  const std::string path = (folder_.path() / "p.h5").string();
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const hid_t set = H5Dopen2(file, "ice_0/photons", H5P_DEFAULT), space = H5Dget_space(set);
  hsize_t shape[3];
  ASSERT_EQ(H5Sget_simple_extent_dims(space, shape, nullptr), 3);
  EXPECT_EQ(shape[0], 7U);
  EXPECT_EQ(shape[1], 1000U);
  EXPECT_EQ(shape[2], 6U);
  EXPECT_GT(H5Lexists(file, "ice_0/statistics/core_sigma_x_error", H5P_DEFAULT), 0);
  EXPECT_GT(H5Lexists(file, "ice_0/fit_all/m_x/ABCD", H5P_DEFAULT), 0);
  H5Sclose(space), H5Dclose(set), H5Fclose(file);
}

TEST_F(Crystal, DoesNotDependOnThreads) {
  floe_well(quick + "--threads 1 --json 1.json --quiet");
  floe_well(quick + "--threads 3 --json 3.json --quiet");
  EXPECT_EQ(json_of("1.json")["ice"], json_of("3.json")["ice"]);
}

TEST_F(Crystal, StudiesEveryFabricWithEveryShape) {
  const Outcome outcome =
      floe_well(quick + "--elongation 1,2 --fabric isotropic --fabric 2,1 --json all.json");
  EXPECT_EQ(json_of("all.json")["ice"].size(), 4U);
  EXPECT_NE(outcome.out.find("elongation 2, fabric 2,1"), std::string::npos) << outcome.out;
}

TEST_F(Crystal, SaysWhereScalingFails) {
  const Outcome outcome = floe_well(quick + "--scaling --json p.json");
  EXPECT_NE(outcome.out.find("Fails: off by more than 3 errors"), std::string::npos) << outcome.out;
  EXPECT_GT(json_of("p.json")["ice"][0]["scaling"].size(), 10U);
}

TEST_F(Crystal, WritesIceThatTheRestReads) {
  floe_well(quick + "--grain 2mm --ice south-pole --into coarse --json p.json --quiet");
  const IceTables tables = read_ice_tables(folder_.path() / "coarse");
  ASSERT_TRUE(tables.configuration.birefringence.has_value());
  const Json fitted = json_of("p.json")["ice"][0]["fit_all"]["sigma_y"]["values"];
  EXPECT_EQ(tables.configuration.birefringence->sigma_y.C, fitted["C"].get<double>());
  for (const IceLayerRow& row : tables.layers) EXPECT_DOUBLE_EQ(row.birefringence_strength, 0.5);
  EXPECT_EQ(run_floe(folder_.path(), "info --ice coarse --detector ic86").code, 0);
  EXPECT_NE(bytes_of(folder_.path() / "coarse/CHANGES.txt").find("elongation 1.4"), std::string::npos);
}

TEST_F(Crystal, WritesGrainsOfLayers) {
  write_bytes(folder_.path() / "grains.txt", "1900 1 # mm\n2000 3\n");
  floe_well(quick + "--layer-grains grains.txt --into layered --quiet");
  for (const IceLayerRow& row : read_ice_tables(folder_.path() / "layered").layers) {
    const double size = std::clamp(1 + 2 * (row.depth - 1900) / 100, 1.0, 3.0);
    EXPECT_NEAR(row.birefringence_strength, 1 / size, 1e-12) << row.depth;
  }
}

// Not nearly: every number of the patterns and of their fits, and every photon.
TEST_F(Crystal, MergedSharesAreTheWholeRun) {
  const std::string ice =
      "--crossings 100 --angles 0,20,33.3,50,70,90 --seed 5 --quiet --elongation 1.4,2 --wavelength 420 ";
  floe_well(ice + "--photons 1000 -o whole.h5 --json whole.json");
  floe_well(ice + "--photons 300 -o a.h5");
  floe_well(ice + "--photons 450 --first-photon 300 -o b.h5");
  floe_well(ice + "--photons 250 --first-photon 750 -o c.h5");
  floe_well("--merge c.h5 a.h5 b.h5 -o merged.h5 --json merged.json --quiet");
  Json whole = json_of("whole.json"), merged = json_of("merged.json");
  EXPECT_EQ(merged["ice"].size(), 2U);
  whole.erase("command"), merged.erase("command");
  EXPECT_EQ(merged, whole);
  floe_well("--merge merged.h5 --json again.json --quiet");
  EXPECT_EQ(json_of("again.json")["ice"], whole["ice"]);
}

TEST_F(Crystal, MergedSharesBecomeIceAndPictures) {
  floe_well(quick + "--grain 2mm -o a.h5 --quiet");
  const Outcome outcome =
      floe_well("--merge a.h5 --ice south-pole --into coarse --picture p.svg --estimator core");
  EXPECT_NE(outcome.out.find("1000 photons an angle"), std::string::npos) << outcome.out;
  for (const IceLayerRow& row : read_ice_tables(folder_.path() / "coarse").layers)
    EXPECT_DOUBLE_EQ(row.birefringence_strength, 0.5);
  EXPECT_TRUE(bytes_of(folder_.path() / "p.svg").starts_with("<svg "));
}

// Shares that do not belong together, each beside a.h5 with photons 0 to 199 of seed 1.
TEST_F(Crystal, SharesMustBelongTogether) {
  const std::string ice = "--crossings 20 --angles 0,90 --photons 200 --quiet ";
  floe_well(ice + "-o a.h5");
  floe_well(ice + "--first-photon 100 -o overlap.h5");
  floe_well(ice + "--first-photon 300 -o gap.h5");
  floe_well(ice + "--first-photon 200 --seed 2 -o seed.h5");
  floe_well(ice + "--first-photon 200 --elongation 2 -o shape.h5");
  const std::pair<const char*, const char*> cases[] = {
      {"a.h5", "a.h5: found photons from number 0 on; expected number 200"},
      {"overlap.h5",
       "overlap.h5: found photons from number 100 on; expected number 200, where those of a.h5"},
      {"gap.h5", "gap.h5: found photons from number 300 on"},
      {"seed.h5", "seed.h5: found patterns of another run"},
      {"shape.h5", "shape.h5: found patterns of another run"}};
  for (const auto& [file, said] : cases) {
    const Outcome outcome =
        run_floe(folder_.path(), std::string("crystal --merge a.h5 ") + file + " -o out.h5");
    EXPECT_EQ(outcome.code, 3) << file;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out.h5")) << file;
  }
}

class WrongCrystal : public ::testing::TestWithParam<WrongCase> {};

TEST_P(WrongCrystal, IsSaidAndLeavesNothing) {
  const TemporaryFolder folder;
  write_bytes(folder.path() / "falling.txt", "2000 1\n1900 1\n");
  expect_said_and_nothing_left(folder.path(), GetParam());
}

const WrongCase wrong_cases[] = {
    {"fabric", " --fabric ring", 2, "isotropic, girdle"},
    {"fabric_ratio", " --fabric 0.1,9", 2, "at most 6"},
    {"grain_unit", " --grain 1", 2, "a length with its unit"},
    {"grain_range", " --grain 5m", 2, "--grain"},
    {"elongation", " --elongation 0", 2, "--elongation"},
    {"angles", " --angles 30,10", 2, "rising angles"},
    {"photons", " --photons 10", 2, "--photons"},
    {"estimator", " --estimator best", 2, "all or core"},
    {"picture", " --picture p.png", 2, ".svg"},
    {"picture_of_many", " --elongation 1,2 --picture p.svg", 2, "one kind of ice"},
    {"into_with_few_angles", " --angles 0,45,90 --into new", 2, "5 --angles"},
    {"axes", " --axes 1,2", 2, "FLOW,TILT,VERTICAL"},
    {"layer_grains", " --into new --layer-grains falling.txt", 3, "falling.txt:2"},
    {"no_ice", " --into new --ice nowhere", 3, "nowhere"},
    {"no_folder", " -o nowhere/p.h5", 5, "nowhere"},
    {"merge_and_walk", " --merge falling.txt --photons 1000", 2, "--photons"},
    {"merge_of_text", " --merge falling.txt -o out.h5", 3, "falling.txt: found a file that is not HDF5"},
    {"merge_of_nothing", " --merge nowhere.h5 -o out.h5", 3, "nowhere.h5"},
    {"unknown", " --grains 1mm", 2, "--grain"},
};
INSTANTIATE_TEST_SUITE_P(Cases, WrongCrystal, ::testing::ValuesIn(cases_of("crystal", wrong_cases)),
                         name_of_case);

}  // namespace
}  // namespace floe::test
