// floe study on one or two cheap events: what it prints, writes and keeps, and what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/app/floe_runner.h"
#include "tests/app/small_detector.h"
#include "tests/app/wrong_cases.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::json;

class Study : public testing::Test {
 protected:
  Study() { write_small_detector(folder_.path() / "geo", 70); }
  // --effort 0.02 unless the arguments say otherwise.
  Outcome study(const std::string& arguments) const {
    const std::string effort = arguments.find("--effort") == std::string::npos ? "--effort 0.02 " : "";
    return run_floe(folder_.path(), "study --detector geo " + effort + arguments);
  }
  std::string text_of(const std::string& file) const { return bytes_of(folder_.path() / file); }

  TemporaryFolder folder_;
};

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

// One root, every element closed, no bare "&" and no number that is none.
void expect_picture(const std::string& svg) {
  EXPECT_TRUE(svg.starts_with("<svg ")) << svg.substr(0, 80);
  std::vector<std::string> open;
  std::size_t roots = 0;
  for (auto begin = svg.find('<'); begin != std::string::npos; begin = svg.find('<', begin + 1)) {
    const auto end = svg.find('>', begin);
    ASSERT_NE(end, std::string::npos);
    const std::string tag = svg.substr(begin + 1, end - begin - 1);
    const auto name_length = tag.find_first_of(" /", 1);
    if (tag.starts_with('/')) {
      ASSERT_FALSE(open.empty()) << tag;
      EXPECT_EQ(tag.substr(1), open.back());
      open.pop_back();
    } else {
      roots += open.empty();
      if (!tag.ends_with('/')) open.push_back(tag.substr(0, name_length));
    }
    EXPECT_EQ(count(tag, "\"") % 2, 0u) << tag;
    EXPECT_EQ(count(tag, "nan") + count(tag, "inf"), 0u) << tag;
  }
  EXPECT_TRUE(open.empty()) << open.back();
  EXPECT_EQ(roots, 1u);
  for (auto at = svg.find('&'); at != std::string::npos; at = svg.find('&', at + 1))
    EXPECT_LE(svg.find(';', at), at + 7) << svg.substr(at, 20);
}

