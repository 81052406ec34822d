// Photons in endless ice, against the moments of a random walk with exponential steps. Where they are on
// their way is seen by a lattice of widened modules, which let photons pass: hits sample paths evenly, since
// the source is spread evenly over a cell of the lattice.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "data/base/constants.h"
#include "propagation/sources/flasher.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

constexpr double spacing = 4, oversize = 6;  // of the lattice [m]; of the modules in it
constexpr int half_count = 8;                // modules on either side of the central one, along each axis

std::vector<Vec3> lattice() {
  std::vector<Vec3> places;
  for (int i = -half_count; i <= half_count; ++i)
    for (int j = -half_count; j <= half_count; ++j)
      for (int k = -half_count; k <= half_count; ++k) places.push_back(spacing * Vec3(i, j, k));
  return places;
}

// Isotropic light from anywhere in the lattice's central cell.
class CellSource : public OneByOneSource {
 public:
  explicit CellSource(double photons) : photons_(photons) {}
  double photons() const override { return photons_; }

 private:
  EmittedPhoton emit_one(RandomStream& random) const override {
    EmittedPhoton photon{};
    photon.wavelength = 400;
    for (int k = 0; k < 3; ++k) photon.position[k] = static_cast<float>(spacing) * (random.uniform() - 0.5f);
    const double cosine = 2.0 * random.uniform() - 1;
    photon.direction = unit_vector(std::acos(cosine), 2 * pi * random.uniform()).cast<float>();
    return photon;
  }

  double photons_;
};

// A ratio of two sums over independent photons, with its standard error.
class PhotonRatio {
 public:
  void add(double numerator, double denominator) {
    n_ += numerator, d_ += denominator;
    nn_ += numerator * numerator, nd_ += numerator * denominator, dd_ += denominator * denominator;
  }
  double value() const { return n_ / d_; }
  double error() const {
    const double r = value();
    return std::sqrt(std::max(0.0, nn_ - 2 * r * nd_ + r * r * dd_)) / d_;
  }

 private:
  double n_ = 0, d_ = 0, nn_ = 0, nd_ = 0, dd_ = 0;
};
void expect_ratio(const PhotonRatio& ratio, double expected, const std::string& what) {
  EXPECT_NEAR(ratio.value(), expected, 4 * ratio.error() + 1e-3 * expected) << what;
}

// A point on a photon's path: how far the photon had flown, and where it was, seen from its birth.
struct PathPoint {
  std::uint64_t photon;
  double flown;
  Vec3 displacement;
};

class RandomWalk : public test::BothEngines {
 protected:
  static constexpr std::uint64_t seed = 5;
  static constexpr int photons = 20000;

  // Propagates `photons` photons.
  void walk(const IceTables& tables) {
    const Model model = test::make_model(tables, lattice());
    const CellSource source(photons * oversize * oversize);
    const Run result = run(model, source, oversize, seed);
    summary_ = result.summary;
    points_.clear();
    for (const SimulatedHit& hit : result.hits) points_.push_back(path_point(hit, model, source));
  }

  // Calls add(flown, displacement, sums of this photon) for every point of each photon, then closes it.
  template <typename Value>
  PhotonRatio mean(const Value& value, double from = 0,
                   double to = std::numeric_limits<double>::infinity()) const {
    PhotonRatio ratio;
    for (std::size_t i = 0; i < points_.size();) {
      double sum = 0, count = 0;
      const std::uint64_t photon = points_[i].photon;
      for (; i < points_.size() && points_[i].photon == photon; ++i)
        if (points_[i].flown >= from && points_[i].flown < to) sum += value(points_[i]), ++count;
      ratio.add(sum, count);
    }
    return ratio;
  }

  // Mean length of path, from the number of modules on it.
  PhotonRatio mean_path() const {
    const double area = pi * std::pow(oversize * module_radius, 2), volume = std::pow(spacing, 3);
    PhotonRatio ratio;
    std::size_t seen = 0;
    for (std::size_t i = 0; i < points_.size(); ++seen) {
      double count = 0;
      const std::uint64_t photon = points_[i].photon;
      for (; i < points_.size() && points_[i].photon == photon; ++i) ++count;
      ratio.add(count * volume / area, 1);
    }
    for (; seen < photons; ++seen) ratio.add(0, 1);
    return ratio;
  }

  SimulationSummary summary_;
  std::vector<PathPoint> points_;

 private:
  // The photon lands at the module's centre less its offset, X times that on the module of nominal size.
  static PathPoint path_point(const SimulatedHit& hit, const Model& model, const Source& source) {
    RandomStream random(seed, 0, hit.photon);
    const EmittedPhoton born = source.emit(random);
    const Vec3 along = hit.direction.cast<double>(), inward = module_radius * hit.inward.cast<double>();
    const double half_chord = inward.dot(along);
    const Vec3 offset = oversize * (inward - half_chord * along) + half_chord * along;
    const Vec3 place = model.detector->modules()[hit.module].position - offset;
    return {hit.photon, hit.time * speed_of_light / group_index(400), place - born.position.cast<double>()};
  }
};

struct Medium {
  double scattering, absorption, mean_cosine, liu_fraction;  // geometric b, a [1/m]; g; f_SL
};
constexpr Medium media[] = {{2, 0.1, 0.5, 0}, {6, 0.1, 0.9, 0.35}, {1, 0.1, 0, 0}, {3, 0.2, 0.8, 1}};

