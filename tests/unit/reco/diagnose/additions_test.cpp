// What a diagnosis adds and gives up again, as it is recorded.
#include "reco/diagnose/additions.h"

#include <gtest/gtest.h>

namespace floe::test {
namespace {

class AdditionsTest : public ::testing::Test {
 protected:
  // A look that finds this, with the fit of all that is there and of it.
  void add(const std::string& effect, const std::string& parameter, const std::vector<double>& numbers) {
    record_.steps.emplace_back();
    record_.looked_at_improved = true;
    NamedEffect named;
    named.suspect.effect = effect;
    named.parameters = {effect_parameter(effect + "." + parameter, base_)};
    IceFit fit;
    fit.parameters = additions_.accepted().parameters(named.parameters);
    fit.numbers = numbers;
    const auto size = static_cast<Eigen::Index>(numbers.size());
    fit.covariance = Eigen::VectorXd::Constant(size, 1e-4).asDiagonal();
    additions_.add(named, fit);
  }

  const Model base_ = load_model({});  // absorption anisotropy 0.6, flow azimuth 130 deg
  const FlasherData data_;
  const Progress progress_;
  const Stages stages_{progress_};
  const EffectFits fits_{base_, data_, {}, stages_};  // which none of these tests asks
  Diagnosis record_;
  Additions additions_{base_, fits_, record_};
};

TEST_F(AdditionsTest, LooksKnowWhatTheyAdded) {
  add("absorption-anisotropy", "k1", {0.4});
  record_.steps.emplace_back();  // a look that added nothing
  add("flow-azimuth", "azimuth", {0.4, 120});
  add("noise", "rate", {0.4, 120, 700});
  EXPECT_EQ(record_.steps[0].added, 0u);
  EXPECT_FALSE(record_.steps[1].added);
  EXPECT_EQ(record_.steps[2].added, 1u);
  EXPECT_EQ(record_.steps[3].added, 2u);

  additions_.give_up(0, "it is too much");
  EXPECT_FALSE(record_.steps[0].added);
  EXPECT_EQ(record_.steps[2].added, 0u);
  EXPECT_EQ(record_.steps[3].added, 1u);
  EXPECT_EQ(additions_.accepted().effects()[0].suspect.effect, "flow-azimuth");
  ASSERT_EQ(record_.remarks.size(), 1u);
  EXPECT_EQ(record_.remarks[0], "absorption-anisotropy was given up: it is too much");
  EXPECT_FALSE(record_.looked_at_improved);
}

// Limits are on what came in, so that what comes and goes does not go on for ever.
TEST_F(AdditionsTest, CountWhatTheyGaveUp) {
  add("absorption-anisotropy", "k1", {0.4});
  add("noise", "rate", {0.4, 700});
  EXPECT_EQ(additions_.count(), 2);
  additions_.give_up_all("none of them names it");
  EXPECT_TRUE(additions_.accepted().empty());
  EXPECT_EQ(additions_.count(), 2);
  EXPECT_EQ(record_.remarks.size(), 2u);
  for (const DiagnosisStep& step : record_.steps) EXPECT_FALSE(step.added);
}

}  // namespace
}  // namespace floe::test