// A group of 1 GeV has no light for fits: it costs nothing, and is said not to be fitted.
TEST_F(Study, PrintsTablesAndWritesJsonAndPicture) {
  const Outcome outcome =
      study("--group 1000,1,20 --group 1,1,20 --effort 0.1 --json study.json --picture study.svg");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(count(outcome.out, "not fitted: 1 GeV event 0: not_enough_light"), 2u) << outcome.out;

  const Json json = Json::parse(text_of("study.json"));
  EXPECT_EQ(json["model"]["ice"]["name"], "south-pole");
  EXPECT_EQ(json["model"]["detector"]["name"], "geo");
  EXPECT_EQ(json["seed"], 1);
  const std::vector<std::string> titles{"1000 GeV, oversize 20", "1 GeV, oversize 20", "all energies"};
  const std::vector<std::string> names{"x",       "y",      "z",        "time",      "zenith",
                                       "azimuth", "energy", "position", "direction", "pooled"};
  const int fitted = json["tables"].at(0)["fitted"];  // 1, unless fits of so little effort miss it
  ASSERT_EQ(json["tables"].size(), titles.size());
  for (std::size_t t = 0; t < titles.size(); ++t) {
    const Json& table = json["tables"][t];
    const int events = t == 2 ? 2 : 1, with_fit = t == 1 ? 0 : fitted;
    EXPECT_EQ(table["title"], titles[t]);
    EXPECT_EQ(table["events"], events);
    EXPECT_EQ(table["fitted"], with_fit);
    EXPECT_EQ(table["failures"].size(), static_cast<std::size_t>(events - with_fit));
    const std::string printed =
        titles[t] + ": " + std::to_string(with_fit) + " of " + std::to_string(events) + " events fitted\n";
    EXPECT_NE(outcome.out.find(printed), std::string::npos) << printed << " in:\n" << outcome.out;
    ASSERT_EQ(table["lines"].size(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Json& line = table["lines"][i];
      EXPECT_EQ(line["name"], names[i]);
      EXPECT_EQ(line["count"], names[i] == "pooled" ? 7 * with_fit : with_fit) << names[i];
      for (const char* key : {"unit", "bias", "bias_error", "median_error", "median_bound", "median_scatter",
                              "pull_mean", "pull_width", "pull_width_error", "coverage", "coverage_error"})
        EXPECT_TRUE(line.contains(key)) << names[i] << " " << key;
    }
  }
  for (const std::string& name : names) EXPECT_EQ(count(outcome.out, "\n  " + name + " "), 3u) << name;
  expect_picture(text_of("study.svg"));
}

TEST_F(Study, FitsWithAnotherModelAsWell) {
  const Outcome outcome = study("--group 300,1,20 --fit-without birefringence --rows rows");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Fitted with the other model:"), std::string::npos) << outcome.out;
  std::istringstream lines(text_of("rows"));
  std::string heading, row;
  std::getline(lines, heading);
  std::getline(lines, row);
  EXPECT_NE(Json::parse(heading)["fit_model"], Json::parse(heading)["model"]);
  for (const char* key : {"other", "delta_neg_llh", "delta_neg_llh_error"})
    EXPECT_TRUE(Json::parse(row).contains(key)) << key;
}

// Charges of pulses are no whole numbers; the bound is that of the same photons.
TEST_F(Study, FitsPulses) {
  const auto row_of = [&](const std::string& arguments, const std::string& rows) {
    const Outcome outcome = study("--group 300,1,20 --quiet --rows " + rows + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::istringstream lines(text_of(rows));
    std::string heading, row;
    std::getline(lines, heading), std::getline(lines, row);
    return Json::parse(row);
  };
  const Json photons = row_of("", "photons"), pulses = row_of(" --pulses", "pulses");
  EXPECT_EQ(std::fmod(photons["charge"].get<double>(), 1), 0);
  EXPECT_NE(std::fmod(pulses["charge"].get<double>(), 1), 0);
  EXPECT_EQ(pulses["truth"], photons["truth"]);
  EXPECT_EQ(pulses["bound"], photons["bound"]);
  EXPECT_NE(pulses["fit"]["cascade"], photons["fit"]["cascade"]);
}

TEST_F(Study, WithMoreEventsOnlyAddsToItsRows) {
  ASSERT_EQ(study("--group 300,1,20 --rows rows --quiet").code, 0);
  const std::string first = text_of("rows");
  EXPECT_EQ(count(first, "\n"), 2u);  // heading, event
  const Outcome more = study("--group 300,2,20 --rows rows");
  ASSERT_EQ(more.code, 0) << more.err;
  const std::string second = text_of("rows");
  EXPECT_TRUE(second.starts_with(first));  // with its seconds: the event was not fitted again
  EXPECT_EQ(count(second, "\n"), 3u);
  EXPECT_NE(more.out.find(" of 2 events fitted"), std::string::npos) << more.out;
  // Fewer take from the rows those that they need, and the same adds nothing.
  const Outcome fewer = study("--group 300,1,20 --rows rows");
  EXPECT_NE(fewer.out.find(" of 1 events fitted"), std::string::npos) << fewer.out;
  EXPECT_EQ(study("--group 300,2,20 --rows rows").out, more.out);
  EXPECT_EQ(text_of("rows"), second);
}

TEST_F(Study, DoesNotMixRowsOfOtherSettings) {
  const std::string group = "--rows rows --group 1,1,20 ";
  ASSERT_EQ(study(group + "--quiet").code, 0);
  const std::string rows = text_of("rows");
  const auto before = files_in(folder_.path());
  expect_error(study(group + "--seed 2 --json x.json"), 2, "rows: found rows of a run with seed 1, not 2");
  expect_error(study(group + "--effort 0.1 --json x.json"), 2, "with effort 0.02, not 0.1");
  expect_error(study(group + "--without birefringence -o x.svg"), 2, "with model ");
  expect_error(study(group + "--fit-without birefringence -o x.svg"), 2, "with fit_model null, not ");
  expect_error(study("--rows rows --group 1,1,10 -o x.svg"), 2, "with oversize.1 20.0, not 10.0");
  expect_error(study(group + "--pulses -o x.svg"), 2, "with no response");
  EXPECT_EQ(text_of("rows"), rows);
  EXPECT_EQ(files_in(folder_.path()), before);
}

// Outputs are looked at after all options and before the first event.
TEST_F(Study, ExamplesOfItsHelpAreUnderstood) {
  std::istringstream help(run_floe(folder_.path(), "study --help").out);
  const auto before = files_in(folder_.path());
  int examples = 0;
  for (std::string line; std::getline(help, line);) {
    if (!line.starts_with("  floe ")) continue;
    ++examples;
    expect_error(run_floe(folder_.path(), line.substr(7) + " --json no/such/x.json"), 5, "no/such");
  }
  EXPECT_GE(examples, 3);
  EXPECT_EQ(files_in(folder_.path()), before);
}

class WrongStudy : public testing::TestWithParam<WrongCase> {};

TEST_P(WrongStudy, IsSaidAndLeavesNothing) {
  const TemporaryFolder folder;
  expect_said_and_nothing_left(folder.path(), GetParam());
}

const std::string group = "--group 300,1,20 ";

const WrongCase cases[] = {
    {"GroupOfTwoNumbers", "--group 300,1", 2, "--group: found \"300,1\""},
    {"GroupOfFourNumbers", "--group 300,1,20,5", 2, "--group: found \"300,1,20,5\""},
    {"EmptyGroup", "--group ''", 2, "--group: found \"\""},
    {"GroupWithoutValue", "--group", 2, "--group"},
    {"NegativeEnergy", "--group=-300,1,20", 2, "--group: found \"-300\""},
    {"EnergyBelowOne", "--group 0.5,1,20", 2, "--group: found \"0.5\""},
    {"EnergyOfNan", "--group nan,1,20", 2, "--group: found \"nan\""},
    {"EnergyWithUnit", "--group 300GeV,1,20", 2, "--group: found \"300GeV\""},
    {"NegativeEvents", "--group 300,-1,20", 2, "--group: found \"-1\""},
    {"HalfAnEvent", "--group 300,1.5,20", 2, "--group: found \"1.5\""},
    {"EventsInWords", "--group 300,one,20", 2, "--group: found \"one\""},
    {"OversizeBelowOne", "--group 300,1,0.5", 2, "--group: found \"0.5\""},
    {"NegativeOversize", "--group 300,1,-20", 2, "--group: found \"-20\""},
    {"SecondGroupIsWrong", group + "--group 1000,1", 2, "--group: found \"1000,1\""},
    {"SameEnergyTwice", group + "--group 3e2,1,10", 2, "--group: 300 GeV is given twice"},
    {"NoEffort", group + "--effort 0", 2, "--effort: found \"0\""},
    {"UnknownEffectOfTheOtherFit", group + "--fit-without birefringense", 2, "did you mean 'birefringence'?"},
    {"ElectronicsMissing", group + "--response no/such.toml", 3, "no/such.toml"},
    {"PictureOfAnotherKind", group + "--picture study.png", 2, "--picture: found \"study.png\""},
    {"JsonFolderMissing", group + "--json no/such/study.json", 5, "no/such"},
    {"PictureFolderMissing", group + "--picture no/such/study.svg", 5, "no/such"},
    {"RowsFolderMissing", group + "--rows no/such/rows.jsonl", 5, "no/such"},
    {"RowsAreAFolder", group + "--rows .", 5, ".: could not be opened"},
};

INSTANTIATE_TEST_SUITE_P(CommandLine, WrongStudy, testing::ValuesIn(cases_of("study ", cases)), name_of_case);

}  // namespace
}  // namespace floe::test
