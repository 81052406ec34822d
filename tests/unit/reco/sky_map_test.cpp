// Maps of direction and profile likelihoods, against likelihoods that are known in closed form.
#include "reco/direct_fit/sky_map.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "data/base/error.h"
#include "data/hdf5_handle.h"
#include "reco/direct_fit/profile.h"
#include "reco/direct_fit/sky_map_file.h"
#include "reco/direct_fit/sky_map_picture.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe {
namespace {

using Vector2 = Eigen::Vector2d;
constexpr CascadeKind kind = CascadeKind::electron;
constexpr int pixels = 41;

LocalFrame sample_frame() {
  return LocalFrame(light_centre({{20, -40, -300}, 0, 70 * degree, 130 * degree, 1000}, kind));
}

Vector7 sample_errors() {
  return (Vector7() << 0.4, 0.3, 0.25, 0.006, 0.009, 1.2, 0.02).finished();
}

Vector7 sample_best() {
  return (Vector7() << 0.1, -0.2, 0.05, 0.01, -0.02, 0.3, 0.05).finished();
}

// From correlated numbers to independent ones of unit error.
Matrix7 sample_mixing() {
  Matrix7 mixing = Matrix7::Identity();
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 7; ++j)
      if (i != j) mixing(i, j) = 0.2 * std::sin(3.0 * i + 5.0 * j);
  return mixing;
}

// gap = mixing * bend(u), u the distance from the solution in units of `errors`; bend(0) = 0 with slope 1.
template <typename Bend>
ScoreLikelihood make_likelihood(const Matrix7& mixing, const Vector7& errors, const Bend& bend) {
  ScoreLikelihood likelihood{{}, sample_frame(), sample_best(), Matrix7::Zero(), Vector7::Constant(1e9)};
  const Matrix7 unit = errors.asDiagonal();
  likelihood.covariance = unit * (mixing.transpose() * mixing).inverse() * unit;
  likelihood.at = [=, best = likelihood.best](const Vector7& p) {
    const Vector7 u = (p - best).cwiseQuotient(errors);
    ScoreLikelihood::Point point;
    Matrix7 slope = Matrix7::Identity();
    point.gap = mixing * bend(u, slope);
    point.slope = mixing * slope * errors.cwiseInverse().asDiagonal();
    return point;
  };
  return likelihood;
}

ScoreLikelihood gaussian() {
  return make_likelihood(sample_mixing(), sample_errors(), [](const Vector7& u, Matrix7&) { return u; });
}

// Like a banana in direction, the other numbers with it.
ScoreLikelihood banana() {
  return make_likelihood(sample_mixing(), sample_errors(), [](const Vector7& u, Matrix7& slope) {
    Vector7 bent = u;
    bent(0) += 0.1 * u(3) * u(3);
    slope(0, 3) = 0.2 * u(3);
    bent(3) += 0.1 * u(4) * u(4) + 0.03 * u(0) * u(0);
    slope(3, 4) = 0.2 * u(4);
    slope(3, 0) = 0.06 * u(0);
    bent(6) += 0.05 * u(0) * u(4);
    slope(6, 0) = 0.05 * u(4);
    slope(6, 4) = 0.05 * u(0);
    return bent;
  });
}

Vector2 local_direction(const ScoreLikelihood& likelihood, const Origin& origin) {
  LightCentre light = likelihood.frame.origin();
  light.direction = travel_direction(origin.zenith, origin.azimuth);
  return likelihood.frame.of(light).segment<2>(3);
}

// Delta -ln L of the Gaussian likelihood.
double marginal(const ScoreLikelihood& likelihood, const Origin& origin) {
  const Vector2 away = local_direction(likelihood, origin) - likelihood.best.segment<2>(3);
  const Eigen::Matrix2d covariance = likelihood.covariance.block<2, 2>(3, 3);
  return 0.5 * away.dot(covariance.inverse() * away);
}

// The lowest -ln L at a direction without any derivatives: steps along the axes, halved when none helps.
double lowest_by_trial(const ScoreLikelihood& likelihood, const Origin& origin) {
  const Vector7 errors = sample_errors();
  const auto value = [&](const Vector7& p) { return 0.5 * likelihood.at(p).gap.squaredNorm(); };
  Vector7 p = likelihood.best;
  p.segment<2>(3) = local_direction(likelihood, origin);
  double lowest = value(p);
  for (double size = 1; size > 1e-4;) {
    bool better = false;
    for (const int i : {0, 1, 2, 5, 6})
      for (const double side : {-1.0, 1.0}) {
        Vector7 trial = p;
        trial(i) += side * size * errors(i);
        if (const double found = value(trial); found < lowest) lowest = found, p = trial, better = true;
      }
    if (!better) size *= 0.5;
  }
  return lowest;
}

