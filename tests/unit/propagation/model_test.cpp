// Models as a user names them on the command line.
#include "propagation/model.h"

#include <gtest/gtest.h>

#include "data/base/error.h"
#include "propagation/model_hash.h"
#include "tests/unit/propagation/ice/ice_directory.h"

namespace floe {
namespace {

using test::IceDirectory;

// A directory with detector and acceptance besides the ice.
class FullDirectory : public IceDirectory {
 public:
  FullDirectory() {
    // z from the surface: the modules are at z = 100 and 80 m of the detector frame.
    write("geo-f2k",
          "aa01 0x1 10 -20 -1848.07 86 1\n"
          "aa02 0x2 10 -20 -1868.07 86 2\n");
    write("as.dat", "0.68\n0.34\n0.21\n");
    write("wv.dat", "0 300\n0.5 400\n1 600\n");
    write("dx.dat", "86 1 45 1\n");
  }
  ModelRequest request() const {
    ModelRequest request;
    request.ice = path().string();
    return request;
  }
};

template <class ErrorType>
std::string error_of(const ModelRequest& request) {
  try {
    load_model(request);
  } catch (const ErrorType& error) {
    return error.what();
  }
  return "no such error";
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(LoadModel, BuiltInNeedsNoFiles) {
  const auto model = load_model({});
  EXPECT_EQ(model.ice->name(), "south-pole");
  EXPECT_GT(model.detector->size(), 5000u);
  EXPECT_EQ(model.acceptance.overall_efficiency, 1);
  EXPECT_GT(model.acceptance.angular.maximum(), 0);
}

TEST(LoadModel, ReadsADirectory) {
  const FullDirectory directory;
  const auto model = load_model(directory.request());
  EXPECT_EQ(model.detector->size(), 2u);
  EXPECT_EQ(model.ice->tables().version, 10);
  EXPECT_EQ(model.acceptance.overall_efficiency, 1.015);
  EXPECT_EQ(model.acceptance.angular.maximum(), 0.68);
  EXPECT_EQ(model.acceptance.spectrum.points().size(), 3u);
  EXPECT_FALSE(model.acceptance.high_qe);
}

TEST(LoadModel, VersionCanBeOverridden) {
  const FullDirectory directory;
  auto request = directory.request();
  request.ice_version = 0;
  EXPECT_EQ(load_model(request).ice->tables().version, 0);
  request.ice_version = 5;
  EXPECT_THROW(load_model(request), UsageError);
  request.ice = "south-pole";
  request.ice_version = 0;
  EXPECT_THROW(load_model(request), UsageError);
}

TEST(LoadModel, DetectorByName) {
  const FullDirectory directory;
  auto request = directory.request();
  request.detector = "ic86";
  EXPECT_GT(load_model(request).detector->size(), 5000u);
  request.ice = "south-pole";
  request.detector = (directory.path() / "geo-f2k").string();
  EXPECT_EQ(load_model(request).detector->size(), 2u);
  EXPECT_FALSE(load_model(request).detector->modules()[0].cable_azimuth);
  request.detector = directory.path().string();
  const auto model = load_model(request);
  EXPECT_TRUE(model.detector->modules()[0].cable_azimuth);
  EXPECT_EQ(model.acceptance.angular.maximum(), 0.68);  // of the named directory
  request.detector = "nowhere";
  expect_contains(error_of<InputError>(request), "ic86");
}

TEST(LoadModel, CableShadowBelongsToTheDetector) {
  const FullDirectory directory;
  auto request = directory.request();
  const auto with = load_model(request);
  request.without = {"cable-shadow"};
  const auto without = load_model(request);
  EXPECT_TRUE(with.detector->modules()[0].cable_azimuth);
  EXPECT_FALSE(without.detector->modules()[0].cable_azimuth);
  EXPECT_EQ(without.detector->modules()[0].position, with.detector->modules()[0].position);
  EXPECT_EQ(without.ice->hash(), with.ice->hash());
}

TEST(LoadModel, HighQeModulesNeedTheirSpectrum) {
  const FullDirectory directory;
  directory.write("eff-f2k", "86 1 1.35 1\n86 2 1\n");
  expect_contains(error_of<InputError>(directory.request()), "86,1");
  expect_contains(error_of<InputError>(directory.request()), "wv.rde");
  directory.write("wv.rde", "300 1.1\n600 1.4\n");
  const auto model = load_model(directory.request());
  EXPECT_TRUE(model.acceptance.high_qe);
  EXPECT_TRUE(model.detector->modules()[0].high_qe_spectrum);
}

TEST(LoadModel, SaysWhatADirectoryLacks) {
  const FullDirectory directory;
  auto request = directory.request();
  request.ice = "/nonexistent";
  expect_contains(error_of<InputError>(request), "no such directory");
  request = directory.request();
  directory.remove("wv.dat");
  expect_contains(error_of<InputError>(request), "wv.dat");
  directory.remove("as.dat");
  expect_contains(error_of<InputError>(request), "as.dat");
  request.detector = "ic86";
  EXPECT_NO_THROW(load_model(request));  // with the built-in acceptance
  request.detector.reset();
  directory.remove("geo-f2k");
  expect_contains(error_of<InputError>(request), "--detector");
  directory.remove("icemodel.dat");
  expect_contains(error_of<InputError>(request), "icemodel.dat");
}

TEST(SwitchOff, EachEffectGoesAlone) {
  const IceDirectory directory;
  const auto base = read_ice_tables(directory.path());
  const auto without = [&](std::string_view effect) {
    auto tables = base;
    switch_off(tables, effect);
    return tables;
  };
  EXPECT_FALSE(without("birefringence").configuration.birefringence);
  EXPECT_FALSE(without("birefringence.diffusion").configuration.birefringence->diffusion);
  EXPECT_TRUE(without("birefringence.diffusion").configuration.birefringence->deflection);
  EXPECT_FALSE(without("birefringence.deflection").configuration.birefringence->deflection);
  EXPECT_FALSE(without("birefringence.displacement").configuration.birefringence->displacement);
  EXPECT_FALSE(without("absorption-anisotropy").configuration.absorption_anisotropy);
  EXPECT_EQ(without("absorption-anisotropy").configuration.k1, -0.1);
  EXPECT_EQ(without("scattering-anisotropy").configuration.k1, 0);
  EXPECT_EQ(without("scattering-anisotropy").layers[1].k1, 0);
  EXPECT_TRUE(without("scattering-anisotropy").configuration.absorption_anisotropy);
  EXPECT_FALSE(without("tilt").tilt_lines);
  EXPECT_FALSE(without("tilt").tilt_map);
  EXPECT_EQ(without("hole-ice").configuration.hole_ice.radius, 0);
  EXPECT_FALSE(without("bubbles").bubbles);
  EXPECT_TRUE(without("cable-shadow").bubbles);
}

TEST(SwitchOff, BirefringenceTakesItsSubtractionAlong) {
  ModelRequest request;
  const auto with = load_model(request).ice;
  request.without = {"birefringence"};
  const auto without = load_model(request).ice;
  const double strength = with->layers()[50].diffusion_strength;
  EXPECT_GT(strength, 0);
  EXPECT_NEAR(without->effective_scattering(50, 450) - with->effective_scattering(50, 450),
              strength * with->birefringent_scattering(), 1e-12);
  EXPECT_EQ(without->layers()[50].diffusion_strength, 0);
  EXPECT_NE(without->hash(), with->hash());
}

TEST(SwitchOff, UnknownEffectNamesTheNearestFirst) {
  ModelRequest request;
  request.without = {"birefringense"};
  const std::string message = error_of<UsageError>(request);
  expect_contains(message, "did you mean 'birefringence'?");
  for (const auto& effect : switchable_effects()) expect_contains(message, effect);
  request.without = {"absorbtion-anisotropy"};
  expect_contains(error_of<UsageError>(request), "did you mean 'absorption-anisotropy'?");
  request.without = {""};
  EXPECT_THROW(load_model(request), UsageError);
}

TEST(SwitchOff, UnknownEffectIsSaidBeforeMissingFiles) {
  ModelRequest request;
  request.ice = "/nonexistent";
  request.without = {"gravity"};
  EXPECT_THROW(load_model(request), UsageError);
}

TEST(LoadModel, PublicModels) {
  for (const auto* name : {"spice_bfr-v2", "spice_ftp-v3m"}) {
    FLOE_NEEDS_PUBLIC_ICE(name);
    ModelRequest request;
    request.ice = test::public_ice(name).string();
    const auto model = load_model(request);
    EXPECT_EQ(model.ice->layers().size(), 171u);
    EXPECT_FALSE(model.ice->tilt().is_flat());
    EXPECT_EQ(model.acceptance.angular.maximum(), 0.68);
    EXPECT_EQ(model.acceptance.high_qe.has_value(), std::string(name) == "spice_ftp-v3m");
  }
}

// Models of one name give the same light.
TEST(ModelHash, ChangesWithEveryPart) {
  const Model model = load_model({});
  const std::string same = model_hash(model);
  EXPECT_EQ(same, model_hash(load_model({})));
  const auto with = [](const std::string& setting) {
    ModelRequest request;
    request.with = {parse_effect_setting(setting)};
    return model_hash(load_model(request));
  };
  for (const char* setting : {"absorption-scale.factor=1.1", "angular-acceptance.slope=0.2",
                              "flasher-profile.width=1.2", "noise.rate=500"})
    EXPECT_NE(with(setting), same) << setting;
  Model other = model;
  other.acceptance.high_qe = HighQeRatio({{300, 1.3}, {600, 1.4}});
  EXPECT_NE(model_hash(other), same);
  other = model;
  other.acceptance.spectrum = WavelengthSpectrum({{0, 300}, {1, 601}});
  EXPECT_NE(model_hash(other), same);
}

// What a directory's floe.toml says of the ice is told from what its files cannot hold.
TEST(ChangesIce, TellsEffectsOfIceFromOthers) {
  const Model model = load_model({});
  EXPECT_TRUE(changes_ice({parse_effect_setting("absorption-scale.factor=1.1")}, model));
  EXPECT_FALSE(changes_ice({parse_effect_setting("noise.rate=500")}, model));
}

}  // namespace
}  // namespace floe
