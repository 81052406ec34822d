// Every effect of modules and ice in the whole engine: on each scene there is an answer in closed form that
// changes when the effect is dropped or its sign is turned. The equations: docs/theory/effects.md.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "data/base/constants.h"
#include "propagation/sources/flasher.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

using test::line_at;
using test::line_at_400;
using test::make_model;
using test::modules_at;
using test::uniform_tables;
using test::UniformIce;

constexpr double R = module_radius;
constexpr UniformIce clear{1e9, 1e9};

class Effects : public test::BothEngines {
 protected:
  // The share of a pencil of light that module 0 keeps.
  double kept_share(const Model& model, const Vec3& from, const Vec3& direction, double oversize = 1,
                    int photons = 2000) const {
    const PointSource source(from, 0, photons * oversize * oversize, line_at_400(), direction);
    const auto hits = simulate(model, source, oversize);
    return static_cast<double>(
               std::count_if(hits.begin(), hits.end(), [](const auto& hit) { return hit.module == 0; })) /
           photons;
  }
};

void expect_share(double found, double expected, double photons, const std::string& what) {
  EXPECT_NEAR(found, expected, 4 * std::sqrt(std::max(expected * (1 - expected), 1 / photons) / photons))
      << what;
}

// --- modules ---

// Light along +x comes through a cable that stands at azimuth 180 deg - phi where it lands within the cable's
// radius of (R + r) sin(phi), X times as far out on a widened module. Turning the azimuth's sign moves the
// shadow to the other side; a cable behind the module shades nothing. Steep light casts the same shadow.
TEST_P(Effects, CableShadow) {
  const double phi = 0.3, axis = (R + cable_radius) * std::sin(phi), edge = 0.95 * cable_radius;
  struct Ray {
    double y;
    bool seen;
  };
  const Ray rays[] = {{axis - edge, false},      {axis, false},
                      {axis + edge, false},      {-axis, true},
                      {axis - edge / 0.9, true}, {axis + edge / 0.9, true}};
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0.6, 0, -0.8), Vec3(0.8, 0, 0.6)})
    for (const double oversize : {1.0, 5.0})
      for (const Ray& ray : rays) {
        std::vector<Module> modules = modules_at({Vec3::Zero()});
        modules[0].cable_azimuth = pi - phi;
        const Vec3 from = -10 * direction + Vec3(0, oversize * ray.y, 0);
        EXPECT_EQ(kept_share(make_model(uniform_tables(clear), modules), from, direction, oversize, 20),
                  ray.seen ? 1 : 0)
            << ray.y << " at oversize " << oversize << " along " << direction.transpose();
        modules[0].cable_azimuth = -phi;
        EXPECT_EQ(kept_share(make_model(uniform_tables(clear), modules), from, direction, oversize, 20), 1);
      }
}

// The shadow is as wide as the cable, and gone without one.
TEST_P(Effects, CableShadowFollowsTheRadius) {
  std::vector<Module> modules = modules_at({Vec3::Zero()});
  modules[0].cable_azimuth = pi;
  const Vec3 direction(1, 0, 0);
  for (const double radius : {0.0, 0.01, 0.05}) {
    ModuleAcceptance acceptance;
    acceptance.cable_radius = radius;
    const Model model = make_model(uniform_tables(clear), modules, acceptance);
    for (const double y : {0.005, 0.02, 0.04})
      EXPECT_EQ(kept_share(model, Vec3(-10, y, 0), direction, 1, 20), y < radius ? 0 : 1) << radius << y;
  }
}

TEST_P(Effects, ClockOffsetDelaysHits) {
  std::vector<Module> modules = modules_at({Vec3::Zero()});
  const PointSource source(Vec3(-10, 0, 0), 0, 100, line_at_400(), Vec3(1, 0, 0));
  const auto hits = simulate(make_model(uniform_tables(clear), modules), source, 1);
  modules[0].clock_offset = -7.5;
  const auto early = simulate(make_model(uniform_tables(clear), modules), source, 1);
  ASSERT_EQ(early.size(), hits.size());
  ASSERT_FALSE(hits.empty());
  for (std::size_t i = 0; i < hits.size(); ++i) EXPECT_NEAR(early[i].time, hits[i].time - 7.5, 1e-4);
}

