// The walk: what must not happen, what must scale, and that the fast version is the plain one.
#include "propagation/crystal/walk.h"
#include "propagation/crystal/pattern_grid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace floe {
namespace {

const CrystalIndices violet{1.3185, 1.3200};

Polycrystal girdle_ice() {
  return {violet, Fabric::girdle(), spheroid(1.4)};
}

TEST(CrystalWalk, WithoutBirefringenceNothingHappens) {
  const Polycrystal glass{{1.32, 1.32}, Fabric::isotropic(), spheroid(1.4)};
  for (const WalkedPhoton& photon : walk_photons(glass, {30 * degree, 1000, 1e-3}, {1, 0, 0}, 640, 0)) {
    EXPECT_LT((photon.direction - Vec3(0, 0, 1)).norm(), 1e-12);
    EXPECT_LT((photon.position - Vec3(0, 0, 1)).norm(), 1e-12);
  }
}

TEST(CrystalWalk, IsotropicSpheresDeflectToNoSide) {
  const Polycrystal ice{violet, Fabric::isotropic(), spheroid(1)};
  const auto photons = walk_photons(ice, {50 * degree, 300, 1e-3}, {1, 0, 0}, 50000, 0);
  Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
  for (const WalkedPhoton& photon : photons) {
    sum += photon.direction;
    squares += photon.direction.cwiseAbs2();
  }
  const auto n = static_cast<double>(photons.size());
  for (const int axis : {0, 1}) {
    const double mean = sum[axis] / n, error = std::sqrt(squares[axis]) / n;
    EXPECT_LT(std::abs(mean), 4 * error) << axis;
    EXPECT_GT(error, 0);
  }
  // As much along the one axis as across it; tails make the sums of squares uneven by some percent.
  EXPECT_NEAR(squares[0] / squares[1], 1, 0.15);
}

// A photon is the same in both but for rounding, unless a draw falls between shares that differ by rounding.
void expect_agreement(const Polycrystal& ice, double angle) {
  const CrystalWalk walk{angle, 1000, 1e-3};
  const auto fast = walk_photons(ice, walk, {7, 3, 100}, 200, 0);
  int different = 0;
  for (std::size_t i = 0; i < fast.size(); ++i) {
    const WalkedPhoton plain = walk_plainly(ice, walk, {7, 3, 100 + i});
    const double apart =
        (plain.direction - fast[i].direction).norm() + (plain.position - fast[i].position).norm();
    if (apart > 1e-9) ++different;
  }
  EXPECT_LE(different, 2);
}

TEST(CrystalWalk, FastIsPlain) {
  for (const double angle : {5.0, 40.0, 85.0}) expect_agreement(girdle_ice(), angle * degree);
}
TEST(CrystalWalk, FastIsPlainForSpheres) {
  expect_agreement({violet, Fabric::isotropic(), spheroid(1)}, 30 * degree);
}
TEST(CrystalWalk, FastIsPlainForMeasuredFabrics) {
  expect_agreement({violet, Fabric::from_eigenvalues(fabric_eigenvalues(0.1, 4)), {{1.4, 0.9, 1.1}}},
                   30 * degree);
}
// Strong birefringence: waves are often evanescent or reflected.
TEST(CrystalWalk, FastIsPlainForCalcite) {
  const Polycrystal marble{{1.658, 1.486}, Fabric::isotropic(), spheroid(1.4)};
  const CrystalWalk walk{30 * degree, 20, 1e-3};
  const auto fast = walk_photons(marble, walk, {7, 3, 0}, 200, 0);
  for (std::size_t i = 0; i < fast.size(); ++i)
    EXPECT_LT((walk_plainly(marble, walk, {7, 3, i}).direction - fast[i].direction).norm(), 1e-9) << i;
}

TEST(CrystalWalk, DependsNeitherOnThreadsNorOnPortions) {
  const CrystalWalk walk{30 * degree, 100, 1e-3};
  const auto whole = walk_photons(girdle_ice(), walk, {1, 2, 0}, 300, 1);
  const auto threads = walk_photons(girdle_ice(), walk, {1, 2, 0}, 300, 2);
  const auto portion = walk_photons(girdle_ice(), walk, {1, 2, 77}, 50, 1);
  for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(whole[i].direction, threads[i].direction);
  for (std::size_t i = 0; i < portion.size(); ++i) EXPECT_EQ(whole[77 + i].position, portion[i].position);
}

// Across spheroids twice as long as wide light meets twice the boundaries that it meets along them, on
// equally long paths; spheres are alike in all directions.
TEST(CrystalWalk, ChordsFollowTheGrains) {
  PatternGrid grid{girdle_ice(), {0, 60 * degree, 90 * degree}, 1000, 1e-3, true, 1, 0, 200};
  grid.crystal.grains = spheroid(2);
  const auto patterns = walk_grid(grid);
  for (const CrystalPattern& pattern : patterns) EXPECT_NEAR(pattern.length, 1, 1e-9);
  EXPECT_NEAR(patterns[2].crossings, 2 * patterns[0].crossings, 2);
  // Shadow of the spheroid: sqrt(4 sin^2 + cos^2) = 1.803 times that along its axis.
  EXPECT_NEAR(patterns[1].crossings, std::sqrt(3.25) * patterns[0].crossings, 2);
  grid.crystal.grains = spheroid(1);
  for (const CrystalPattern& pattern : walk_grid(grid)) EXPECT_EQ(pattern.crossings, 1000);
}

}  // namespace
}  // namespace floe
