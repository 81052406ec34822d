// What a fit may use of an event, and what it knows of the modules: the options --bad, --leave-out,
// --noise-rate, --noise and --charge-cap do what they say, and wrong values leave nothing behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "data/event_files.h"
#include "tests/app/floe_runner.h"
#include "tests/app/small_detector.h"
#include "tests/app/wrong_cases.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::json;

std::string name_of(ModuleId id) {
  return std::to_string(id.string) + "," + std::to_string(id.dom);
}

// One event in a small detector. A fit of it takes a second, and is a function of what it is given:
// equal selections have equal results.
class DataSelectionOptions : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    write_small_detector(folder_->path() / "geo", 40);
    const Outcome outcome = run_floe(folder_->path(),
                                     "simulate --cascade 3,-3,-303,70,130,300 --detector geo --oversize 20 "
                                     "--quiet -o event.h5");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const Hit& hit : read_event_file(folder_->path() / "event.h5").events.at(0).hits)
      charges_[hit.module] += double(hit.charge);
    plain_ = fit("");
    ASSERT_EQ(plain_["status"], "ok");
  }
  static void TearDownTestSuite() { delete folder_; }

  static Outcome run(const std::string& options) {
    return run_floe(
        folder_->path(),
        "reconstruct event.h5 --detector geo --oversize 20 --effort 0.05 --quiet --json fit.json " + options);
  }
  // The fit in the JSON file, which is removed; without the time that it took.
  static Json fit_in_file() {
    const std::filesystem::path file = folder_->path() / "fit.json";
    Json fit = Json::parse(bytes_of(file))["events"].at(0)["fit"];
    std::filesystem::remove(file);
    fit.erase("seconds");
    return fit;
  }
  static Json fit(const std::string& options) {
    const Outcome outcome = run(options);
    EXPECT_TRUE(outcome.code == 0 || outcome.code == 4) << options << "\n" << outcome.err;
    return fit_in_file();
  }
  static void expect_too_little_light(const std::string& options) {
    expect_error(run(options), 4, "not enough light");
    EXPECT_EQ(fit_in_file()["status"], "not_enough_light") << options;
  }
  static void write(const std::string& file, const std::string& text) {
    write_bytes(folder_->path() / file, text);
  }
  static ModuleId brightest() {
    return std::max_element(charges_.begin(), charges_.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
  }

  // Of all modules of the detector: "STRING DOM`rest`" a line.
  static std::string lines_of_all_modules(const std::string& rest) {
    std::ostringstream lines;
    for (int string = 1; string <= 7; ++string)
      for (int dom = 1; dom <= 9; ++dom) lines << string << " " << dom << rest << "\n";
    return lines.str();
  }

  inline static TemporaryFolder* folder_ = nullptr;
  inline static std::map<ModuleId, double> charges_;
  inline static Json plain_;
};

TEST_F(DataSelectionOptions, BadModulesAreLeftOutHoweverTheyAreNamed) {
  const std::string bright = name_of(brightest());
  const Json one = fit("--bad " + bright);
  EXPECT_NE(one["x"], plain_["x"]);
  const std::string others = bright == "1,1" ? "2,2;3,3" : "1,1;3,3";
  const Json three = fit("--bad '" + bright + ";" + others + "'");
  EXPECT_NE(three["x"], one["x"]);
  EXPECT_EQ(fit("--bad " + bright + " --bad '" + others + "'"), three);
  std::string lines = "# out of order since 2011\n" + bright + "\n" + others + "\n";
  std::replace(lines.begin(), lines.end(), ',', ' ');
  std::replace(lines.begin(), lines.end(), ';', '\n');
  write("bad.txt", lines);
  EXPECT_EQ(fit("--bad bad.txt"), three);
  // Bins follow the light that was fitted, so that a single module may make no difference; two strings do.
  std::string strings = "6,1;7,1";
  for (int dom = 2; dom <= 9; ++dom) strings += ";6," + std::to_string(dom) + ";7," + std::to_string(dom);
  EXPECT_LT(fit("--bad '" + strings + "'")["bins"], plain_["bins"]);
}

TEST_F(DataSelectionOptions, WithoutAnyModuleThereIsTooLittleLight) {
  write("all.txt", lines_of_all_modules(""));
  expect_too_little_light("--bad all.txt");
}

TEST_F(DataSelectionOptions, TimesAreLeftOutOfOneModuleOrOfAll) {
  const std::string all_times = "-1e9,1e9";
  const Json one = fit("--leave-out " + name_of(brightest()) + ":" + all_times);
  EXPECT_NE(one["x"], plain_["x"]);
  expect_too_little_light("--leave-out " + all_times);
  // Two windows that meet are one.
  expect_too_little_light("--leave-out=-1e9,200 --leave-out 200,1e9");
  // Long before the event no light is left out, but every module has bins before, in and after the window.
  EXPECT_GT(fit("--leave-out -1e6,-9e5")["bins"], plain_["bins"]);
}

TEST_F(DataSelectionOptions, NoiseOfEveryModuleIsThatOfAllSingleOnes) {
  const Json noisy = fit("--noise-rate 1e5");
  EXPECT_NE(noisy["neg_llh"], plain_["neg_llh"]);
  write("noise.txt", "# string DOM 1/s\n" + lines_of_all_modules(" 1e5"));
  EXPECT_EQ(fit("--noise noise.txt"), noisy);
  // The file's rates replace the common one.
  EXPECT_EQ(fit("--noise-rate 5 --noise noise.txt"), noisy);
  EXPECT_EQ(fit("--noise-rate 0"), plain_);
}