// The photomultiplier looks against the up axis: acceptance (1 + cos(eta))/2 for light from all sides.
TEST_P(Effects, ModuleTiltTurnsTheAcceptance) {
  ModuleAcceptance acceptance;
  acceptance.angular = AngularAcceptance::polynomial(1, {0.5, 0.5});
  std::vector<Module> modules = modules_at({Vec3::Zero()});
  modules[0].up_axis = unit_vector(60 * degree, 25 * degree);
  const Model model = make_model(uniform_tables(clear), modules, acceptance);
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
    expect_share(kept_share(model, -10 * direction, direction), (1 + direction.dot(modules[0].up_axis)) / 2,
                 2000, "direction " + std::to_string(direction.x()) + " " + std::to_string(direction.z()));
}

// Only a cap around the lower pole sees light: of a beam along the axis what lands within sqrt(1 - c^2) R, of
// one across it what lands more than c R below the middle.
TEST_P(Effects, SurfaceAcceptanceIsACap) {
  const double cut = 0.6, rim = std::sqrt(1 - cut * cut), side = std::sqrt(0.5);
  ModuleAcceptance acceptance;
  acceptance.angular = AngularAcceptance::surface(cut);
  for (const Vec3& up : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, -side, side)})
    for (const double oversize : {1.0, 5.0}) {
      const Vec3 across = up.unitOrthogonal();
      std::vector<Module> modules = modules_at({Vec3::Zero()});
      modules[0].up_axis = up;
      const Model model = make_model(uniform_tables(clear), modules, acceptance);
      const auto kept = [&](const Vec3& direction, const Vec3& landing) {
        return kept_share(model, oversize * R * landing - 10 * direction, direction, oversize, 20);
      };
      EXPECT_EQ(kept(up, 0.98 * rim * across), 1);
      EXPECT_EQ(kept(up, 1.02 * rim * across), 0);
      EXPECT_EQ(kept(-up, Vec3::Zero()), 0);
      EXPECT_EQ(kept(across, -1.02 * cut * up), 1);
      EXPECT_EQ(kept(across, -0.98 * cut * up), 0);
      EXPECT_EQ(kept(across, 1.02 * cut * up), 0);
    }
}

// A module without high voltage sees nothing, stands in the way at nominal size, and its efficiency does not
// enter the number of photons.
TEST_P(Effects, ModulesThatAreOff) {
  std::vector<Module> modules = modules_at({Vec3(10, 0, 0), Vec3(20, 0, 0)});
  modules[0].on = false;
  modules[0].relative_efficiency = 3;
  const Model model = make_model(uniform_tables(clear), modules);
  const auto pencil = [](double photons) {
    return PointSource(Vec3::Zero(), 0, photons, line_at_400(), Vec3::UnitX());
  };
  EXPECT_EQ(run(model, pencil(1000), 1).summary.hits, 0U);
  const Run widened = run(model, pencil(25000), 5);
  EXPECT_EQ(widened.summary.propagated, 1000U);
  EXPECT_EQ(widened.hits.size(), 1000U);
  for (const SimulatedHit& hit : widened.hits) ASSERT_EQ(hit.module, 1U);
}

// Hits follow overall efficiency x curve x relative efficiency, x the ratio at the photon's wavelength for
// modules of high quantum efficiency alone. The lower half of the spectrum has the mean ratio 1.25, the upper
// one 1.35.
TEST_P(Effects, EfficienciesAndHighQeRatio) {
  ModuleAcceptance acceptance;
  acceptance.overall_efficiency = 0.7;
  acceptance.angular = AngularAcceptance::polynomial(0.8, {0.5, 0, 0.3});
  acceptance.high_qe = HighQeRatio({{300, 1}, {400, 1.5}, {500, 1.2}});
  std::vector<Module> modules = modules_at({Vec3(10, 0, 0), Vec3(20, 0, 0), Vec3(30, 0, 0)});
  modules[1].relative_efficiency = modules[2].relative_efficiency = 0.9;
  modules[2].high_qe_spectrum = true;
  const Model model = make_model(uniform_tables(clear), modules, acceptance);
  const double oversize = 5, photons = 20000, seen = photons / 2 * 0.7 * 0.5;
  const PointSource source(Vec3::Zero(), 0, photons * oversize * oversize,
                           WavelengthSpectrum({{0, 300}, {1, 500}}), Vec3::UnitX());
  std::array<std::array<double, 2>, 3> counts{};
  for (const SimulatedHit& hit : simulate(model, source, oversize))
    ++counts[hit.module][hit.wavelength > 400];
  const double expected[3][2] = {{1, 1}, {0.9, 0.9}, {0.9 * 1.25, 0.9 * 1.35}};
  for (int module = 0; module < 3; ++module)
    for (int half = 0; half < 2; ++half)
      EXPECT_NEAR(counts[module][half], seen * expected[module][half],
                  4 * std::sqrt(seen * expected[module][half]))
          << module << ' ' << half;
}