TEST(SkyMap, OfAGaussianIsTheMarginalQuadraticForm) {
  const ScoreLikelihood likelihood = gaussian();
  const SkyMap map = make_sky_map(likelihood, pixels, 2);
  ASSERT_EQ(map.delta_neg_llh.size(), std::size_t(pixels * pixels));
  for (int row = 0; row < pixels; ++row)
    for (int column = 0; column < pixels; ++column)
      ASSERT_NEAR(map.at(row, column), marginal(likelihood, map.direction_at(row, column)), 1e-4)
          << row << " " << column;
}

TEST(SkyMap, AreasAreThoseOfEllipses) {
  const ScoreLikelihood likelihood = gaussian();
  const SkyMap map = make_sky_map(likelihood, pixels, 2);
  const double axes = std::sqrt(likelihood.covariance.block<2, 2>(3, 3).determinant()) / (degree * degree);
  for (const double share : {0.5, 0.9, 0.99}) {
    const double expected = pi * 2 * level_of(share) * axes;
    // Chords between pixels: delta -ln L comes out too high by up to (step / error)^2 / 12 on either axis.
    EXPECT_NEAR(map.area(share), expected, (share < 0.6 ? 0.05 : 0.02) * expected) << share;
    EXPECT_FALSE(map.is_cut(share));
  }
  EXPECT_TRUE(map.is_cut(1 - 1e-9));
  EXPECT_NEAR(level_of(0.9), std::log(10), 1e-12);
}

TEST(SkyMap, DirectionsRiseWithRowsAndColumns) {
  const ScoreLikelihood likelihood = gaussian();
  const SkyMap map = make_sky_map(likelihood, 5, 1);
  const Origin best = origin_of(likelihood.frame.at(likelihood.best).direction);
  const Origin middle = map.direction_at(2, 2), right = map.direction_at(2, 3), down = map.direction_at(3, 2);
  EXPECT_NEAR(middle.zenith, best.zenith, 1e-9);
  EXPECT_NEAR(middle.azimuth, best.azimuth, 1e-9);
  EXPECT_NEAR((right.azimuth - best.azimuth) * std::sin(best.zenith), map.step, 0.01 * map.step);
  EXPECT_NEAR(down.zenith - best.zenith, map.step, 1e-9);
  EXPECT_NEAR(down.azimuth, best.azimuth, 1e-9);
  const auto [x, y] = map.point_of(map.direction_of({0.3, -0.2}));
  EXPECT_NEAR(x, 0.3, 1e-9);
  EXPECT_NEAR(y, -0.2, 1e-9);
  EXPECT_THROW(make_sky_map(likelihood, 4, 1), UsageError);
  EXPECT_THROW(make_sky_map(likelihood, 1, 1), UsageError);
}

TEST(SkyMap, FindsTheLowestPointsOfABanana) {
  const ScoreLikelihood likelihood = banana();
  const SkyMap map = make_sky_map(likelihood, pixels, 2);
  int compared = 0;
  for (int row = 0; row < pixels; row += 4)
    for (int column = 0; column < pixels; column += 4) {
      const double expected = lowest_by_trial(likelihood, map.direction_at(row, column));
      if (expected > 8) continue;
      ++compared;
      EXPECT_NEAR(map.at(row, column), expected, 2e-3) << row << " " << column;
    }
  EXPECT_GT(compared, 10);
}

TEST(SkyMap, DoesNotDependOnTheNumberOfThreads) {
  const ScoreLikelihood likelihood = banana();
  EXPECT_EQ(make_sky_map(likelihood, 15, 1).delta_neg_llh, make_sky_map(likelihood, 15, 3).delta_neg_llh);
}

TEST(SkyMap, EndsWhereTheSumsAreNotTrusted) {
  ScoreLikelihood likelihood = gaussian();
  likelihood.trusted(3) = std::abs(likelihood.best(3)) + 0.005;
  const SkyMap map = make_sky_map(likelihood, pixels, 2);
  int unknown = 0;
  for (int row = 0; row < pixels; ++row)
    for (int column = 0; column < pixels; ++column) {
      const double place = local_direction(likelihood, map.direction_at(row, column))(0);
      if (std::abs(std::abs(place) - likelihood.trusted(3)) < 1e-7) continue;
      EXPECT_EQ(std::isnan(map.at(row, column)), std::abs(place) > likelihood.trusted(3));
      unknown += std::isnan(map.at(row, column));
    }
  EXPECT_GT(unknown, 0);
  EXPECT_TRUE(map.is_cut(0.99));
}

