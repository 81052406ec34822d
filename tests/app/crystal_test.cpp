// floe crystal on the command line: few photons, short paths.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <nlohmann/json.hpp>

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
    {"unknown", " --grains 1mm", 2, "--grain"},
};
INSTANTIATE_TEST_SUITE_P(Cases, WrongCrystal, ::testing::ValuesIn(cases_of("crystal", wrong_cases)),
                         name_of_case);

}  // namespace
}  // namespace floe::test