// A photon that comes back to the module which emitted it is dropped there, at nominal size: a walk of its
// own, with a sphere that swallows, says how many scatters that leaves. Without a module there are b/a.
TEST_P(Effects, TheEmittingModuleSwallowsWhatComesBack) {
  const double b = 5, a = 0.5;  // scattering into all directions alike
  std::mt19937_64 generator(3);
  std::exponential_distribution<double> exponential;
  std::uniform_real_distribution<double> uniform(-1, 1);
  constexpr int photons = 40000;
  double scatters = 0, squares = 0;
  for (int i = 0; i < photons; ++i) {
    Vec3 place = R * Vec3::UnitZ(), direction = Vec3::UnitZ();
    double left = exponential(generator) / a, count = 0;
    for (;;) {
      const double length = exponential(generator) / b, closest = -place.dot(direction);
      const double half_chord_squared = R * R - place.squaredNorm() + closest * closest;
      const bool swallowed = count > 0 && closest > 0 && half_chord_squared > 0 &&
                             closest - std::sqrt(half_chord_squared) < std::min(length, left);
      if (swallowed || length > left) break;
      left -= length;
      place += length * direction;
      direction = unit_vector(std::acos(uniform(generator)), pi * uniform(generator));
      ++count;
    }
    scatters += count / photons;
    squares += count * count / photons;
  }

  const Model model =
      make_model(uniform_tables({1 / b, 1 / a, 0, 0}), std::vector<Vec3>{Vec3::Zero(), Vec3(200, 0, 0)});
  FlasherSettings settings;
  settings.isotropic = true;
  for (const double oversize : {1.0, 4.0}) {
    settings.photons = photons * oversize * oversize;
    const FlasherSource flasher(*model.detector, {1, 1}, settings, line_at_400());
    const double found = static_cast<double>(run(model, flasher, oversize).summary.scatters) / photons;
    EXPECT_NEAR(found, scatters, 4 * std::sqrt(2 * (squares - scatters * scatters) / photons)) << oversize;
  }
  const PointSource elsewhere(Vec3(100, 0, 0), 0, photons, line_at_400());
  const double free = static_cast<double>(run(model, elsewhere, 1).summary.scatters) / photons;
  EXPECT_NEAR(free, b / a, 4 * std::sqrt(b / a * (1 + b / a) / photons));
  EXPECT_LT(scatters, 0.9 * free);
}

// --- coefficients: what is left of a pencil after a distance, exp(-(b + a) d) ---

struct Coefficients {
  const char* name;
  double wavelength, depth;  // [nm], of the pencil [m]
  double scattering;         // effective [1/m], by hand
  double absorption;         // [1/m], by hand
  void (*change)(IceTables&);
};

// alpha = kappa = 1, A = 0.5 1/m, B = 1000 nm, delta-tau = -20 K, 0.02 and 0.05 1/m in the table.
IceTables coloured_tables() {
  IceTables tables = uniform_tables({50, 20});
  tables.wavelength = {1, 1, 0.5, 1000, {}, {}, {}};
  for (IceLayerRow& row : tables.layers) row.temperature_difference = -20;
  return tables;
}

// Constant widths: S = (0.03^2 + 0.04^2)/2 = 0.00125 1/m at strength 1, 0.01 1/m at 8.
void add_birefringence(IceTables& tables) {
  BirefringenceNumbers numbers;
  numbers.sigma_x = {0.03, 0, 1, 1};
  numbers.sigma_y = {0.04, 0, 1, 1};
  tables.configuration.birefringence = numbers;
  for (IceLayerRow& row : tables.layers) row.birefringence_strength = 8;
}

