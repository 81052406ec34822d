// A diagnosis in words and as a page.
#include "reco/diagnose/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reco/diagnose/residual_pictures.h"

namespace floe::test {
namespace {

class Report : public ::testing::Test {
 protected:
  Report() {
    diagnosis_.steps.emplace_back();
    DiagnosisStep& step = diagnosis_.steps.front();
    for (const char* axis : {"azimuth", "depth", "distance", "arrival angle", "time", "string", "module"}) {
      ResidualProfile profile;
      profile.axis = axis;
      profile.low = {0, 1}, profile.high = {1, 2};
      if (profile.axis == "module") profile.names = {"36,1", "36,2"};
      profile.relative = {0.1, -0.02}, profile.error = {0.02, 0.02};
      step.where.profiles.push_back(profile);
    }
    diagnosis_.gaps = {{"36,20", 200, 10}};
    diagnosis_.gap_before = 200, diagnosis_.gap_after = 10, diagnosis_.gap_scatter = 20;
    diagnosis_.folds = 2;
    diagnosis_.p_value = 1e-20;
  }
  void find_anisotropy() {
    NamedEffect effect;
    effect.suspect.effect = "absorption-anisotropy";
    effect.parameters = {effect_parameter("absorption-anisotropy.k1", model_)};
    effect.values = {0.597}, effect.errors = {0.029};
    effect.significance = 14;
    effect.group = {"absorption-anisotropy"};
    diagnosis_.effects = {effect};
    diagnosis_.verdict = {"absorption-anisotropy"};
    Trial trial;
    trial.suspect = effect.suspect;
    trial.parameters = effect.parameters;
    trial.values = effect.values, trial.errors = effect.errors;
    diagnosis_.steps.front().trials = {trial};
  }
  std::string sentence() const { return verdict_sentence(diagnosis_, 0.01); }
  std::string page() const {
    ReportFacts facts;
    facts.data = "runs <of> today.h5", facts.ice = "ice & more";
    facts.command = "floe diagnose 'runs <of> today.h5'";
    return report_html(diagnosis_, {}, facts);
  }

