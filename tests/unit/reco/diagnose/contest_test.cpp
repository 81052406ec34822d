// Which of several suspects is missing: contests of made-up fits.
#include "reco/diagnose/contest.h"

#include <gtest/gtest.h>

#include "data/base/error.h"

namespace floe::test {
namespace {

class Contest : public ::testing::Test {
 protected:
  static constexpr double noise_ = 10;
  const Model base_ = load_model({});  // absorption anisotropy 0.6, scattering anisotropy 0

  Candidate candidate(const std::string& effect, double fitted, double neg_llh) const {
    Candidate candidate;
    candidate.trial.suspect.effect = effect;
    candidate.trial.parameters = {effect_parameter(effect, base_)};
    candidate.trial.neg_llh = neg_llh;
    candidate.fit.numbers = {fitted};
    return candidate;
  }
  static IceFit fit_with(std::vector<double> numbers, const std::vector<double>& errors) {
    IceFit fit;
    fit.numbers = std::move(numbers);
    fit.covariance =
        Eigen::Map<const Eigen::VectorXd>(errors.data(), static_cast<Eigen::Index>(errors.size()))
            .cwiseAbs2()
            .asDiagonal();
    return fit;
  }
  std::vector<Candidate> rivals(double absorption_neg_llh) const {
    return {candidate("absorption-anisotropy", 0.05, absorption_neg_llh),
            candidate("scattering-anisotropy", 0.12, 185)};
  }
};

TEST_F(Contest, FarApartTheLikelihoodDecides) {
  auto candidates = rivals(185 + 2.1 * noise_);
  hold_contest(
      base_, noise_, [](const auto&, const auto&) -> IceFit { throw std::logic_error("fitted"); },
      candidates);
  EXPECT_EQ(candidates[0].trial.suspect.effect, "scattering-anisotropy");
  EXPECT_FALSE(candidates[1].trial.lost);
}

TEST_F(Contest, CloseRivalsMeetInOneFit) {
  auto candidates = rivals(185 + 1.5 * noise_);
  hold_contest(
      base_, noise_,
      [](const std::vector<IceParameter>& both, const auto& settled) {
        // Both begin half way to where they ended alone.
        EXPECT_EQ(both[0].name, "scattering-anisotropy.k1");
        EXPECT_DOUBLE_EQ(both[0].start, 0.06);
        EXPECT_DOUBLE_EQ(both[1].start, 0.325);
        EXPECT_FALSE(settled(fit_with({99, 0.02, 0.1}, {1, 0.02, 0.1})));  // 24: may change
        EXPECT_TRUE(settled(fit_with({99, 0.02, -0.1}, {1, 0.02, 0.1})));  // 1 - 49
        return fit_with({99, 0.02, 0.1}, {1, 0.02, 0.1});  // after what is in the model already
      },
      candidates);
  EXPECT_EQ(candidates[0].trial.suspect.effect, "absorption-anisotropy");
  ASSERT_TRUE(candidates[1].trial.lost);
  EXPECT_NEAR(candidates[1].trial.lost->winner, 25, 1e-9);
  EXPECT_NEAR(candidates[1].trial.lost->loser, 1, 1e-9);
  EXPECT_FALSE(lost_narrowly(candidates[1].trial));
}

// By its likelihood and by its own fit: no more light is spent on it. By one of them alone it may be chance.
TEST_F(Contest, WhoIsBehindInBothIsNotFittedAgain) {
  const auto fits_after = [&](double neg_llh, double chi_square) {
    auto candidates = rivals(neg_llh);  // absorption first
    candidates[0].trial.chi_square = chi_square;
    candidates[1].trial.chi_square = 100;
    int fits = 0;
    hold_contest(
        base_, noise_,
        [&](const auto&, const auto&) {
          ++fits;
          return fit_with({0.4, 0.6}, {0.05, 0.2});
        },
        candidates);
    EXPECT_EQ(candidates[0].trial.suspect.effect, "scattering-anisotropy");
    return fits;
  };
  EXPECT_EQ(fits_after(185 + 1.1 * noise_, 69), 0);
  EXPECT_EQ(fits_after(185 + 1.1 * noise_, 71), 1);
  EXPECT_EQ(fits_after(185 + 0.9 * noise_, 69), 1);
}

TEST_F(Contest, WhatBothCouldBeIsLostNarrowly) {
  auto candidates = rivals(186);
  hold_contest(
      base_, noise_,
      [](const auto&, const auto&) {
        return fit_with({0.05, 0.4}, {0.05, 0.2});
      },
      candidates);
  EXPECT_EQ(candidates[0].trial.suspect.effect, "scattering-anisotropy");
  EXPECT_TRUE(lost_narrowly(candidates[1].trial));
}

// Seen in trials: a late string, taken for one that has moved by a duel of 11.5 to 5.0. Three parameters add
// more by chance than one does, and what a duel leaves open is as -ln L has it.
TEST_F(Contest, WhoAddsHardlyMoreDoesNotOverruleTheLikelihood) {
  auto candidates = rivals(186);
  for (int more = 0; more < 2; ++more) {
    candidates[0].trial.parameters.push_back(candidates[0].trial.parameters.front());
    candidates[0].fit.numbers.push_back(0.6);
  }
  const auto ends_at = [&](double challenger) {
    auto met = candidates;
    hold_contest(
        base_, noise_,
        [&](const auto&, const auto&) {
          return fit_with({0.1, 0.6 - 0.1 * challenger, 0.6, 0.6}, {0.05, 0.1, 0.1, 0.1});  // chi-square 4
        },
        met);
    return met;
  };
  const auto open = ends_at(3.4);  // 11.6, with two parameters more
  EXPECT_EQ(open[0].trial.suspect.effect, "scattering-anisotropy");
  EXPECT_TRUE(lost_narrowly(open[1].trial));
  EXPECT_NEAR(open[1].trial.lost->lead, 4 - 11.56 + 2, 1e-9);
  const auto decided = ends_at(3.6);
  EXPECT_EQ(decided[0].trial.suspect.effect, "absorption-anisotropy");
  EXPECT_NEAR(decided[1].trial.lost->lead, 12.96 - 4 - 2, 1e-9);
  EXPECT_FALSE(lost_narrowly(decided[1].trial));
}

// B loses narrowly to A, which C beats: B has not met C, and may be as good.
TEST_F(Contest, WhoLostNarrowlyToABeatenLeaderIsNotTold) {
  auto candidates = rivals(186);
  candidates.push_back(candidate("birefringence.strength", 1.2, 187));
  int duels = 0;
  hold_contest(
      base_, noise_,
      [&](const auto&, const auto&) {
        return ++duels == 1 ? fit_with({0.2, 0.43}, {0.05, 0.05})  // 16 and 11.6
                            : fit_with({0.05, 1.5}, {0.05, 0.1});  // 1 and 25
      },
      candidates);
  EXPECT_EQ(duels, 2);
  EXPECT_EQ(candidates[0].trial.suspect.effect, "birefringence.strength");
  for (const std::size_t loser : {1, 2}) {
    const bool beaten_leader = candidates[loser].trial.suspect.effect == "scattering-anisotropy";
    EXPECT_EQ(lost_narrowly(candidates[loser].trial), !beaten_leader);
  }
}

// Each is needed beside the other by as much: neither stands for what both are.
TEST_F(Contest, WhatIsNeededBesideTheWinnerIsLostNarrowly) {
  auto candidates = rivals(186);
  hold_contest(
      base_, noise_,
      [](const auto&, const auto&) {
        return fit_with({0.2, 0.2}, {0.05, 0.1});  // chi-squares 16 and 16
      },
      candidates);
  EXPECT_TRUE(lost_narrowly(candidates[1].trial));
  ASSERT_TRUE(candidates[1].trial.lost);
  EXPECT_NEAR(candidates[1].trial.lost->loser, 16, 1e-9);
}

TEST_F(Contest, WithoutACommonFitTheLikelihoodDecides) {
  auto candidates = rivals(186);
  hold_contest(
      base_, noise_, [](const auto&, const auto&) -> IceFit { throw InputError("no such ice"); }, candidates);
  EXPECT_EQ(candidates[0].trial.suspect.effect, "scattering-anisotropy");
  EXPECT_FALSE(candidates[1].trial.lost);
  EXPECT_TRUE(lost_narrowly(candidates[1].trial));  // nothing tells it from the winner
}

// Depth and width of a band are no change: it is where it is.
TEST_F(Contest, ThePlaceOfABandIsNoChange) {
  Trial trial;
  for (const char* name : {"depth", "width", "factor"})
    trial.parameters.push_back(effect_parameter(std::string("absorption-layer.") + name, base_));
  EXPECT_NEAR(chi_square_of(trial.parameters, fit_with({1700, 80, 1.6}, {3, 7, 0.1}), 0, base_), 36, 1e-9);
}

TEST(Distance, KnowsCorrelations) {
  IceFit fit;
  fit.numbers = {7, 1, 2};
  fit.covariance = Eigen::Matrix3d::Identity();
  fit.covariance(1, 2) = fit.covariance(2, 1) = 0.5;
  const double nulls[] = {0, 0};
  // (1, 2) C^-1 (1, 2) with C = (1 0.5; 0.5 1): (1 - 2 + 4) / 0.75.
  EXPECT_NEAR(fit.distance(1, nulls), 4, 1e-12);
}

}  // namespace
}  // namespace floe::test
