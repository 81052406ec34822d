// The catalogue as a whole, and how its settings are read.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "tests/unit/propagation/effects/changed_parts.h"

namespace floe::test {
namespace {

std::vector<std::pair<std::string, ModelParts>> models() {
  std::vector<std::pair<std::string, ModelParts>> result{{"built in", built_in_parts()},
                                                         {"directory", small_parts()}};
  ModelParts lines = small_parts();
  lines.ice.tilt_map.reset();
  result.emplace_back("1D tilt", lines);
  ModelParts plain = small_parts();
  for (const char* effect : {"birefringence", "absorption-anisotropy", "scattering-anisotropy", "tilt"})
    switch_off(plain.ice, effect);
  plain.ice.configuration.old_absorption_scaling = 1;
  plain.acceptance.angular = AngularAcceptance::surface(0.2);
  result.emplace_back("without effects", plain);
  ModelParts old = small_parts();
  old.ice.wavelength.D = 400, old.ice.wavelength.E = 0.1;
  result.emplace_back("before 2013", old);
  ModelParts whole = small_parts();
  whole.ice.version = 20;
  result.emplace_back("version 20", whole);
  return result;
}

std::vector<double> null_values(const Effect& effect, const ModelParts& model) {
  std::vector<double> values;
  for (const EffectParameter& parameter : effect.parameters(model)) values.push_back(parameter.null_value);
  return values;
}

TEST(Effects, HaveNamesOfTheirOwnAndSayWhatTheyAre) {
  std::set<std::string> names;
  for (const Effect* effect : effects()) {
    EXPECT_TRUE(names.insert(effect->name()).second) << effect->name();
    EXPECT_EQ(&find_effect(effect->name()), effect);
    EXPECT_EQ(effect->name().find_first_of(".=, "), std::string::npos);
    EXPECT_NE(effect->description(), "");
    EXPECT_NE(effect->source().find("arXiv:"), std::string::npos) << effect->name();
    for (const auto& [title, model] : models())
      for (const EffectParameter& parameter : effect->parameters(model)) {
        SCOPED_TRACE(title + ": " + effect->name() + "." + parameter.name);
        EXPECT_EQ(parameter.name.find_first_of(".=, "), std::string::npos);
        EXPECT_NE(parameter.description, "");
        EXPECT_LE(parameter.low, parameter.null_value);
        EXPECT_LE(parameter.null_value, parameter.high);
      }
  }
  EXPECT_EQ(names.size(), 22u);
}

TEST(Effects, ChangeNothingAtTheirNullValues) {
  for (const auto& [title, model] : models())
    for (const Effect* effect : effects()) {
      SCOPED_TRACE(title + ": " + effect->name());
      ModelParts same = model;
      effect->apply(null_values(*effect, model), same);
      expect_equal(same, model);
      for (const EffectParameter& parameter : effect->parameters(model)) {
        same = model;
        apply_effects(std::vector<EffectSetting>{{effect->name(), parameter.name, parameter.null_value}},
                      same);
        expect_equal(same, model);
      }
    }
}

TEST(Effects, OtherParametersKeepTheirNullValues) {
  const ModelParts model = small_parts();
  const auto& c = changed(model, {"scattering-function.g=0.95"}).ice.configuration;
  EXPECT_EQ(c.mean_cosine, 0.95);
  EXPECT_EQ(c.simplified_liu_fraction, model.ice.configuration.simplified_liu_fraction);
}

TEST(Effects, ComeInOneGoAndInAnyOrder) {
  const std::vector<std::string> forward{"absorption-layer.depth=1310", "tilt.slope=5",
                                         "absorption-layer.width=4", "absorption-layer.factor=3",
                                         "absorption-scale.factor=0.7"};
  const std::vector<std::string> backward(forward.rbegin(), forward.rend());
  expect_equal(changed(small_parts(), forward), changed(small_parts(), backward));
}

TEST(EffectSettings, AreReadAndWritten) {
  const EffectSetting setting = parse_effect_setting("birefringence.strength=2.5e-1");
  EXPECT_EQ(setting, (EffectSetting{"birefringence", "strength", 0.25}));
  EXPECT_EQ(text_of(setting), "birefringence.strength=0.25");
  EXPECT_EQ(parse_effect_setting(text_of({"tilt", "slope", -1.0 / 3})).value, -1.0 / 3);
  for (const char* text :
       {"", "birefringence", "birefringence=2", "birefringence.strength", ".strength=2", "birefringence.=2",
        "birefringence.strength=", "birefringence.strength=two", "birefringence.strength=2x",
        "birefringence.strength=nan", "birefringence.strength=inf", "birefringence.strength=1e999"})
    EXPECT_THROW(parse_effect_setting(text), UsageError) << text;
}

TEST(EffectSettings, ThatAreWrongAreRefusedWithWhatIsKnown) {
  const ModelParts model = small_parts();
  expect_refused(model, {"birefringense.strength=2"}, "did you mean 'birefringence'? Known: birefringence, ");
  expect_refused(model, {"tilt.slop=2"}, "effect 'tilt' has no parameter 'slop'; did you mean 'slope'?");
  expect_refused(model, {"birefringence.strength=11"}, "found 11; expected a number from 0 to 10");
  expect_refused(model, {"tilt.slope=-301"}, "a number from -300 to 300 m/km");
  expect_refused(model, {"string-efficiency.string=1.5"}, "expected a whole number");
  expect_refused(model, {"tilt.slope=1", "tilt.slope=2"}, "tilt.slope is set twice");
}

TEST(EffectSettings, ThatAreWrongChangeNothing) {
  const ModelParts model = small_parts();
  ModelParts same = model;
  const std::vector<EffectSetting> settings{{"tilt", "slope", 10}, {"gravity", "g", 9.8}};
  EXPECT_THROW(apply_effects(settings, same), UsageError);
  expect_equal(same, model);
}

TEST(LoadModel, AppliesEffectsAfterSwitches) {
  ModelRequest request;
  request.with = {parse_effect_setting("absorption-anisotropy.k1=0.3")};
  EXPECT_EQ(load_model(request).ice->tables().configuration.absorption_anisotropy->k1, 0.3);
  request.without = {"absorption-anisotropy"};
  EXPECT_EQ(load_model(request).ice->tables().configuration.absorption_anisotropy->k1, 0.3);
  EXPECT_EQ(load_model(request).ice->name(), "south-pole");
}

TEST(LoadModel, UnknownEffectOfWithIsSaidBeforeMissingFiles) {
  ModelRequest request;
  request.ice = "/nonexistent";
  request.with = {{"gravity", "g", 9.8}};
  EXPECT_THROW(load_model(request), UsageError);
}

TEST(Model, IsTheSameAfterItsPartsWereFrozenAgain) {
  ModelRequest request;
  request.with = {parse_effect_setting("time-offset.time=20"), parse_effect_setting("tilt.slope=3")};
  const Model model = load_model(request), again = freeze(parts_of(model));
  EXPECT_EQ(again.ice->hash(), model.ice->hash());
  EXPECT_EQ(again.detector->hash(), model.detector->hash());
  EXPECT_EQ(again.sources, model.sources);
  EXPECT_EQ(again.sources.time_offset, 20);
  expect_equal(again.acceptance, model.acceptance);
}

}  // namespace
}  // namespace floe::test
