// floe effects, and --with wherever a model is named.
#include <gtest/gtest.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "data/event_files.h"
#include "tests/app/floe_runner.h"
#include "tests/app/model_directory.h"
#include "tests/app/wrong_cases.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::json;

Json json_of(const TemporaryFolder& folder, const std::string& arguments) {
  const Outcome outcome = run_floe(folder.path(), arguments + " --quiet --json out.json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  return Json::parse(bytes_of(folder.path() / "out.json"));
}

TEST(EffectsCommand, ListsTheCatalogue) {
  const TemporaryFolder folder;
  const Outcome outcome = run_floe(folder.path(), "effects");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* part : {"birefringence.strength ", "tilt.slope ", "flasher-profile.width ", "m/km",
                           "-300 to 300", "cable-shadow"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
}

TEST(EffectsCommand, SaysMoreOfOne) {
  const TemporaryFolder folder;
  const Outcome outcome = run_floe(folder.path(), "effects birefringence");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.out.starts_with("birefringence\n")) << outcome.out;
  EXPECT_NE(outcome.out.find("source: arXiv:2107.08692"), std::string::npos);
  EXPECT_EQ(outcome.out.find("tilt"), std::string::npos);
}

TEST(EffectsCommand, NullValuesAreTheModels) {
  const TemporaryFolder folder;
  write_model_directory(folder.path() / "my-ice");
  replace_line(folder.path() / "my-ice" / "cfg.txt", 6, "125  # azimuth of the ice flow [deg]");
  const auto null_of = [&](const std::string& arguments) {
    return json_of(folder, arguments)["effects"].at(0)["parameters"].at(0)["null_value"].get<double>();
  };
  EXPECT_EQ(null_of("effects flow-azimuth --ice my-ice"), 125);
  EXPECT_EQ(null_of("effects flow-azimuth"), 130);
  EXPECT_EQ(null_of("effects birefringence"), 1);
  EXPECT_EQ(null_of("effects birefringence --without birefringence"), 0);
  EXPECT_EQ(null_of("effects hole-ice --with hole-ice.radius=0.5"), 0.5);
}

TEST(EffectsCommand, HoldsTheSameInJson) {
  const TemporaryFolder folder;
  const Json json = json_of(folder, "effects");
  EXPECT_EQ(json["model"]["ice"]["name"], "south-pole");
  EXPECT_EQ(json["effects"].size(), 22u);
  const Json& first = json["effects"].at(0);
  EXPECT_EQ(first["name"], "birefringence");
  EXPECT_EQ(first["source"], "arXiv:2107.08692");
  EXPECT_EQ(first["parameters"].at(0)["high"], 10);
}

TEST(With, MayBeRepeatedAndListed) {
  const TemporaryFolder folder;
  const auto hash = [&](const std::string& arguments) {
    return json_of(folder, "info " + arguments)["ice"]["hash"].get<std::string>();
  };
  const std::string listed = hash("--with tilt.slope=10,birefringence.strength=0.5");
  EXPECT_EQ(hash("--with birefringence.strength=0.5 --with tilt.slope=10"), listed);
  EXPECT_EQ(hash("--with=birefringence.strength=0.5 --with=tilt.slope=10"), listed);
  EXPECT_NE(hash("--with tilt.slope=10"), listed);
  EXPECT_EQ(hash("--with birefringence.strength=0"), hash("--without birefringence"));
  EXPECT_EQ(hash("--with birefringence.strength=1"), hash(""));
}

TEST(With, IsKeptInTheEventFile) {
  const TemporaryFolder folder;
  const Outcome outcome = run_floe(folder.path(),
                                   "simulate --flasher 63,20 --photons 1e6 --with tilt.slope=10 --with "
                                   "flasher-brightness.factor=2,time-offset.time=100 -o out.h5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto file = read_event_file(folder.path() / "out.h5");
  const Json configuration = Json::parse(file.provenance->configuration);
  EXPECT_EQ(configuration["model"]["with"],
            (Json{"tilt.slope=10", "flasher-brightness.factor=2", "time-offset.time=100"}));
  EXPECT_EQ(configuration["source"]["flasher"]["photons"], 1e6);  // what was said
}

// Twice as bright is so many photons; later is the same light, later.
TEST(With, ChangesFlashers) {
  const TemporaryFolder folder;
  const std::string twice = "simulate --flasher 63,20 --photons 2e6 -o plain.h5";
  const std::string brighter =
      "simulate --flasher 63,20 --photons 1e6 --with flasher-brightness.factor=2,time-offset.time=64 -o "
      "with.h5";
  ASSERT_EQ(run_floe(folder.path(), twice).code, 0);
  ASSERT_EQ(run_floe(folder.path(), brighter).code, 0);
  const auto plain = read_event_file(folder.path() / "plain.h5").events.at(0).hits;
  const auto with = read_event_file(folder.path() / "with.h5").events.at(0).hits;
  ASSERT_EQ(plain.size(), with.size());
  ASSERT_FALSE(plain.empty());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(plain[i].module, with[i].module);
    EXPECT_NEAR(with[i].time - plain[i].time, 64, 0.01);
  }
}

// 1e5 hits a second in 5 microseconds of all modules but the flasher, beside the same light; once in all
// parts.
TEST(With, AddsNoise) {
  const TemporaryFolder folder;
  const std::string flasher = "simulate --flasher 63,20 --photons 1e6 ";
  ASSERT_EQ(run_floe(folder.path(), flasher + "-o quiet.h5").code, 0);
  ASSERT_EQ(run_floe(folder.path(), flasher + "--with noise.rate=1e5 -o noisy.h5").code, 0);
  for (const std::string part : {"1", "2"})
    ASSERT_EQ(run_floe(folder.path(),
                       flasher + "--with noise.rate=1e5 --shard " + part + "/2 -o part" + part + ".h5")
                  .code,
              0);
  ASSERT_EQ(run_floe(folder.path(), "merge part1.h5 part2.h5 -o parts.h5").code, 0);
  const auto hits = [&](const char* file) { return read_event_file(folder.path() / file).events.at(0).hits; };
  const double expected = 1e5 * 5e-6 * 5159;
  const auto noisy = hits("noisy.h5");
  EXPECT_NEAR(static_cast<double>(noisy.size() - hits("quiet.h5").size()), expected, 4 * std::sqrt(expected));
  EXPECT_EQ(hits("parts.h5").size(), noisy.size());
  EXPECT_TRUE(std::isnan(noisy.back().wavelength));
}

TEST(With, SimulatesTheSameAsWithoutWhereItIsTheSame) {
  const TemporaryFolder folder;
  const std::string cascade = "simulate --cascade 20,-40,-300,70,130,30 ";
  ASSERT_EQ(run_floe(folder.path(), cascade + "--without birefringence -o a.h5").code, 0);
  ASSERT_EQ(run_floe(folder.path(), cascade + "--with birefringence.strength=0 -o b.h5").code, 0);
  const auto a = read_event_file(folder.path() / "a.h5").events.at(0).hits;
  const auto b = read_event_file(folder.path() / "b.h5").events.at(0).hits;
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].time, b[i].time);
}

