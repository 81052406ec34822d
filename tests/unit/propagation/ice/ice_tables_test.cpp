// Reading and writing ice-model directories.
#include "propagation/ice/ice_tables.h"

#include "data/base/error.h"
#include "propagation/ice/ice_hash.h"
#include "propagation/ice/ice_model.h"
#include "tests/unit/propagation/ice/ice_directory.h"

namespace floe {
namespace {

using test::IceDirectory;
using test::TemporaryDirectory;

TEST(ReadIceTables, ReadsEveryColumnOfLayers) {
  const IceDirectory directory;
  const auto tables = read_ice_tables(directory.path());
  ASSERT_EQ(tables.layers.size(), 3u);
  const auto& row = tables.layers[1];
  EXPECT_EQ(row.depth, 1310);
  EXPECT_EQ(row.effective_scattering, 0.05);
  EXPECT_EQ(row.dust_absorption, 0.008);
  EXPECT_EQ(row.temperature_difference, -7.4);
  EXPECT_EQ(row.k1, 0.02);
  EXPECT_EQ(row.k2, -0.04);
  EXPECT_EQ(row.birefringence_strength, 2);
  EXPECT_EQ(row.deflection_strength, 0.9);
}

TEST(ReadIceTables, MissingColumnsTakeDefaults) {
  const IceDirectory directory;
  directory.write("icemodel.dat", "1300 0.12 0.03 -7.5\n1310 0.05 0.008 -7.4\n");
  auto row = read_ice_tables(directory.path()).layers[0];
  EXPECT_FALSE(row.k1.has_value());
  EXPECT_EQ(row.birefringence_strength, 1);
  directory.write("icemodel.dat", "1300 0.12 0.03 -7.5 0 0\n");
  row = read_ice_tables(directory.path()).layers[0];
  EXPECT_EQ(row.k1, 0);  // present, so it overrides the directory's
  EXPECT_EQ(row.birefringence_strength, 1);
  directory.write("icemodel.dat", "1300 0.12 0.03 -7.5 0 0 3\n");
  row = read_ice_tables(directory.path()).layers[0];
  EXPECT_EQ(row.birefringence_strength, 3);
  EXPECT_EQ(row.deflection_strength, 1);
}

TEST(ReadIceTables, ReadsConfigurationInOrder) {
  const IceDirectory directory;
  const auto c = read_ice_tables(directory.path()).configuration;
  EXPECT_EQ(c.oversize, 5);
  EXPECT_EQ(c.module_efficiency, 1.015);
  EXPECT_EQ(c.simplified_liu_fraction, 0.35);
  EXPECT_EQ(c.mean_cosine, 0.9);
  EXPECT_EQ(c.flow_azimuth_deg, 130);
  EXPECT_EQ(c.k1, -0.1);
  EXPECT_EQ(c.k2, 0.05);
  EXPECT_EQ(c.hole_ice.radius, 0);
  EXPECT_EQ(c.hole_ice.effective_scattering_length, 0.03);
  EXPECT_EQ(c.hole_ice.absorption_length, 100);
  EXPECT_EQ(c.hole_ice.simplified_liu_fraction, 0.35);
  EXPECT_EQ(c.hole_ice.mean_cosine, 0.9);
  ASSERT_TRUE(c.absorption_anisotropy);
  EXPECT_EQ(c.absorption_anisotropy->k1, 0.6);
  EXPECT_EQ(c.absorption_anisotropy->k2, -0.3);
  EXPECT_EQ(c.absorption_anisotropy->kz, -0.3);
  EXPECT_EQ(c.old_absorption_scaling, 0);
  ASSERT_TRUE(c.birefringence);
  EXPECT_EQ(c.birefringence->sigma_x.A, 0.076795);
  EXPECT_EQ(c.birefringence->sigma_y.B, 1547618.884);
  EXPECT_EQ(c.birefringence->mean_x.C, 2.354436);
  EXPECT_EQ(c.birefringence->mean_x.D, 1.680717);
}

TEST(ReadIceTables, LaterConfigurationBlocksAreOptional) {
  const IceDirectory directory;
  std::string text = "5\n1\n0.2\n0.9\n";
  directory.write("cfg.txt", text);
  auto c = read_ice_tables(directory.path()).configuration;
  EXPECT_EQ(c.flow_azimuth_deg, 0);
  EXPECT_FALSE(c.absorption_anisotropy);
  EXPECT_EQ(c.old_absorption_scaling, 1);
  text += "126\n-0.08\n0.04\n";
  directory.write("cfg.txt", text);
  c = read_ice_tables(directory.path()).configuration;
  EXPECT_EQ(c.k2, 0.04);
  EXPECT_EQ(c.hole_ice.radius, 0);
  text += "0.5\n0.04\n90\n0.3\n0.8\n";
  directory.write("cfg.txt", text);
  c = read_ice_tables(directory.path()).configuration;
  EXPECT_EQ(c.hole_ice.radius, 0.5);
  EXPECT_EQ(c.hole_ice.mean_cosine, 0.8);
  EXPECT_FALSE(c.birefringence);
}

TEST(ReadIceTables, ReadsWavelengthDependenceBubblesVersion) {
  const IceDirectory directory;
  auto tables = read_ice_tables(directory.path());
  EXPECT_EQ(tables.wavelength.alpha, 0.9);
  EXPECT_EQ(tables.wavelength.B, 6618);
  EXPECT_EQ(tables.wavelength.uncertainty[3], 71);
  EXPECT_FALSE(tables.wavelength.D);
  ASSERT_TRUE(tables.bubbles);
  EXPECT_EQ(tables.bubbles->d2, 1400);
  EXPECT_EQ(tables.version, 10);
  EXPECT_EQ(read_ice_tables(directory.path(), 20).version, 20);

  directory.write("icemodel.par", test::wavelength_text + "400 5\n-3 1\n");
  directory.remove("icemodel.bbl");
  directory.remove("version");
  tables = read_ice_tables(directory.path());
  EXPECT_EQ(tables.wavelength.D, 400);
  EXPECT_EQ(tables.wavelength.E, -3);
  EXPECT_FALSE(tables.bubbles);
  EXPECT_EQ(tables.version, 0);
}

TEST(ReadIceTables, ReadsBothTilts) {
  const IceDirectory directory;
  const auto tables = read_ice_tables(directory.path());
  ASSERT_TRUE(tables.tilt_lines);
  EXPECT_EQ(tables.tilt_lines->strings, (std::vector<int>{50, 86, 14}));
  EXPECT_EQ(tables.tilt_lines->distances, (std::vector<double>{-500.5, 0, 480}));
  EXPECT_EQ(tables.tilt_lines->shifts[1], (std::vector<double>{-2.5, 0, 6}));
  ASSERT_TRUE(tables.tilt_map);
  EXPECT_EQ(tables.tilt_map->second.step, 105);
  EXPECT_EQ(tables.tilt_map->first.cut, 2);
  EXPECT_EQ(tables.tilt_map->depths, (std::vector<double>{1200, 1210}));
  EXPECT_EQ(tables.tilt_map->shifts[1].back(), 14);
}

TEST(ReadIceTables, IsNamedAfterTheDirectoryAndIgnoresOtherFiles) {
  const IceDirectory directory;
  directory.write("rnd.txt", "not a number\n");
  const std::string name = directory.path().filename().string();
  EXPECT_EQ(read_ice_tables(directory.path()).name, name);
  EXPECT_EQ(read_ice_tables(directory.path().string() + "/").name, name);
}

TEST(ReadIceTables, OverridingVersionMustBeKnown) {
  const IceDirectory directory;
  EXPECT_THROW(read_ice_tables(directory.path(), 7), UsageError);
}

// The hash covers every number that matters; what it leaves out is compared by hand.
void expect_same(const IceTables& a, const IceTables& b) {
  EXPECT_EQ(ice_hash(a), ice_hash(b));
  EXPECT_EQ(a.configuration.oversize, b.configuration.oversize);
  EXPECT_EQ(a.wavelength.uncertainty, b.wavelength.uncertainty);
  EXPECT_EQ(a.version, b.version);
  EXPECT_EQ(a.tilt_lines.has_value(), b.tilt_lines.has_value());
  if (a.tilt_lines && b.tilt_lines) {
    EXPECT_EQ(a.tilt_lines->shifts, b.tilt_lines->shifts);
    EXPECT_EQ(a.tilt_lines->distances, b.tilt_lines->distances);
  }
}

TEST(WriteIceTables, RoundTripsEveryFile) {
  const IceDirectory source;
  const TemporaryDirectory copy;
  const auto tables = read_ice_tables(source.path());
  write_ice_tables(tables, copy.path());
  expect_same(tables, read_ice_tables(copy.path()));
}

TEST(WriteIceTables, RoundTripsNumbersThatNeedAllTheirDigits) {
  const TemporaryDirectory copy;
  auto tables = south_pole_ice();
  tables.layers[7].effective_scattering = 0.1 + 1e-17 + 1.0 / 3;
  tables.configuration.flow_azimuth_deg = 100.0 / 3;
  write_ice_tables(tables, copy.path());
  const auto read = read_ice_tables(copy.path());
  expect_same(tables, read);
  EXPECT_EQ(read.layers[7].effective_scattering, tables.layers[7].effective_scattering);
}

TEST(WriteIceTables, WritesOnlyWhatTheTablesHold) {
  const IceDirectory directory;  // full of files that the tables have no content for
  directory.write("rnd.txt", "1 2 3\n");
  write_ice_tables(south_pole_ice(), directory.path());
  for (const auto* file : {"icemodel.bbl", "tilt.par", "tilt.dat", "tilt.set", "tilt.map", "version"})
    EXPECT_FALSE(test::fs::exists(directory.path() / file)) << file;
  EXPECT_TRUE(test::fs::exists(directory.path() / "rnd.txt"));
  expect_same(south_pole_ice(), read_ice_tables(directory.path()));
}

TEST(WriteIceTables, OldModelsKeepTheirForm) {
  const IceDirectory source;
  source.write("icemodel.dat", "1300 12 3 -7.5\n1310 11 3 -7.4\n");
  source.write("cfg.txt", "5\n1\n0.2\n0.9\n126\n-0.08\n0.04\n");
  source.write("icemodel.par", test::wavelength_text + "400 5\n3 1\n");
  const TemporaryDirectory copy;
  const auto tables = read_ice_tables(source.path());
  write_ice_tables(tables, copy.path());
  const auto read = read_ice_tables(copy.path());
  expect_same(tables, read);
  EXPECT_FALSE(read.layers[0].k1);  // still the directory's
  EXPECT_EQ(read.wavelength.E, 3);
  EXPECT_FALSE(read.configuration.absorption_anisotropy);
  EXPECT_EQ(read.configuration.old_absorption_scaling, 1);
}

TEST(WriteIceTables, CannotSayThatAPartOfBirefringenceIsOff) {
  const TemporaryDirectory copy;
  auto tables = south_pole_ice();
  tables.configuration.birefringence->deflection = false;
  EXPECT_THROW(write_ice_tables(tables, copy.path()), UsageError);
  EXPECT_TRUE(test::fs::is_empty(copy.path()));
}

TEST(WriteIceTables, NeedsADirectory) {
  EXPECT_THROW(write_ice_tables(south_pole_ice(), "/nonexistent/ice"), OutputError);
}

class PublicIce : public testing::TestWithParam<std::string> {};

TEST_P(PublicIce, LoadsAndRoundTrips) {
  FLOE_NEEDS_PUBLIC_ICE(GetParam());
  const auto tables = read_ice_tables(test::public_ice(GetParam()));
  EXPECT_EQ(tables.name, GetParam());
  EXPECT_EQ(tables.layers.size(), 171u);
  const TemporaryDirectory copy;
  write_ice_tables(tables, copy.path());
  expect_same(tables, read_ice_tables(copy.path()));
}

INSTANTIATE_TEST_SUITE_P(Models, PublicIce, testing::Values("spice_bfr-v2", "spice_ftp-v3m"),
                         [](const auto& test_case) {
                           return test_case.param == "spice_bfr-v2" ? std::string("SpiceBfr") : "SpiceFtp";
                         });

}  // namespace
}  // namespace floe