IceTables tables_of(const Medium& medium) {
  return test::uniform_tables({1 / (medium.scattering * (1 - medium.mean_cosine)), 1 / medium.absorption,
                               medium.liu_fraction, medium.mean_cosine});
}
std::string name_of(const Medium& m) {
  return "b " + std::to_string(m.scattering) + ", g " + std::to_string(m.mean_cosine);
}

// Paths end by absorption alone: their lengths are exponential with mean 1/a, whatever the scattering, so
// that points on them have the density a exp(-a s); and a photon scatters b/a times.
TEST_P(RandomWalk, PathsUntilAbsorptionAreExponential) {
  for (const Medium& medium : media) {
    walk(tables_of(medium));
    const double a = medium.absorption, scatters = medium.scattering / a;
    expect_ratio(mean_path(), 1 / a, name_of(medium));
    EXPECT_NEAR(static_cast<double>(summary_.scatters) / photons, scatters,
                4 * std::sqrt(scatters * (1 + scatters) / photons))
        << name_of(medium);
    for (const double depth : {0.1, 0.5, 1.0, 2.0, 3.0})
      expect_ratio(mean([&](const PathPoint& p) { return a * p.flown > depth; }), std::exp(-depth),
                   name_of(medium) + " beyond depth " + std::to_string(depth));
  }
}

// The direction's mean along its first one decays as exp(-b's), b' = b (1 - g). So <r.n> = (1 -
// exp(-b's))/b', and d<r^2>/ds = 2 <r.n>: <r^2> = (2/b') (s - (1 - exp(-b's))/b'), ballistic at first and
// diffusion later. Over the exponential lengths of whole paths its mean is 2/(a (a + b')).
TEST_P(RandomWalk, MeanSquareDisplacementIsThatOfExponentialSteps) {
  for (const Medium& medium : media) {
    walk(tables_of(medium));
    const double a = medium.absorption, b = medium.scattering * (1 - medium.mean_cosine);
    const auto square = [](const PathPoint& p) { return p.displacement.squaredNorm(); };
    expect_ratio(mean(square), 2 / (a * (a + b)), name_of(medium));

    // Between two lengths, weighted with exp(-a s): the antiderivative, without its constant factor.
    const auto square_integral = [&](double s) {
      return -std::exp(-a * s) * (s / a + 1 / (a * a)) + std::exp(-a * s) / (a * b) -
             std::exp(-(a + b) * s) / ((a + b) * b);
    };
    const auto weight_integral = [&](double s) { return -std::exp(-a * s) / a; };
    for (const auto& [from, to] : {std::pair(0.0, 1.0), std::pair(1.0, 4.0), std::pair(4.0, 10.0),
                                   std::pair(10.0, 20.0), std::pair(20.0, 40.0)}) {
      const double expected = 2 / b * (square_integral(to) - square_integral(from)) /
                              (weight_integral(to) - weight_integral(from));
      expect_ratio(mean(square, from, to), expected, name_of(medium) + " after " + std::to_string(to) + " m");
    }
  }
}

// Where light scatters into all directions alike in the stretched space, a scatter forgets the direction
// before it, and directions follow n = (m1/K1, m2/K2, m3 K1 K2)/|.| with m isotropic. With q_i = <n_i^2>, and
// 1/3 until the first scatter, d<x_i^2>/ds = 2 <x_i n_i> and d<x_i n_i>/ds = <n_i^2> - b <x_i n_i> give, over
// the lengths of whole paths, <x_i^2> = 2/(a + b) ((1/3 - q_i)/(a + b) + q_i/a).
TEST_P(RandomWalk, AnisotropicScatteringStretchesTheDiffusion) {
  const double a = 0.1, b = 1, k1 = 0.25, k2 = -0.1, azimuth = 30 * degree;
  const Vec3 K(std::exp(k1), std::exp(k2), std::exp(-k1 - k2));
  Vec3 q = Vec3::Zero();
  constexpr int rings = 200, places = 200;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < places; ++j) {
      const Vec3 m = unit_vector(std::acos(-1 + 2 * (i + 0.5) / rings), 2 * pi * (j + 0.5) / places);
      q += m.cwiseQuotient(K).normalized().cwiseAbs2() / (rings * places);
    }

  IceTables tables = tables_of({b, a, 0, 0});
  tables.configuration.flow_azimuth_deg = 30;
  tables.configuration.k1 = -0.5;  // the layers' own numbers override the directory's
  tables.configuration.k2 = 0.3;
  tables.configuration.old_absorption_scaling = 0;
  for (IceLayerRow& row : tables.layers) row.k1 = k1, row.k2 = k2;
  walk(tables);
  expect_ratio(mean_path(), 1 / a, "path");
  const Vec3 axes[] = {unit_vector(pi / 2, azimuth), unit_vector(pi / 2, azimuth + pi / 2), Vec3::UnitZ()};
  for (int i = 0; i < 3; ++i) {
    const double expected = 2 / (a + b) * ((1.0 / 3 - q[i]) / (a + b) + q[i] / a);
    expect_ratio(mean([&](const PathPoint& p) { return std::pow(p.displacement.dot(axes[i]), 2); }), expected,
                 "axis " + std::to_string(i));
  }
}

FLOE_INSTANTIATE_ENGINES(RandomWalk);

}  // namespace
}  // namespace floe
