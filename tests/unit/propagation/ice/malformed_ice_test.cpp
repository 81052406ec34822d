// Spoiled ice-model directories: each must be refused with the file, the line, what was found and what
// was expected.
#include <gtest/gtest.h>

#include <ostream>
#include <regex>
#include <sstream>

#include "data/base/error.h"
#include "propagation/ice/ice_tables.h"
#include "tests/unit/propagation/ice/ice_directory.h"

namespace floe {
namespace {

using test::IceDirectory;

struct Spoiled {
  std::string name;
  std::string file;                  // to be replaced
  std::string text;                  // its content; "-": the file is removed
  std::vector<std::string> message;  // parts that the error must hold
};

void PrintTo(const Spoiled& spoiled, std::ostream* out) {
  *out << spoiled.name;
}

// `text` with the first match of `what` replaced.
std::string with(const std::string& text, const std::string& what, const std::string& replacement) {
  return std::regex_replace(text, std::regex(what), replacement, std::regex_constants::format_first_only);
}

std::string configuration_line(int number, const std::string& value) {
  std::string result;
  std::istringstream lines(test::configuration_text);
  int counted = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) ++counted;
    result += (counted == number && !line.empty() ? value : line) + "\n";
  }
  return result;
}

std::vector<Spoiled> spoiled_directories() {
  using test::layers_text, test::wavelength_text, test::configuration_text;
  return {
      {"LetterInLayers",
       "icemodel.dat",
       with(layers_text, "0\\.008", "0.0o8"),
       {"icemodel.dat:3", "0.0o8", "dust absorption"}},
      {"NanInLayers",
       "icemodel.dat",
       with(layers_text, "0\\.05 ", "nan "),
       {"icemodel.dat:3", "nan", "scattering"}},
      {"InfinityInLayers",
       "icemodel.dat",
       with(layers_text, "1320 0\\.04", "1320 inf"),
       {"icemodel.dat:4", "inf"}},
      {"OverflowInLayers",
       "icemodel.dat",
       with(layers_text, "1320 0\\.04", "1320 1e999"),
       {"icemodel.dat:4", "1e999"}},
      {"LayersOutOfOrder",
       "icemodel.dat",
       with(layers_text, "1310", "1290"),
       {"icemodel.dat:3", "1290", "rise"}},
      {"LayerTwice", "icemodel.dat", with(layers_text, "1310", "1300"), {"icemodel.dat:3", "1300", "rise"}},
      {"LayersNotUniform",
       "icemodel.dat",
       with(layers_text, "1310", "1310.01"),
       {"icemodel.dat:", "uniform"}},
      {"LayerMissing",
       "icemodel.dat",
       layers_text + "1330 1 1 0 0 0 1 1\n1350 1 1 0 0 0 1 1\n",
       {"icemodel.dat:6", "20 m", "uniform"}},
      {"ColumnMissing",
       "icemodel.dat",
       with(layers_text, " 0\\.9\n", "\n"),
       {"icemodel.dat:3", "7 columns", "8 columns"}},
      {"ThreeColumns", "icemodel.dat", "1300 0.1 0.02\n", {"icemodel.dat:1", "3", "columns"}},
      {"FiveColumns", "icemodel.dat", "1300 0.1 0.02 0 0\n", {"icemodel.dat:1", "5 columns", "k1"}},
      {"NineColumns", "icemodel.dat", "1300 0.1 0.02 0 0 0 1 1 1\n", {"icemodel.dat:1", "9", "columns"}},
      {"NoLayers", "icemodel.dat", "# nothing\n", {"icemodel.dat", "no layers"}},
      {"LayersMissing", "icemodel.dat", "-", {"no icemodel.dat"}},
      {"NegativeAbsorption",
       "icemodel.dat",
       with(layers_text, "0\\.008", "-0.008"),
       {"icemodel.dat:3", "-0.008", "dust absorption"}},
      {"NegativeScattering",
       "icemodel.dat",
       with(layers_text, "0\\.05", "-0.05"),
       {"icemodel.dat:3", "-0.05", "scattering"}},
      {"NegativeStrength",
       "icemodel.dat",
       with(layers_text, " 2 ", " -2 "),
       {"icemodel.dat:3", "-2", "strength"}},
      {"NegativeDepth", "icemodel.dat", "-1300 0.1 0.02 0\n", {"icemodel.dat:1", "-1300", "depth"}},
      {"AbsurdTemperature", "icemodel.dat", "1300 0.1 0.02 -200\n", {"icemodel.dat:1", "-200", "delta-tau"}},
      {"WavelengthMissing", "icemodel.par", "-", {"icemodel.par"}},
      {"WavelengthThreeRows",
       "icemodel.par",
       "0.9 0.1\n1.08 0.1\n6954 1\n",
       {"icemodel.par", "3 rows", "4 rows"}},
      {"WavelengthFiveRows", "icemodel.par", wavelength_text + "1 1\n", {"icemodel.par", "5 rows"}},
      {"WavelengthWithoutUncertainty",
       "icemodel.par",
       with(wavelength_text, " 0\\.03", ""),
       {"icemodel.par:1", "uncertainty"}},
      {"WavelengthNegativeA",
       "icemodel.par",
       with(wavelength_text, "6954", "-6954"),
       {"icemodel.par:3", "-6954"}},
      {"BubblesTwoNumbers", "icemodel.bbl", "11.7 1350\n", {"icemodel.bbl:1", "b, d1, d2"}},
      {"BubblesEmpty", "icemodel.bbl", "", {"icemodel.bbl", "0 rows"}},
      {"BubblesDepthZero", "icemodel.bbl", "11.7 0 1400\n", {"icemodel.bbl:1", "bubbles end"}},
      {"ConfigurationMissing", "cfg.txt", "-", {"cfg.txt"}},
      {"ConfigurationEmpty", "cfg.txt", "\n", {"cfg.txt", "0 numbers"}},
      {"ConfigurationTooShort", "cfg.txt", "5\n1\n0.3\n", {"cfg.txt:3", "3 numbers", "4, 7, 12"}},
      {"ConfigurationSeventeen",
       "cfg.txt",
       with(configuration_text, "544284(.|\n)*", ""),
       {"cfg.txt:18", "17 numbers", "28"}},
      {"ConfigurationTooLong", "cfg.txt", configuration_text + "1\n", {"cfg.txt:30", "29 numbers"}},
      {"ConfigurationTwoInALine",
       "cfg.txt",
       configuration_line(2, "1.015 0.35"),
       {"cfg.txt:2", "one number a line"}},
      {"ConfigurationWord", "cfg.txt", configuration_line(3, "high"), {"cfg.txt:3", "high", "f_SL"}},
      {"OversizeZero", "cfg.txt", configuration_line(1, "0"), {"cfg.txt:1", "0", "oversize"}},
      {"EfficiencyNegative", "cfg.txt", configuration_line(2, "-1"), {"cfg.txt:2", "-1", "efficiency"}},
      {"FractionAboveOne", "cfg.txt", configuration_line(3, "1.2"), {"cfg.txt:3", "1.2", "f_SL"}},
      {"MeanCosineOne", "cfg.txt", configuration_line(4, "1"), {"cfg.txt:4", "g, mean cosine"}},
      {"FlowAzimuthInfinite", "cfg.txt", configuration_line(5, "inf"), {"cfg.txt:6", "inf", "flow"}},
      {"HoleIceRadiusNegative", "cfg.txt", configuration_line(8, "-0.5"), {"cfg.txt:9", "hole ice radius"}},
      {"BirefringenceNan", "cfg.txt", configuration_line(17, "NaN"), {"cfg.txt:18", "NaN", "birefringence"}},
      {"BirefringenceNegativeAngleScale",
       "cfg.txt",
       configuration_line(20, "-0.0026"),
       {"cfg.txt:21", "-0.0026", "D"}},
      {"VersionSeven", "version", "7\n", {"version:1", "7", "0, 10 or 20"}},
      {"VersionFraction", "version", "10.5\n", {"version:1", "10.5"}},
      {"VersionEmpty", "version", "", {"version", "0 rows"}},
      {"TiltParMissing", "tilt.par", "-", {"tilt.dat without tilt.par"}},
      {"TiltDatMissing", "tilt.dat", "-", {"tilt.par without tilt.dat"}},
      {"TiltCountMismatch", "tilt.dat", "1200 1 2\n1210 1 2\n", {"tilt.dat:1", "3 layer shifts", "tilt.par"}},
      {"TiltDepthsFall", "tilt.dat", "1210 1 0 3\n1200 1 0 3\n", {"tilt.dat:2", "1200", "rise"}},
      {"TiltDepthsNotUniform", "tilt.dat", "1200 1 0 3\n1210 1 0 3\n1225 1 0 3\n", {"tilt.dat:", "uniform"}},
      {"TiltOneDepth", "tilt.dat", "1200 1 0 3\n", {"tilt.dat", "1 row;", "2 depths"}},
      {"TiltDistancesFall", "tilt.par", "86 0\n50 -500\n14 480\n", {"tilt.par:2", "-500", "rise"}},
      {"TiltWithoutOrigin", "tilt.par", "50 -500\n86 1\n14 480\n", {"tilt.par", "no distance 0"}},
      {"TiltStringFraction", "tilt.par", "50.5 -500\n86 0\n14 480\n", {"tilt.par:1", "50.5"}},
      {"TiltSetOneAxis", "tilt.set", "9.3 -100 100 3 2\n", {"tilt.set", "1 row;"}},
      {"TiltSetBadCut", "tilt.set", "9.3 -100 100 3 0\n129.3 -110 105 3 2\n", {"tilt.set:1", "0", "cut"}},
      {"TiltSetNoCell", "tilt.set", "9.3 -100 100 3 1\n129.3 -110 105 3 1\n", {"tilt.set:2", "cell"}},
      {"TiltSetBadStep",
       "tilt.set",
       "9.3 -100 100 3 2\n129.3 -110 -105 3 2\n",
       {"tilt.set:2", "-105", "step"}},
      {"TiltSetBadCount",
       "tilt.set",
       "9.3 -100 100 1 2\n129.3 -110 105 3 2\n",
       {"tilt.set:1", "1", "number of points"}},
      {"TiltMapCountMismatch",
       "tilt.map",
       "1200 1 2 3 4 5 6\n1210 1 2 3 4 5 6\n",
       {"tilt.map:1", "7 layer shifts", "tilt.set"}},
      {"TiltMapNotANumber", "tilt.map", with(test::tilt_map_text, "14", "1-4"), {"tilt.map:2", "1-4"}},
      {"TiltMapMissing", "tilt.map", "-", {"tilt.set without tilt.map"}},
  };
}