const double thermal_300 = 0.5 * std::exp(-1000.0 / 300) * 0.8;
const double thermal_400 = 0.5 * std::exp(-1000.0 / 400) * 0.8;
const double thermal_500 = 0.5 * std::exp(-1000.0 / 500) * 0.8;
const double dust_300 = 0.05 * 4 / 3, dust_500 = 0.05 * 4 / 5;

const Coefficients coefficients[] = {
    {"by_wavelength", 500, 1950, 0.02 * 4 / 5, dust_500 + thermal_500, [](IceTables&) {}},
    {"version_0", 300, 1950, 0.02 * 4 / 3 - 0.01, dust_300 + thermal_300, add_birefringence},
    {"version_10", 300, 1950, 0.02 * 4 / 3, dust_300 + thermal_300,
     [](IceTables& t) {
       add_birefringence(t);
       t.version = 10;
     }},
    {"version_20", 300, 1950, (0.02 - 0.01) * 4 / 3, dust_300 + thermal_300 - thermal_400 * 4 / 3,
     [](IceTables& t) {
       add_birefringence(t);
       t.version = 20;
     }},
    {"bubbles", 300, 1340, 0.02 * 4 / 3 + 11.7 * (1 - 1340.0 / 1350) * (1 - 1340.0 / 1400),
     dust_300 + thermal_300,
     [](IceTables& t) {
       t.bubbles = Bubbles{11.7, 1350, 1400};
     }},
    {"below_the_bubbles", 300, 1360, 0.02 * 4 / 3, dust_300 + thermal_300,
     [](IceTables& t) {
       t.bubbles = Bubbles{11.7, 1350, 1400};
     }},
    {"before_2013", 500, 1950, 0.02 * 4 / 5, (2000 * 0.05 - 60) / 400 * 4 / 5 + thermal_500,
     [](IceTables& t) { t.wavelength.D = 2000, t.wavelength.E = -60; }},
};

TEST_P(Effects, CoefficientsByWavelengthVersionBubblesAndDust) {
  const double distance = 8, photons = 50000;
  for (const Coefficients& scene : coefficients) {
    IceTables tables = coloured_tables();
    scene.change(tables);
    const double z = origin_depth - scene.depth;
    const Model model = make_model(tables, {Vec3(distance + R, 0, z)});
    const PointSource pencil(Vec3(0, 0, z), 0, photons, line_at(scene.wavelength), Vec3::UnitX());
    const auto hits = simulate(model, pencil, 1);
    const auto straight = std::count_if(hits.begin(), hits.end(), [](const SimulatedHit& hit) {
      return 1 - hit.direction.x() < 1e-6f;  // never scattered
    });
    const double expected = std::exp(-(scene.scattering / (1 - 0.9) + scene.absorption) * distance);
    expect_share(static_cast<double>(straight) / photons, expected, photons, scene.name);
  }
}

// --- anisotropy of absorption, along the flow, across it and up ---

const double flow_azimuth = 40 * degree;
const std::array<Vec3, 3> flow_axes{unit_vector(pi / 2, flow_azimuth),
                                    unit_vector(pi / 2, flow_azimuth + pi / 2), Vec3::UnitZ()};

class AbsorptionAlongAxes : public Effects {
 protected:
  // The share of a pencil that is left after 30 m where unscattered light lives 25 m on average.
  double left_along(const Vec3& direction, IceTables tables) const {
    tables.configuration.flow_azimuth_deg = 40;
    return kept_share(make_model(std::move(tables), {(30 + R) * direction}), Vec3::Zero(), direction, 1,
                      photons);
  }
  static constexpr int photons = 20000;
};

// (k1, k2, kz) that are not normalised: absorption is divided by e^k along each axis, and off the axes by the
// root of the sum of squares.
TEST_P(AbsorptionAlongAxes, FollowsThreeFactors) {
  IceTables tables = uniform_tables({1e9, 25});
  const double k[] = {-0.2, 0.3, 0.5};
  tables.configuration.absorption_anisotropy = IceConfiguration::AbsorptionAnisotropy{k[0], k[1], k[2]};
  for (int i = 0; i < 3; ++i)
    expect_share(left_along(flow_axes[i], tables), std::exp(-30.0 / 25 * std::exp(-k[i])), photons,
                 "axis " + std::to_string(i));
  const double root = std::sqrt((std::exp(2 * k[0]) + std::exp(2 * k[2])) / 2);
  expect_share(left_along((flow_axes[0] + flow_axes[2]).normalized(), tables), std::exp(-30.0 / 25 / root),
               photons, "between flow and vertical");
}

