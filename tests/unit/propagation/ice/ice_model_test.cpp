// From tables to coefficients: versions, bubbles, layers, validation, the hash.
#include "propagation/ice/ice_model.h"

#include <cmath>
#include <functional>

#include "data/base/constants.h"
#include "data/base/error.h"
#include "data/base/vec3.h"
#include "tests/unit/propagation/ice/ice_directory.h"

namespace floe {
namespace {

using test::small_detector;

constexpr double alpha = 0.9, kappa = 1.1, A = 7000, B = 6600;

// Three layers of which the middle one differs.
IceTables plain_tables() {
  IceTables tables;
  tables.name = "plain";
  tables.layers = {{1300, 0.05, 0.01, -7, {}, {}, 1, 1},
                   {1310, 0.08, 0.02, -6, 0.01, 0.02, 2, 0.5},
                   {1320, 0.06, 0.03, -5, {}, {}, 3, 1}};
  tables.wavelength.alpha = alpha, tables.wavelength.kappa = kappa;
  tables.wavelength.A = A, tables.wavelength.B = B;
  tables.configuration.flow_azimuth_deg = 130;
  return tables;
}

IceTables birefringent_tables(int version) {
  auto tables = plain_tables();
  tables.version = version;
  tables.configuration.birefringence = south_pole_ice().configuration.birefringence;
  return tables;
}

IceModel model_of(const IceTables& tables) {
  return IceModel(tables, small_detector());
}

TEST(IceModel, LayersStandBottomUp) {
  const auto ice = model_of(plain_tables());
  EXPECT_EQ(ice.layers().size(), 3u);
  EXPECT_DOUBLE_EQ(ice.layer_step(), 10);
  EXPECT_DOUBLE_EQ(ice.z_bottom(), origin_depth - 1325);
  EXPECT_EQ(ice.layers()[0].scattering_power, 0.06);
  EXPECT_EQ(ice.layers()[2].scattering_power, 0.05);
}

TEST(IceModel, OutermostLayersContinue) {
  const auto ice = model_of(plain_tables());
  const double z = ice.z_bottom();
  EXPECT_EQ(ice.layer_at(z - 1e9), 0);
  EXPECT_EQ(ice.layer_at(z + 9.999), 0);
  EXPECT_EQ(ice.layer_at(z + 10.001), 1);
  EXPECT_EQ(ice.layer_at(z + 20.001), 2);
  EXPECT_EQ(ice.layer_at(z + 1e9), 2);
}

TEST(IceModel, ASingleLayerFillsSpace) {
  auto tables = plain_tables();
  tables.layers.resize(1);
  const auto ice = model_of(tables);
  EXPECT_EQ(ice.layer_at(-5000), 0);
  EXPECT_EQ(ice.layer_at(5000), 0);
  EXPECT_GT(ice.layer_step(), 0);
}

TEST(IceModel, ScattersAndAbsorbsByWavelength) {
  const auto ice = model_of(plain_tables());
  for (double wavelength : {320.0, 400.0, 550.0}) {
    const double scattering = 0.08 * std::pow(wavelength / 400, -alpha);
    const double absorption =
        0.02 * std::pow(wavelength / 400, -kappa) + A * std::exp(-B / wavelength) * (1 - 0.06);
    EXPECT_NEAR(ice.effective_scattering(1, wavelength), scattering, 1e-12);
    EXPECT_NEAR(ice.geometric_scattering(1, wavelength), scattering / (1 - 0.9), 1e-11);
    EXPECT_NEAR(ice.absorption(1, wavelength), absorption, 1e-12);
  }
}

TEST(IceModel, BubblesScatterAllColoursAboveTheirDepths) {
  auto tables = plain_tables();
  const auto without = model_of(tables);
  tables.bubbles = Bubbles{11.7, 1316, 1400};
  const auto with = model_of(tables);
  for (double wavelength : {320.0, 500.0}) {
    const auto added = [&](int layer) {
      return with.effective_scattering(layer, wavelength) - without.effective_scattering(layer, wavelength);
    };
    EXPECT_NEAR(added(0), 0, 1e-15);  // 1320 m is below d1
    EXPECT_NEAR(added(1), 11.7 * (1 - 1310.0 / 1316) * (1 - 1310.0 / 1400), 1e-12);
    EXPECT_NEAR(added(2), 11.7 * (1 - 1300.0 / 1316) * (1 - 1300.0 / 1400), 1e-12);
  }
}

TEST(IceModel, VersionsSubtractTheBirefringentShareDifferently) {
  const auto v0 = model_of(birefringent_tables(0)), v10 = model_of(birefringent_tables(10)),
             v20 = model_of(birefringent_tables(20));
  const double S = v0.birefringent_scattering();
  EXPECT_GT(S, 0);
  for (double wavelength : {330.0, 400.0, 550.0}) {
    const double s = std::pow(wavelength / 400, -alpha);
    EXPECT_NEAR(v10.effective_scattering(1, wavelength), 0.08 * s, 1e-12);
    EXPECT_NEAR(v0.effective_scattering(1, wavelength), 0.08 * s - 2 * S, 1e-12);
    EXPECT_NEAR(v20.effective_scattering(1, wavelength), 0.08 * s - 2 * S * s, 1e-12);
  }
}

TEST(IceModel, VersionTwentyTabulatesTheWholeAbsorptionAt400nm) {
  const auto v10 = model_of(birefringent_tables(10)), v20 = model_of(birefringent_tables(20));
  EXPECT_NEAR(v20.absorption(1, 400), 0.02, 1e-12);
  const double thermal = A * std::exp(-B / 400.0) * (1 - 0.06);
  EXPECT_NEAR(v20.absorption(1, 500), v10.absorption(1, 500) - thermal * std::pow(500.0 / 400, -kappa),
              1e-12);
}

TEST(IceModel, OldDustAbsorptionIsScaledFromConcentration) {
  auto tables = plain_tables();
  tables.wavelength.D = 400, tables.wavelength.E = 3;
  const auto ice = model_of(tables);
  EXPECT_NEAR(ice.layers()[1].absorption_dust, (400 * 0.02 + 3) * std::pow(400, -kappa), 1e-12);
}

TEST(IceModel, RowsOverrideTheDirectorysAnisotropy) {
  auto tables = plain_tables();
  tables.configuration.k1 = -0.1, tables.configuration.k2 = 0.05;
  const auto ice = model_of(tables);
  EXPECT_EQ(ice.layers()[0].k1, -0.1);
  EXPECT_EQ(ice.layers()[0].k2, 0.05);
  EXPECT_EQ(ice.layers()[1].k1, 0.01);
  EXPECT_EQ(ice.layers()[1].k2, 0.02);
}

TEST(IceModel, OldAbsorptionScalingNeedsAnisotropicScattering) {
  auto tables = plain_tables();
  EXPECT_EQ(model_of(tables).old_absorption_scaling(), 1);
  for (auto& row : tables.layers) row.k1 = row.k2 = 0;
  EXPECT_EQ(model_of(tables).old_absorption_scaling(), 0);
}

TEST(IceModel, StrengthsOfBirefringence) {
  const auto ice = model_of(birefringent_tables(0));
  EXPECT_EQ(ice.layers()[1].diffusion_strength, 2);
  EXPECT_EQ(ice.layers()[1].deflection_strength, 1);  // 2 x 0.5
  const auto isotropic = model_of(plain_tables());
  EXPECT_EQ(isotropic.layers()[1].diffusion_strength, 0);
  EXPECT_EQ(isotropic.layers()[1].deflection_strength, 0);
  EXPECT_EQ(isotropic.birefringent_scattering(), 0);
}

TEST(IceModel, SwitchingAPartOffLeavesTheSubtraction) {
  auto tables = birefringent_tables(0);
  const double scattering = model_of(tables).effective_scattering(0, 400);
  tables.configuration.birefringence->diffusion = false;
  EXPECT_EQ(model_of(tables).effective_scattering(0, 400), scattering);
}

TEST(IceModel, FlowAzimuthIsInRadians) {
  EXPECT_NEAR(model_of(plain_tables()).flow_azimuth(), 130 * pi / 180, 1e-15);
}

// --- validation ---

struct Unphysical {
  std::string name;
  std::function<void(IceTables&)> spoil;
  std::vector<std::string> message;
};
void PrintTo(const Unphysical& unphysical, std::ostream* out) {
  *out << unphysical.name;
}

const std::vector<Unphysical> unphysical_tables{
    {"NoLayers", [](IceTables& t) { t.layers.clear(); }, {"no layers"}},
    {"NanScattering", [](IceTables& t) { t.layers[1].effective_scattering = NAN; }, {"1310", "scattering"}},
    {"NegativeAbsorption", [](IceTables& t) { t.layers[2].dust_absorption = -1; }, {"1320", "absorption"}},
    {"NoScattering",
     [](IceTables& t) {
       t.version = 10;
       t.layers[1].effective_scattering = 0;
     },
     {"1310", "positive scattering"}},
    {"NoAbsorption",
     [](IceTables& t) {
       t.wavelength.A = 0;
       t.layers[0].dust_absorption = 0;
     },
     {"1300", "positive absorption"}},
    {"BirefringentShare",
     [](IceTables& t) { t.layers[1].birefringence_strength = 50; },
     {"1310", "birefringent share", "exceeds the scattering", "strength A"}},
    {"ShareAtLongWavelengthsOnly",
     [](IceTables& t) { t.layers[1].birefringence_strength = 0.052 / 0.00246857; },
     {"1310", "birefringent share", "nm"}},
    {"AbsorptionOfVersionTwenty",
     [](IceTables& t) {
       t.version = 20;
       t.layers[0].dust_absorption = 1e-9;
     },
     {"1300", "absorption", "nm"}},
    {"LayersNotUniform", [](IceTables& t) { t.layers[2].depth = 1321; }, {"uniform"}},
    {"LayersBottomFirst", [](IceTables& t) { std::swap(t.layers[0], t.layers[2]); }, {"rise"}},
    {"MeanCosineOne", [](IceTables& t) { t.configuration.mean_cosine = 1; }, {"mean cosine"}},
    {"FractionTwo", [](IceTables& t) { t.configuration.simplified_liu_fraction = 2; }, {"f_SL"}},
    {"EfficiencyZero", [](IceTables& t) { t.configuration.module_efficiency = 0; }, {"efficiency"}},
    {"VersionSeven", [](IceTables& t) { t.version = 7; }, {"version 7"}},
    {"TiltRowShort",
     [](IceTables& t) {
       t.tilt_lines = TiltLines{{86, 1}, {0, 100}, {1200, 1210}, {{0, 1}, {0}}};
     },
     {"layer shifts"}},
    {"TiltOfUnknownString",
     [](IceTables& t) {
       t.tilt_lines = TiltLines{{7, 86}, {0, 100}, {1200, 1210}, {{0, 1}, {0, 1}}};
     },
     {"string 7", "small"}},
    {"TiltAxesParallel",
     [](IceTables& t) {
       t.tilt_map = TiltMap{{10, 0, 1, 2, 2}, {190, 0, 1, 2, 2}, {1200, 1210}, {{0, 0, 0, 0}, {0, 0, 0, 0}}};
     },
     {"parallel"}},
};

class UnphysicalIce : public testing::TestWithParam<Unphysical> {};

TEST_P(UnphysicalIce, IsRefused) {
  auto tables = birefringent_tables(0);
  ASSERT_NO_THROW(model_of(tables));
  GetParam().spoil(tables);
  try {
    model_of(tables);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    for (const auto& part : GetParam().message)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << "\n" << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(Tables, UnphysicalIce, testing::ValuesIn(unphysical_tables),
                         [](const auto& test_case) { return test_case.param.name; });

TEST(IceModel, OpaqueLayersAreAllowed) {
  auto tables = plain_tables();
  tables.layers[2].dust_absorption = 1124.79;
  EXPECT_NO_THROW(model_of(tables));
}

// --- hash ---

TEST(IceHash, Is32HexadecimalDigitsAndDoesNotDependOnTheName) {
  auto tables = birefringent_tables(0);
  const std::string hash = model_of(tables).hash();
  EXPECT_EQ(hash.size(), 32u);
  EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);
  tables.name = "another";
  tables.wavelength.uncertainty[0] = 5;
  EXPECT_EQ(model_of(tables).hash(), hash);
}

TEST(IceHash, ChangesWithEveryNumberThatMatters) {
  using Change = std::function<void(IceTables&)>;
  auto base = birefringent_tables(0);
  base.tilt_lines = TiltLines{{86, 1}, {0, 100}, {1200, 1210}, {{0, 1}, {0, 1}}};
  const Change changes[] = {
      [](IceTables& t) { t.version = 10; },
      [](IceTables& t) { t.layers[0].depth += 1e-6; },
      [](IceTables& t) { t.layers[0].effective_scattering *= 1 + 1e-15; },
      [](IceTables& t) { t.layers[2].dust_absorption *= 1.01; },
      [](IceTables& t) { t.layers[2].temperature_difference = 0; },
      [](IceTables& t) { t.layers[2].k1 = 0.1; },
      [](IceTables& t) { t.configuration.k2 = 0.1; },
      [](IceTables& t) { t.layers[2].birefringence_strength = 0; },
      [](IceTables& t) { t.layers[2].deflection_strength = 0; },
      [](IceTables& t) { t.wavelength.kappa = 1; },
      [](IceTables& t) { t.wavelength.D = 1, t.wavelength.E = 0; },
      [](IceTables& t) {
        t.bubbles = Bubbles{1, 1200, 1300};
      },
      [](IceTables& t) { t.configuration.module_efficiency = 0.9; },
      [](IceTables& t) { t.configuration.simplified_liu_fraction = 0.1; },
      [](IceTables& t) { t.configuration.mean_cosine = 0.8; },
      [](IceTables& t) { t.configuration.flow_azimuth_deg = 126; },
      [](IceTables& t) { t.configuration.hole_ice.radius = 0.5; },
      [](IceTables& t) {
        t.configuration.absorption_anisotropy = {0.1, 0, 0};
      },
      [](IceTables& t) { t.configuration.old_absorption_scaling = 0; },
      [](IceTables& t) { t.configuration.birefringence->mean_x.D = 2; },
      [](IceTables& t) { t.configuration.birefringence->displacement = false; },
      [](IceTables& t) { t.configuration.birefringence.reset(); },
      [](IceTables& t) { t.tilt_lines->shifts[1][0] = 0.5; },
      [](IceTables& t) { t.tilt_lines.reset(); },
      [](IceTables& t) {
        t.tilt_map = TiltMap{{10, 0, 1, 2, 2}, {130, 0, 1, 2, 2}, {1200, 1210}, {{0, 0, 0, 0}, {0, 0, 0, 0}}};
      },
  };
  std::vector<std::string> hashes{model_of(base).hash()};
  for (const auto& change : changes) {
    auto changed = base;
    change(changed);
    hashes.push_back(model_of(changed).hash());
  }
  for (std::size_t i = 0; i < hashes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(hashes[i], hashes[j]) << "changes " << i << " and " << j;
}

TEST(IceHash, AbsentAnisotropyIsZeroAnisotropy) {
  auto tables = plain_tables();
  const std::string absent = model_of(tables).hash();
  tables.configuration.absorption_anisotropy = {0, 0, -0.0};
  EXPECT_EQ(model_of(tables).hash(), absent);
}

}  // namespace
}  // namespace floe