class MalformedIce : public testing::TestWithParam<Spoiled> {};

TEST_P(MalformedIce, IsRefusedInWords) {
  const Spoiled& spoiled = GetParam();
  const IceDirectory directory;
  ASSERT_NO_THROW(read_ice_tables(directory.path()));
  if (spoiled.text == "-")
    directory.remove(spoiled.file);
  else
    directory.write(spoiled.file, spoiled.text);
  try {
    read_ice_tables(directory.path());
    FAIL() << "read without complaint";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(directory.path().string()), std::string::npos) << message;
    EXPECT_NE(message.find("expected"), std::string::npos) << message;
    for (const auto& part : spoiled.message)
      EXPECT_NE(message.find(part), std::string::npos) << part << "\n" << message;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, MalformedIce, testing::ValuesIn(spoiled_directories()),
                         [](const auto& test_case) { return test_case.param.name; });

TEST(MalformedIce, NoSuchDirectory) {
  try {
    read_ice_tables("/nonexistent/ice");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no such directory"), std::string::npos) << error.what();
  }
}

TEST(MalformedIce, FileInsteadOfDirectory) {
  const IceDirectory directory;
  EXPECT_THROW(read_ice_tables(directory.path() / "icemodel.dat"), InputError);
}

}  // namespace
}  // namespace floe
