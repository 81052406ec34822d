// What a scatter leaves of the score of a birefringent step.
#include "propagation/engine/turn_score.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "propagation/engine/anisotropy.h"
#include "propagation/engine/birefringence.h"
#include "propagation/engine/directions.h"

namespace floe {
namespace {

struct Case {
  const char* name;
  double width_x, width_y, mean_x;
  double liu, g, k1, k2;
  double share;  // of the drawn squares' variance that is left, at most
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

// The step without its normals.
BirefringentTurn plane_of(const Vec3& n, double width_x, double width_y, double mean_x) {
  const auto frame = flow_frame(1.0, 0.0, n.x(), n.y(), n.z());
  return {
      n, Vec3(frame.xx, frame.xy, frame.xz), Vec3(frame.yx, frame.yy, frame.yz), width_x, width_y, mean_x, 0,
      0};
}

class TurnScores : public ::testing::TestWithParam<Case> {};

// Draws steps, each followed by a scatter. Given the direction after the scatter, the drawn moments and their
// means must be worth the same: no function of the direction sees a difference. A tenth of a percent of the
// functions' widths is seen.
TEST_P(TurnScores, HaveTheMeanThatTheScatterLeaves) {
  const Case c = GetParam();
  const ScatteringFunction<double> exact{c.liu, c.g};
  const ScatteringFunction<float> dust{static_cast<float>(c.liu), static_cast<float>(c.g)};
  const double K1 = std::exp(c.k1), K2 = std::exp(c.k2);
  const Vec3 n = unit_vector(1.1, 0.7);
  BirefringentTurn turn = plane_of(n, c.width_x, c.width_y, c.mean_x);
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  constexpr int draws = 300000, functions = 5;
  std::array<double, functions> squares{}, squares2{}, pulls{}, pulls2{};
  double drawn_variance = 0, variance = 0;
  for (int i = 0; i < draws; ++i) {
    turn.normal_x = normal(random), turn.normal_y = normal(random);
    const auto step = project_onto_sphere(c.width_x * turn.normal_x + c.mean_x, c.width_y * turn.normal_y);
    Vec3 after = n + step.x * turn.x + step.y * turn.y - step.loss * n;
    stretch_direction(K1, K2, after.x(), after.y(), after.z());
    after = deflect(after, exact.one_minus_cos(uniform(random)), uniform(random));
    stretch_direction(1 / K1, 1 / K2, after.x(), after.y(), after.z());

    const TurnMoments drawn = moments_drawn(turn);
    const TurnMoments given = moments_given_scatter(turn, after, dust, K1, K2);
    const double x = after.dot(turn.x), y = after.dot(turn.y);
    const std::array<double, functions> seen{1, x, x * x, y * y, x > 0.1 ? 1.0 : 0.0};
    for (std::size_t f = 0; f < functions; ++f) {
      const double square = (given.squares - drawn.squares) * seen[f],
                   pull = (given.pull - drawn.pull) * seen[f];
      squares[f] += square / draws, squares2[f] += square * square / draws;
      pulls[f] += pull / draws, pulls2[f] += pull * pull / draws;
    }
    drawn_variance += std::pow(drawn.squares - 2, 2) / draws;
    variance += std::pow(given.squares - 2, 2) / draws;
  }
  for (std::size_t f = 0; f < functions; ++f) {
    EXPECT_NEAR(squares[f], 0, 4 * std::sqrt(squares2[f] / draws)) << f;
    EXPECT_NEAR(pulls[f], 0, 4 * std::sqrt(pulls2[f] / draws)) << f;
  }
  EXPECT_LT(variance, c.share * drawn_variance);
}

// The mean over steps that a scatter leaves possible: by brute force, on a grid of normals.
TEST(TurnScore, IsTheMeanOverPossibleSteps) {
  const ScatteringFunction<float> dust{0.35f, 0.9f};
  const Vec3 n = unit_vector(1.1, 0.7);
  BirefringentTurn turn = plane_of(n, 0.08, 0.06, 0.02);
  const Vec3 after = (n + 0.15 * turn.x - 0.1 * turn.y).normalized();
  double total = 0, squares = 0, pull = 0;
  for (double gx = -5; gx <= 5; gx += 0.02)
    for (double gy = -5; gy <= 5; gy += 0.02) {
      const auto step = project_onto_sphere(0.08 * gx + 0.02, 0.06 * gy);
      const Vec3 led = n + step.x * turn.x + step.y * turn.y - step.loss * n;
      const double weight = std::exp(-(gx * gx + gy * gy) / 2) *
                            dust.density(static_cast<float>((led - after).squaredNorm() / 2));
      total += weight, squares += weight * (gx * gx + gy * gy), pull += weight * gx;
    }
  // Steps that were taken, given where they led: the same weights, on a coarse grid off the fine one's nodes.
  double drawn = 0, mean_squares = 0, mean_pull = 0;
  for (double gx = -4.9; gx <= 5; gx += 0.17)
    for (double gy = -4.9; gy <= 5; gy += 0.17) {
      turn.normal_x = gx, turn.normal_y = gy;
      const auto step = project_onto_sphere(0.08 * gx + 0.02, 0.06 * gy);
      const Vec3 led = n + step.x * turn.x + step.y * turn.y - step.loss * n;
      const double weight = std::exp(-(gx * gx + gy * gy) / 2) *
                            dust.density(static_cast<float>((led - after).squaredNorm() / 2));
      const TurnMoments given = moments_given_scatter(turn, after, dust, 1, 1);
      drawn += weight, mean_squares += weight * given.squares, mean_pull += weight * given.pull;
    }
  EXPECT_NEAR(mean_squares / drawn, squares / total, 0.01);
  EXPECT_NEAR(mean_pull / drawn, pull / total, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Dust, TurnScores,
                         ::testing::Values(Case{"usual", 0.08, 0.06, 0.02, 0.35, 0.9, 0, 0, 0.2},
                                           Case{"strong", 0.3, 0.2, 0.1, 0.35, 0.9, 0, 0, 0.75},
                                           Case{"sharp", 0.08, 0.06, 0.02, 0, 0.99, 0, 0, 0.85},
                                           Case{"anisotropic", 0.08, 0.06, 0.02, 0.2, 0.85, 0.2, -0.1, 0.2}),
                         [](const auto& c) { return std::string(c.param.name); });

}  // namespace
}  // namespace floe