TEST_F(DataSelectionOptions, ChargeAboveTheCapIsNotUsed) {
  const double most = charges_.at(brightest());
  EXPECT_EQ(fit("--charge-cap " + std::to_string(most + 1)), plain_);
  const Json capped = fit("--charge-cap " + std::to_string(most));
  EXPECT_LT(capped["bins"], plain_["bins"]);  // its times are not used either
  EXPECT_NE(capped["x"], plain_["x"]);
}

class WrongDataSelection : public testing::TestWithParam<WrongCase> {};

TEST_P(WrongDataSelection, IsSaidAndLeavesNothing) {
  const TemporaryFolder folder;
  write_readable_event(folder.path() / "event.hits");
  write_bytes(folder.path() / "words.txt", "20 30\n20 thirty\n");
  write_bytes(folder.path() / "unknown.txt", "20 30\n20 61\n");
  write_bytes(folder.path() / "long.txt", "# string DOM\n20 30 40\n");
  write_bytes(folder.path() / "short.txt", "20 30 500\n20 31\n");
  write_bytes(folder.path() / "loud.txt", "20 30 500\n\n20 31 loud\n");
  write_bytes(folder.path() / "negative.txt", "20 30 500\n20 31 -5\n");
  write_bytes(folder.path() / "endless.txt", "20 30 1e7\n");
  expect_said_and_nothing_left(folder.path(), GetParam());
}

const WrongCase cases[] = {
    {"BadOfOneNumber", "--bad 20", 2, "--bad: found \"20\"; expected STRING,DOM"},
    {"BadOfThreeNumbers", "--bad 20,30,1", 2, "--bad: found \"20,30,1\""},
    {"BadEndsInSemicolon", "--bad '20,30;'", 2, "--bad: found \"\""},
    {"BadBeyondNumbers", "--bad 20,300000", 2, "--bad: found \"300000\""},
    {"BadOfUnknownModule", "--bad 20,61", 3, "unknown module 20,61"},
    {"BadFileMissing", "--bad none.txt", 3, "none.txt: found no file"},
    {"BadFileWithWords", "--bad words.txt", 3, "words.txt:2: found 'thirty'"},
    {"BadFileOfThreeFields", "--bad long.txt", 3, "long.txt:2: found 3 fields"},
    {"BadFileWithUnknownModule", "--bad unknown.txt", 3, "unknown module 20,61"},
    {"WindowOfOneNumber", "--leave-out 5", 2, "--leave-out: found \"5\"; expected BEGIN,END"},
    {"WindowOfThreeNumbers", "--leave-out 1,2,3", 2, "--leave-out: found \"1,2,3\""},
    {"WindowBackwards", "--leave-out 5,4", 2, "--leave-out: found \"4\"; expected a finite number above 5"},
    {"WindowOfNoLength", "--leave-out 5,5", 2, "--leave-out: found \"5\""},
    {"WindowInWords", "--leave-out 5,x", 2, "--leave-out: found \"x\""},
    {"WindowWithoutEnd", "--leave-out 20,30:5,inf", 2, "--leave-out: found \"inf\""},
    {"WindowOfAString", "--leave-out 20:5,6", 2, "--leave-out: found \"20\"; expected STRING,DOM"},
    {"WindowWithoutTimes", "--leave-out 20,30:", 2, "--leave-out: found \"20,30:\""},
    {"EmptyWindow", "--leave-out ''", 2, "--leave-out: found \"\""},
    {"SecondWindowIsWrong", "--leave-out 5,6 --leave-out 7", 2, "--leave-out: found \"7\""},
    {"NegativeNoise", "--noise-rate -1", 2, "--noise-rate: found \"-1\""},
    {"NoiseOfTenMegahertz", "--noise-rate 1e7", 2, "--noise-rate: found \"1e7\""},
    {"NoiseInWords", "--noise-rate loud", 2, "--noise-rate: found \"loud\""},
    {"NoiseFileMissing", "--noise none.txt", 3, "none.txt: found no file"},
    {"NoiseFileOfTwoFields", "--noise short.txt", 3, "short.txt:2: found 2 fields in '20 31'; expected 3"},
    {"NoiseFileWithWords", "--noise loud.txt", 3, "loud.txt:3: found 'loud'; expected a number"},
    {"NoiseFileWithNegativeRate", "--noise negative.txt", 3, "negative.txt:2: found -5 for noise rate"},
    {"NoiseFileWithTenMegahertz", "--noise endless.txt", 3, "endless.txt:1: found 1"},
    {"NoCap", "--charge-cap 0", 2, "--charge-cap: found \"0\""},
    {"NegativeCap", "--charge-cap -3", 2, "--charge-cap: found \"-3\""},
    {"CapOfNan", "--charge-cap nan", 2, "--charge-cap: found \"nan\""},
    {"CapInWords", "--charge-cap many", 2, "--charge-cap: found \"many\""},
};

INSTANTIATE_TEST_SUITE_P(CommandLine, WrongDataSelection,
                         testing::ValuesIn(cases_of("reconstruct event.hits --json fit.json ", cases)),
                         name_of_case);

}  // namespace
}  // namespace floe::test
