// floe validate on a reference of our own: the same light, simulated beforehand with another seed, in ice
// and modules that make it little work.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "propagation/ice/ice_tables.h"
#include "tests/app/floe_runner.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::json;

// Four modules around the flashing one, of so little efficiency that there is little light to simulate.
void write_small_model(const std::filesystem::path& directory) {
  std::filesystem::create_directories(directory);
  IceTables tables = south_pole_ice();
  tables.configuration.module_efficiency = 0.002;
  write_ice_tables(tables, directory);
  write_bytes(directory / "geo-f2k",
              "m1 0x1 0 0 -2148 36 45\n"
              "m2 0x2 15 0 -2148 37 45\n"
              "m3 0x3 -15 0 -2140 38 45\n"
              "m4 0x4 0 20 -2150 39 45\n"
              "m5 0x5 3 -18 -2155 40 45\n");
  write_bytes(directory / "as.dat", "1\n0.5\n0.5\n");
  write_bytes(directory / "wv.dat", "0 300\n1 600\n");
}

class Validate : public testing::Test {
 protected:
  void SetUp() override {
    write_small_model(folder_.path() / "ice" / "spice_bfr-v2");
    std::filesystem::create_directories(folder_.path() / "reference");
    make_reference("1e9");
  }
  // The set flasher-36_45_bfr is the light of 1e9 photons.
  void make_reference(const std::string& photons) {
    for (const std::string& command :
         {"simulate --ice ice/spice_bfr-v2 --flasher 36,45 --quiet --seed 7 -o flash.h5 --photons " + photons,
          std::string("export flash.h5 --quiet -o reference/flasher-36_45_bfr.hits.gz")}) {
      const Outcome outcome = run_floe(folder_.path(), command);
      ASSERT_EQ(outcome.code, 0) << command << "\n" << outcome.err;
    }
  }
  Outcome validate(const std::string& arguments) {
    return run_floe(folder_.path(),
                    "validate --reference reference --only flasher-36_45_bfr --json v.json " + arguments);
  }
  Json result() { return Json::parse(bytes_of(folder_.path() / "v.json")); }

  TemporaryFolder folder_;
};

TEST_F(Validate, BothEnginesAgreeWithTheSameLight) {
  for (const std::string engine : {"vector", "plain"}) {
    const Outcome outcome = validate("--engine " + engine);
    EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
    EXPECT_NE(outcome.out.find(engine + " engine"), std::string::npos) << outcome.out;
    const Json json = result();
    EXPECT_EQ(json["engine"], engine);
    EXPECT_EQ(json["passed"], true);
    EXPECT_GT(json["sets"].at(0)["modules"], 0);
  }
  EXPECT_EQ(validate("").code, 0);
  EXPECT_EQ(result()["engine"], "vector");  // unless another is named
}

TEST_F(Validate, OtherLightIsADisagreement) {
  make_reference("2e9");
  for (const std::string engine : {"vector", "plain"}) {
    const Outcome outcome = validate("--engine " + engine);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.out.find("fail"), std::string::npos) << outcome.out;
    EXPECT_EQ(result()["passed"], false);
  }
}

}  // namespace
}  // namespace floe::test