TEST(Contours, AreClosedAndAtTheLevel) {
  const ScoreLikelihood likelihood = gaussian();
  const SkyMap map = make_sky_map(likelihood, pixels, 2);
  for (const double share : {0.5, 0.9, 0.99}) {
    const auto lines = contours(map, level_of(share));
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].front(), lines[0].back());
    double area = 0;
    for (std::size_t i = 0; i + 1 < lines[0].size(); ++i) {
      const auto [x, y] = lines[0][i];
      const auto [next_x, next_y] = lines[0][i + 1];
      area += 0.5 * (x * next_y - y * next_x);
      // A chord of a pixel's length lies (step / error)^2 / 8 above the parabola at most.
      EXPECT_NEAR(marginal(likelihood, map.direction_of({x, y})), level_of(share), 0.06);
    }
    EXPECT_NEAR(std::abs(area) / (degree * degree), map.area(share), 0.05 * map.area(share));
  }
}

TEST(Contours, AreOpenWhereTheMapEnds) {
  const SkyMap map = make_sky_map(gaussian(), pixels, 2);
  const auto lines = contours(map, level_of(1 - 1e-6));
  ASSERT_FALSE(lines.empty());
  const double half = map.step * (pixels / 2);
  for (const auto& line : lines) {
    EXPECT_NE(line.front(), line.back());
    for (const auto& [x, y] : {line.front(), line.back()})
      EXPECT_NEAR(std::max(std::abs(x), std::abs(y)), half, 1e-9);
  }
  EXPECT_TRUE(contours(map, -1).empty());
}

TEST(Contours, JoinASaddleByItsMiddle) {
  SkyMap map;
  map.pixels = 3;
  map.step = 0.01;
  map.zenith = 1;
  map.delta_neg_llh = {0, 2, 0, 2, 0.5, 2, 0, 2, 0};
  EXPECT_EQ(contours(map, 0.8).size(), 5u);  // around every corner and around the middle
  map.delta_neg_llh = {0, 1, 0, 1, 0.1, 1, 0, 1, 0};
  EXPECT_EQ(contours(map, 0.8).size(), 4u);  // around what lies between the corners
}

TEST(Profile, OfAGaussianIsOneStandardError) {
  const ScoreLikelihood likelihood = gaussian();
  const ProfileIntervals intervals = profile_intervals(likelihood, kind);
  const Vector7 best = to_vector(cascade_of(likelihood.frame.at(likelihood.best), kind));
  const Matrix7 jacobian = likelihood.frame.jacobian(likelihood.best, kind);
  const Matrix7 covariance = jacobian * likelihood.covariance * jacobian.transpose();
  for (int i = 0; i < 7; ++i) {
    const double error = std::sqrt(covariance(i, i));
    const auto [low, high] = intervals[static_cast<std::size_t>(i)];
    // The energy is an exponential of the local number: errors of some per cent differ by that.
    EXPECT_NEAR(low, best(i) - error, 0.03 * error) << i;
    EXPECT_NEAR(high, best(i) + error, 0.03 * error) << i;
  }
}

TEST(Profile, FollowsASkewLikelihood) {
  constexpr double skew = 0.3;
  Vector7 errors = sample_errors();
  errors(6) = 0.1;
  const ScoreLikelihood likelihood =
      make_likelihood(Matrix7::Identity(), errors, [](const Vector7& u, Matrix7& slope) {
        Vector7 bent = u;
        bent(6) = std::expm1(skew * u(6)) / skew;
        slope(6, 6) = std::exp(skew * u(6));
        return bent;
      });
  const auto energy = [&](double gap) {
    Vector7 p = likelihood.best;
    p(6) += errors(6) * std::log1p(skew * gap) / skew;
    return cascade_of(likelihood.frame.at(p), kind).energy;
  };
  const auto [low, high] = profile_intervals(likelihood, kind)[6];
  EXPECT_NEAR(low, energy(-1), 1e-3 * energy(0));
  EXPECT_NEAR(high, energy(+1), 1e-3 * energy(0));
  EXPECT_GT(energy(0) - low, 1.1 * (high - energy(0)));
}

TEST(Profile, IsNotKnownWhereTheSumsAreNotTrusted) {
  ScoreLikelihood likelihood = gaussian();
  const double error = std::sqrt(likelihood.covariance(6, 6));
  likelihood.trusted(6) = likelihood.best(6) + 0.5 * error;
  const auto [low, high] = profile_intervals(likelihood, kind)[6];
  EXPECT_TRUE(std::isfinite(low));
  EXPECT_TRUE(std::isnan(high));
}

// --- files and pictures