// The old form for k1 = 0.3, k2 = -0.1, k3 = -0.2, worked out by hand: along axis i it is
// (e^(2 k_i) (sum of e^(-2 k_j) over the other two)/2)^f.
TEST_P(AbsorptionAlongAxes, OldFormFollowsTheScatteringAnisotropy) {
  IceTables tables = uniform_tables({1e9, 25});
  tables.configuration.k1 = -0.3;  // the layers' own numbers override the directory's
  for (IceLayerRow& row : tables.layers) row.k1 = 0.3, row.k2 = -0.1;
  const double factor[] = {std::exp(0.6) * (std::exp(0.2) + std::exp(0.4)) / 2,
                           std::exp(-0.2) * (std::exp(-0.6) + std::exp(0.4)) / 2,
                           std::exp(-0.4) * (std::exp(-0.6) + std::exp(0.2)) / 2};
  for (const double f : {1.0, 0.5, 0.0}) {
    tables.configuration.old_absorption_scaling = f;
    for (int i = 0; i < 3; ++i)
      expect_share(left_along(flow_axes[i], tables), std::exp(-30.0 / 25 * std::pow(factor[i], f)), photons,
                   "axis " + std::to_string(i) + ", f = " + std::to_string(f));
  }
}

// --- ice that only deflects: each scatter turns a photon by 0.014 rad, and crystals act at each ---

constexpr double forward_g = 0.9999, forward_absorption_length = 10;

IceTables forward_tables(double scatters_per_metre) {
  IceTables tables =
      uniform_tables({1 / (scatters_per_metre * (1 - forward_g)), forward_absorption_length, 1, forward_g});
  tables.version = 10;
  return tables;
}

// Scattering in the stretched space and back leaves a direction that is not scattered as it was. Were one of
// the two maps dropped, every scatter would turn it by a tenth.
TEST_P(Effects, StretchingAndBackLeavesTheDirection) {
  IceTables tables = forward_tables(4);
  tables.configuration.flow_azimuth_deg = 40;
  tables.configuration.old_absorption_scaling = 0;
  for (IceLayerRow& row : tables.layers) row.k1 = 0.2, row.k2 = -0.1;
  const Vec3 direction = (flow_axes[0] + flow_axes[1] + flow_axes[2]).normalized();
  // 40 scatters: 0.09 rad, and 0.5 m after 10 m (rms); the widened module is 3.3 m wide.
  const double share = kept_share(make_model(tables, {(10 + R) * direction}), Vec3::Zero(), direction, 20);
  expect_share(share, std::exp(-10 / forward_absorption_length), 2000, "straight on");
}

struct Bend {
  double mean_x = 0, variance_x = 0, variance_y = 0;  // of the direction, x towards the nearer flow [rad]
  double offset_x = 0, offset_x_error = 0;            // of the place [m]
  double photons = 0;
};

class Crystals : public Effects {
 protected:
  static constexpr double distance = 6, oversize = 30;
  static constexpr int photons = 8000;