  const Model model_ = load_model({});
  Diagnosis diagnosis_;
};

TEST_F(Report, SaysThatNothingIsMissing) {
  diagnosis_.p_value = 0.19;
  EXPECT_EQ(sentence(), "Nothing is missing: the data agree with the model (p = 0.1900, alpha = 0.01).");
}

TEST_F(Report, SaysWhatIsMissingAndHowMuchOfTheGapCloses) {
  find_anisotropy();
  EXPECT_EQ(
      sentence(),
      "Missing: absorption-anisotropy (p = 1.0e-20 for the base model); 95% of the gap in held-out runs "
      "closes.");
  diagnosis_.effects[0].group.push_back("scattering-anisotropy");
  EXPECT_NE(sentence().find("absorption-anisotropy (or scattering-anisotropy: these data cannot tell)"),
            std::string::npos);
  diagnosis_.why_unexplained = {"something remains that no effect of the catalogue explains"};
  EXPECT_NE(sentence().find("; something remains that no effect of the catalogue explains"),
            std::string::npos);
}

TEST_F(Report, DrawsModulesOfBothLooksInTheSameColumns) {
  ResidualProfile before, after;
  before.names = {"36,1", "45,2"}, before.relative = {0.08, 0}, before.error = {0.02, 0.02};
  after.names = {"38,1", "45,2"}, after.relative = {-0.2, 0}, after.error = {0.02, 0.02};
  const std::string picture = module_picture(before, &after, "before");
  const std::string other = module_picture(after, &before, "after");
  EXPECT_NE(picture.find("#c80000"), std::string::npos) << "4 deviations above are full red";
  EXPECT_NE(other.find("#0000c8"), std::string::npos) << "10 deviations below are full blue";
  EXPECT_NE(picture.find("#e1e1e1"), std::string::npos) << "what agrees is grey";
  const auto labels = [](const std::string& svg) {
    std::string found;
    for (const char* name : {">36<", ">38<", ">45<"})
      if (svg.find(name) != std::string::npos) found += name;
    return found;
  };
  EXPECT_EQ(labels(picture), labels(other)) << "strings that only the other look has keep their columns";
}

// A gap below none is a fit that is better than an average one, not more than all of it.
TEST_F(Report, ClosesNoMoreThanAllOfAGap) {
  find_anisotropy();
  diagnosis_.gap_after = -22;
  EXPECT_NE(sentence().find("; all of the gap in held-out runs closes."), std::string::npos) << sentence();
}

TEST_F(Report, GivesNoShareOfAGapThatGrows) {
  find_anisotropy();
  diagnosis_.gap_after = 220;
  EXPECT_NE(sentence().find("goes from 200.0 to 220.0"), std::string::npos) << sentence();
}

// A share of a gap that may be chance means nothing.
TEST_F(Report, GivesNoShareOfAGapThatMayBeChance) {
  find_anisotropy();
  diagnosis_.gap_scatter = 80;
  EXPECT_EQ(sentence().find('%'), std::string::npos);
  EXPECT_NE(sentence().find("goes from 200.0 to 10.0, where chance makes +- 80.0"), std::string::npos);
  diagnosis_.gap_scatter = 20;
  EXPECT_NE(sentence().find('%'), std::string::npos);
  diagnosis_.gap_of_floor = 150;  // differences between programs may be all there is
  EXPECT_EQ(sentence().find('%'), std::string::npos);
}

TEST_F(Report, SaysThatNothingExplainsTheGap) {
  diagnosis_.verdict = {"unexplained"};
  EXPECT_EQ(sentence(), "Something is missing (p = 1.0e-20) that no effect of the catalogue explains.");
}

TEST_F(Report, IsOnePageThatNeedsNoOther) {
  find_anisotropy();
  const std::string text = page();
  for (const char* fetched : {"src=", "href=", "@import", "url(", "<script"})
    EXPECT_EQ(text.find(fetched), std::string::npos) << fetched;
  // The picture's name space is no address that is looked up.
  std::size_t addresses = 0, name_spaces = 0;
  for (std::size_t at = 0; (at = text.find("http", at)) != text.npos; ++at) ++addresses;
  for (std::size_t at = 0; (at = text.find("http://www.w3.org/2000/svg", at)) != text.npos; ++at)
    ++name_spaces;
  EXPECT_EQ(addresses, name_spaces);
  EXPECT_GE(name_spaces, 7u);
}

TEST_F(Report, KeepsNamesFromBeingMarkup) {
  const std::string text = page();
  EXPECT_EQ(text.find("<of>"), std::string::npos);
  EXPECT_NE(text.find("runs &lt;of&gt; today.h5"), std::string::npos);
  EXPECT_NE(text.find("What is ice &amp; more missing?"), std::string::npos);
}

TEST_F(Report, TellsValuesRemarksAndWhatWasNotTested) {
  find_anisotropy();
  diagnosis_.remarks = {"noise was given up when tilt came in"};
  diagnosis_.not_tested = {{"cable-shadow", "where the cables are is not known"}};
  diagnosis_.left_out = {"Run 40,2 is dark"};
  const std::string text = page();
  for (const char* told :
       {"<td>absorption-anisotropy.k1</td><td>0.597 ± 0.029</td><td>14.0</td><td>nothing else</td>",
        "<td>absorption-anisotropy</td><td>k1 0.597 ± 0.029</td>", "noise was given up when tilt came in.",
        "<li>cable-shadow: where the cables are is not known</li>", "<li>Run 40,2 is dark</li>",
        "<td>36,20</td><td>200.0</td><td>10.0</td>"})
    EXPECT_NE(text.find(told), std::string::npos) << told;
}

}  // namespace
}  // namespace floe::test