template <typename T>
T read_attribute(hid_t file, const std::string& group, const char* name, hid_t type) {
  const Hdf5Handle attribute(H5Aopen_by_name(file, group.c_str(), name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                             "open an attribute");
  T value{};
  checked(H5Aread(attribute, type, &value), "read an attribute");
  return value;
}

std::string read_text(hid_t file, const std::string& group, const char* name) {
  const Hdf5Handle attribute(H5Aopen_by_name(file, group.c_str(), name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                             "open an attribute");
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose, "read an attribute");
  std::string text(H5Tget_size(type), ' ');
  checked(H5Aread(attribute, type, text.data()), "read an attribute");
  return text;
}

std::vector<double> read_pixels(hid_t file, const std::string& name, int n) {
  const Hdf5Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, "open a map");
  const Hdf5Handle space(H5Dget_space(set), H5Sclose, "open a map");
  std::array<hsize_t, 2> shape{};
  EXPECT_EQ(H5Sget_simple_extent_ndims(space), 2);
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  EXPECT_EQ(shape[0], static_cast<hsize_t>(n));
  EXPECT_EQ(shape[1], static_cast<hsize_t>(n));
  std::vector<double> values(shape[0] * shape[1]);
  checked(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read a map");
  return values;
}

TEST(SkyMapFile, ComesBackAsItWas) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "map.h5";
  SkyMap first = make_sky_map(gaussian(), 11, 2);
  const SkyMap second = make_sky_map(banana(), 9, 2);
  first.delta_neg_llh[3] = std::numeric_limits<double>::quiet_NaN();
  {
    AtomicFile file(path);
    const std::vector<SkyMapOfEvent> maps{{"a", first}, {"run:b", second}};
    write_sky_maps(file, {"1.2.3", "ice", "0123"}, maps);
  }
  EXPECT_EQ(folder.file_count(), 1u);
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open the file");
  EXPECT_EQ(read_text(file, "/", "format"), "floe-sky-map");
  EXPECT_EQ(read_attribute<std::uint64_t>(file, "/", "format_version", H5T_NATIVE_UINT64), 1u);
  EXPECT_EQ(read_text(file, "/", "version"), "1.2.3");
  EXPECT_EQ(read_text(file, "/", "ice_name"), "ice");
  EXPECT_EQ(read_text(file, "/", "ice_hash"), "0123");
  EXPECT_EQ(read_text(file, "event_0", "event"), "a");
  EXPECT_EQ(read_text(file, "event_1", "event"), "run:b");
  EXPECT_EQ(H5Lexists(file, "event_2", H5P_DEFAULT), 0);

  const auto number = [&](const char* group, const char* name) {
    return read_attribute<double>(file, group, name, H5T_NATIVE_DOUBLE);
  };
  EXPECT_EQ(number("event_1", "zenith_deg"), second.zenith / degree);
  EXPECT_EQ(number("event_1", "azimuth_deg"), second.azimuth / degree);
  EXPECT_EQ(number("event_1", "area_90_deg2"), second.area(0.9));
  EXPECT_EQ(number("event_1", "level_50"), level_of(0.5));
  EXPECT_EQ(read_pixels(file, "event_1/delta_neg_llh", 9), second.delta_neg_llh);
  const std::vector<double> deltas = read_pixels(file, "event_0/delta_neg_llh", 11);
  EXPECT_TRUE(std::isnan(deltas[3]));
  EXPECT_EQ(deltas[4], first.delta_neg_llh[4]);
  const Origin corner = second.direction_at(0, 8);
  EXPECT_EQ(read_pixels(file, "event_1/zenith_deg", 9)[8], corner.zenith / degree);
  EXPECT_EQ(read_pixels(file, "event_1/azimuth_deg", 9)[8], corner.azimuth / degree);
}

TEST(SkyMapPicture, ShowsContoursBestAndTruth) {
  const SkyMap map = make_sky_map(gaussian(), 21, 2);
  const std::string picture = figure_of_sky_map(map, "event <1>", map.direction_at(8, 12));
  for (const char* expected : {"event &lt;1&gt;", "50%", "90%", "99%", "best", "truth", "</svg>"})
    EXPECT_NE(picture.find(expected), std::string::npos) << expected;
  EXPECT_EQ(figure_of_sky_map(map, "event").find("truth"), std::string::npos);
  EXPECT_EQ(picture.find("nan"), std::string::npos);
}

TEST(SkyMap, IsDescribedByItsAreas) {
  SkyMap map = make_sky_map(gaussian(), pixels, 2);
  EXPECT_NE(describe(map).find("50% in "), std::string::npos);
  EXPECT_EQ(describe(map).find("more than"), std::string::npos);
  map.delta_neg_llh[static_cast<std::size_t>(pixels * pixels / 2)] = NAN;
  EXPECT_NE(describe(map).find("50% in more than "), std::string::npos);
}

}  // namespace
}  // namespace floe