class WrongWith : public testing::TestWithParam<WrongCase> {};

TEST_P(WrongWith, IsSaidAndLeavesNothing) {
  const TemporaryFolder folder;
  write_readable_event(folder.path() / "event.hits");
  expect_said_and_nothing_left(folder.path(), GetParam());
}

const std::string cascade = "simulate --cascade 20,-40,-300,70,130,1 -o out.h5 ";

const WrongCase cases[] = {
    {"UnknownEffect", cascade + "--with birefringense.strength=2", 2, "did you mean 'birefringence'?"},
    {"UnknownParameter", cascade + "--with birefringence.strenght=2", 2, "did you mean 'strength'?"},
    {"NoParameter", "info --with birefringence=2", 2, "--with: found \"birefringence=2\"; expected EFFECT."},
    {"NoValue", "info --with birefringence.strength", 2, "e.g. birefringence.strength=2"},
    {"NoNumber", "info --with birefringence.strength=two", 2, "found \"two\"; expected a finite number"},
    {"Empty", "info --with tilt.slope=1,", 2, "--with: found \"\""},
    {"OutOfRange", "info --with birefringence.strength=20", 2, "from 0 to 10"},
    {"Twice", "info --with tilt.slope=1,tilt.slope=2", 2, "tilt.slope is set twice"},
    {"UnknownString", "info --with string-efficiency.string=99", 2, "found string 99"},
    {"Unphysical", "info --with birefringence.strength=10", 3, "birefringent share"},
    {"UnknownEffectToList", "effects birefringense", 2, "did you mean 'birefringence'?"},
    {"JsonFolderMissing", "effects --json no/such/out.json", 5, "no/such"},
    {"TwoModelsAndWith", "compare event.hits --ice a --ice b --with tilt.slope=1", 2, "--with makes"},
    {"UnknownEffectToCompare", "compare event.hits --with tild.slope=1", 2, "did you mean 'tilt'?"},
    {"UnknownEffectOfTheOtherFit", "study --group 1,1,20 --fit-with tild.slope=1", 2, "did you mean 'tilt'?"},
    {"NoNumberOfTheOtherFit", "study --group 1,1,20 --fit-with tilt.slope=x", 2, "--fit-with: tilt.slope"},
};

INSTANTIATE_TEST_SUITE_P(CommandLine, WrongWith, testing::ValuesIn(cases), name_of_case);

}  // namespace
}  // namespace floe::test