  // How a horizontal pencil at this depth, at 45 degrees to the flow along the x axis, has been turned and
  // displaced after `distance`. `side`: -1 where the nearer flow direction is -x.
  Bend bend(const IceTables& tables, double depth, double side = 1) const {
    const Vec3 n(side * std::sqrt(0.5), std::sqrt(0.5), 0), flow(side, 0, 0);
    const Vec3 x = (flow - flow.dot(n) * n).normalized(), y = n.cross(x);
    const Vec3 from(0, 0, origin_depth - depth), centre = from + (distance + R) * n;
    const Model model = make_model(tables, {centre});
    const PointSource pencil(from, 0, photons * oversize * oversize, line_at_400(), n);
    Bend result;
    double square_x = 0, square_y = 0, square_offset = 0, mean_y = 0;
    std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
    for (const SimulatedHit& hit : simulate(model, pencil, oversize)) {
      if (hit.photon == last) continue;  // the first meeting counts
      last = hit.photon;
      const Vec3 along = hit.direction.cast<double>(), inward = R * hit.inward.cast<double>();
      const double angle_x = std::atan2(along.dot(x), along.dot(n)),
                   angle_y = std::atan2(along.dot(y), along.dot(n));
      const double half_chord = inward.dot(along);
      const Vec3 landing = centre - oversize * (inward - half_chord * along) - half_chord * along;
      const double offset = (landing - from).dot(x);
      result.photons += 1;
      result.mean_x += angle_x, mean_y += angle_y, result.offset_x += offset;
      square_x += angle_x * angle_x, square_y += angle_y * angle_y, square_offset += offset * offset;
    }
    const double count = result.photons;
    result.mean_x /= count, result.offset_x /= count, mean_y /= count;
    result.variance_x = square_x / count - result.mean_x * result.mean_x;
    result.variance_y = square_y / count - mean_y * mean_y;
    result.offset_x_error = std::sqrt((square_offset / count - std::pow(result.offset_x, 2)) / count);
    EXPECT_NEAR(mean_y, 0, 4 * std::sqrt(result.variance_y / count));
    EXPECT_NEAR(count / photons, std::exp(-distance / forward_absorption_length), 0.05);
    return result;
  }

  // Widths per root metre, and a mean turn of 0.0025 pi per metre at every angle but 0 and 90 degrees.
  static BirefringenceNumbers constant_numbers() {
    BirefringenceNumbers numbers;
    numbers.sigma_x = {0.03, 0, 1, 1};
    numbers.sigma_y = {0.05, 0, 1, 1};
    numbers.mean_x = {0.005, 0, 0, 1e6};
    return numbers;
  }
  static constexpr double mean_turn = 0.005 * pi / 2;
};

// Each layer's own strengths A (variances A L, mean A B L) and B. Crystals act up to the last scatter before
// the module, 1/b before it on average; the scatters themselves add b (1 - g) per metre and axis.
TEST_P(Crystals, TurnByTheStrengthsOfTheirLayer) {
  const double b = 4, path = distance - 1 / b;
  IceTables tables = forward_tables(b);
  tables.configuration.birefringence = constant_numbers();
  struct Layer {
    double depth, A, B;
  };
  const Layer layers[] = {{1900, 1, 2}, {1950, 3, 0.5}, {2000, 0, 1}, {2050, 2, 0}};
  for (IceLayerRow& row : tables.layers)
    for (const Layer& layer : layers)
      if (std::abs(row.depth - layer.depth) <= 20)
        row.birefringence_strength = layer.A, row.deflection_strength = layer.B;
  for (const Layer& layer : layers)
    for (const double side : {1.0, -1.0}) {
      if (side < 0 && layer.depth != 1950) continue;
      const Bend found = bend(tables, layer.depth, side);
      const double noise = b * (1 - forward_g) * path;
      const double turn = layer.A * layer.B * mean_turn * path;
      const double variance_x = layer.A * 0.03 * 0.03 * path + noise;
      const double variance_y = layer.A * 0.05 * 0.05 * path + noise;
      // Curvature of the sphere: of the order of the largest variance, 0.05, in every moment.
      EXPECT_NEAR(found.mean_x, turn, 4 * std::sqrt(variance_x / found.photons) + 0.05 * turn) << layer.depth;
      const double error = 4 * std::sqrt(2 / found.photons) + 0.07;
      EXPECT_NEAR(found.variance_x, variance_x, error * variance_x) << layer.depth;
      EXPECT_NEAR(found.variance_y, variance_y, error * variance_y) << layer.depth;
    }
}

// A turn of m l at a segment's end and a displacement of m l^2/2 there make the path bend evenly: after d,
// with the last scatter l before, the photon is m (d^2 - l^2)/2 aside, <l^2> = (2/b^2)(1 - (1 + b d) exp(-b
// d)). Without displacement it is less by m/2 times the sum of the other segments' l^2, a third of it here.
TEST_P(Crystals, DisplaceWhatTheyTurn) {
  const double b = 0.5, bd = b * distance;
  IceTables tables = forward_tables(b);
  tables.configuration.birefringence = constant_numbers();
  tables.configuration.birefringence->diffusion = false;
  for (IceLayerRow& row : tables.layers) row.birefringence_strength = 2;
  const double last_squared = 2 / (b * b) * (1 - (1 + bd) * std::exp(-bd));
  const double all_squared = 2 / (b * b) * (bd - 1 + std::exp(-bd));  // of all segments, the last included
  for (const bool displacement : {true, false}) {
    tables.configuration.birefringence->displacement = displacement;
    const Bend found = bend(tables, 1950);
    const double squared = displacement ? last_squared : all_squared;
    const double expected = mean_turn * 2 * (distance * distance - squared) / 2;
    EXPECT_NEAR(found.offset_x, expected, 4 * found.offset_x_error + 0.01 * expected) << displacement;
  }
}

// --- tilt: a pencil straight up meets dark ice at a height that the shift moves ---

class TiltedLayers : public Effects {
 protected:
  static constexpr double source_z = -20, module_z = 90, absorption = 0.05, darkest_depth = 1945;
  static constexpr int photons = 20000;
  // Of the source's depth in a table that begins at 1900 m.
  static double depth_share(double table_step) { return (origin_depth - source_z - 1900) / table_step; }

  // The light that is left over this place is that of a dark region raised by `shift`.
  void expect_shift(IceTables tables, const Vec3& foot, double shift, const std::string& what) const {
    for (IceLayerRow& row : tables.layers)
      if (row.depth < darkest_depth) row.dust_absorption = absorption;
    const Model model =
        make_model(tables, {foot + Vec3(0, 0, module_z), Vec3(0, 0, 700), Vec3(900, 900, 700)});
    const double dark = module_z - R - (origin_depth - darkest_depth + shift);
    expect_share(kept_share(model, foot + Vec3(0, 0, source_z), Vec3::UnitZ(), 1, photons),
                 std::exp(-absorption * dark), photons, what);
  }
};

// 1D: linear between the columns and the depths, and beyond them; the shift is that at the start of the
// segment, where the source is. String 2 stands at the origin.
TEST_P(TiltedLayers, AlongOneAxis) {
  IceTables tables = uniform_tables({1e9, 1e9});
  tables.tilt_lines = TiltLines{{1, 2}, {-30, 0}, {1900, 1950}, {{-9, 0}, {-12, 0}}};
  const double slope = 0.3 + 0.1 * depth_share(50);  // beyond the table's depths
  for (const double along : {-50.0, -20.0, 0.0, 60.0})
    expect_shift(tables, along * unit_vector(pi / 2, 225 * degree), slope * along,
                 "at " + std::to_string(along) + " m");
}

// 2D, here with axes along x and y and steps of 100 m: barycentric in the triangles on both sides of a cell's
// diagonal, the border's value outside, and before 1D where both are there.
TEST_P(TiltedLayers, OnAMap) {
  IceTables tables = uniform_tables({1e9, 1e9});
  const std::vector<double> low{0, 10, 24, -8, 2, 30};  // (0,0) (1,0) (2,0) (0,1) (1,1) (2,1)
  std::vector<double> high = low;
  for (double& shift : high) shift += 4;
  tables.tilt_map = TiltMap{{0, -100, 100, 3, 3}, {90, 0, 100, 2, 3}, {1900, 2000}, {low, high}};
  tables.tilt_lines = TiltLines{{1, 2}, {-100, 0}, {1900, 2000}, {{60, 60}, {60, 60}}};
  const double deeper = 4 * depth_share(100);
  expect_shift(tables, Vec3(50, 25, 0), 0.5 * 10 + 0.25 * 24 + 0.25 * 30 + deeper, "below the diagonal");
  expect_shift(tables, Vec3(-75, 50, 0), 0.5 * 0 + 0.25 * -8 + 0.25 * 2 + deeper, "above the diagonal");
  expect_shift(tables, Vec3(400, 50, 0), (24 + 30) / 2.0 + deeper, "beyond the border");
  expect_shift(tables, Vec3(-300, 500, 0), -8 + deeper, "beyond the corner");
}

FLOE_INSTANTIATE_ENGINES(Effects);
FLOE_INSTANTIATE_ENGINES(AbsorptionAlongAxes);
FLOE_INSTANTIATE_ENGINES(Crystals);
FLOE_INSTANTIATE_ENGINES(TiltedLayers);

}  // namespace
}  // namespace floe
