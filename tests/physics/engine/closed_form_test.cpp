// The whole engine on scenes with closed-form answers.
#include <gtest/gtest.h>

#include <cmath>

#include "data/base/constants.h"
#include "propagation/engine/anisotropy.h"
#include "propagation/engine/simulator.h"
#include "propagation/sources/flasher.h"
#include "tests/physics/engine/test_scenes.h"

namespace floe {
namespace {

using test::line_at_400;
using test::make_model;
using test::uniform_tables;

class ClosedForm : public test::BothEngines {};

// Without scattering, isotropic light reaches a sphere of radius R at distance d with probability
// (1 - sqrt(1 - (R/d)^2))/2, dimmed by absorption, after d/v.
TEST_P(ClosedForm, BallisticLightFollowsTheSolidAngle) {
  const double distance = 20, absorption_length = 30;
  const Model model = make_model(uniform_tables({1e9, absorption_length}), {Vec3(distance, 0, 0)});
  const double photons = light(4e6);
  const PointSource source(Vec3::Zero(), 100, photons, line_at_400());
  const auto hits = simulate(model, source, 1);
  const double R = module_radius;
  const double solid = (1 - std::sqrt(1 - R * R / distance / distance)) / 2;
  const double expected = photons * solid * std::exp(-distance / absorption_length);
  EXPECT_NEAR(static_cast<double>(hits.size()), expected, 4 * std::sqrt(expected));
  for (const SimulatedHit& hit : hits) {
    const double flown = (hit.time - 100) * speed_of_light / group_index(400);
    ASSERT_GE(flown, distance - R - 1e-3);
    ASSERT_LE(flown, std::sqrt(distance * distance - R * R) + 1e-3);
  }
}

// The widened module sees X^2 times the photons, of which 1/X^2 are emitted: the same expectation.
TEST_P(ClosedForm, OversizeKeepsTheExpectation) {
  const double distance = 40;
  const Model model = make_model(uniform_tables({1e9, 50}), {Vec3(0, distance, 0)});
  const double photons = light(5e8), expected = photons * module_radius * module_radius /
                                                (4 * distance * distance) * std::exp(-distance / 50);
  for (const double oversize : {5.0, 10.0}) {
    const auto hits = simulate(model, PointSource(Vec3::Zero(), 0, photons, line_at_400()), oversize);
    // A wide disc at a finite distance: the solid angle is smaller by (3/4)(R/d)^2, 0.01 at most here.
    const double wide = 0.75 * std::pow(oversize * module_radius / distance, 2);
    EXPECT_NEAR(static_cast<double>(hits.size()), expected, 4 * std::sqrt(expected) + wide * expected);
  }
}

// A beam straight up through layers of different absorption: exp(-sum a_i d_i).
TEST_P(ClosedForm, LayersAddTheirOpticalDepths) {
  IceTables tables = uniform_tables({1e9, 1e9});
  for (std::size_t i = 0; i < tables.layers.size(); ++i)
    tables.layers[i].dust_absorption = 0.001 * static_cast<double>(1 + i % 7);
  // From the middle of the layer centred at 2050 m depth to the middle of the one at 1950 m.
  const double bottom = origin_depth - 2050, top = origin_depth - 1950;
  double depth = 0;
  for (const IceLayerRow& row : tables.layers)
    if (row.depth > 1950 && row.depth < 2050) depth += 10 * row.dust_absorption;
  for (const IceLayerRow& row : tables.layers)
    if (row.depth == 1950 || row.depth == 2050) depth += 5 * row.dust_absorption;
  const double photons = 200000, flight = top - bottom - module_radius;
  for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(0.6, 0, 0.8)}) {
    const Model model = make_model(tables, {Vec3(0, 0, bottom) + direction / direction.z() * (top - bottom)});
    const PointSource source(Vec3(0, 0, bottom), 0, photons, line_at_400(), direction);
    const auto hits = simulate(model, source, 1);
    // The path ends on the module's surface, in the layer at 1950 m.
    const double last = tables.layers[95].dust_absorption;
    const double expected = photons * std::exp(-depth / direction.z() + module_radius * last);
    EXPECT_NEAR(static_cast<double>(hits.size()), expected, 4 * std::sqrt(expected)) << flight;
  }
}

// Absorption along and across the flow differs by the factors of its anisotropy.
TEST_P(ClosedForm, AbsorptionDependsOnTheDirection) {
  IceTables tables = uniform_tables({1e9, 25});
  tables.configuration.flow_azimuth_deg = 130;
  tables.configuration.absorption_anisotropy = IceConfiguration::AbsorptionAnisotropy{0.6, -0.3, -0.3};
  const double distance = 30, path = distance - module_radius, photons = 100000;
  const Vec3 flow = unit_vector(pi / 2, 130 * degree), tilt = unit_vector(pi / 2, 220 * degree);
  for (const auto& [direction, factor] : {std::pair(flow, 1 / 1.695), std::pair(tilt, 1 / 0.689)}) {
    const Model model = make_model(tables, {distance * direction});
    const auto hits = simulate(model, PointSource(Vec3::Zero(), 0, photons, line_at_400(), direction), 1);
    const double expected = photons * std::exp(-factor * path / 25);
    EXPECT_NEAR(static_cast<double>(hits.size()), expected, 4 * std::sqrt(expected) + 1e-3 * expected);
  }
}

// Tilted layers: a slab of dark ice that rises along 225 deg is met at the shifted height.
TEST_P(ClosedForm, TiltMovesTheLayers) {
  IceTables tables = uniform_tables({1e9, 1e9});
  for (IceLayerRow& row : tables.layers)
    if (row.depth < origin_depth) row.dust_absorption = 0.05;  // dark above z = 3.07 + shift
  TiltLines tilt;
  tilt.strings = {1, 2};
  tilt.distances = {0, 100};
  tilt.depths = {1000, 2000};
  tilt.shifts = {{0, 40}, {0, 40}};
  tables.tilt_lines = tilt;
  const double boundary = origin_depth - (tables.layers[94].depth + 5);
  const double photons = 100000;
  for (const double along : {0.0, 50.0}) {
    const Vec3 foot = along * unit_vector(pi / 2, 225 * degree);
    const Model model = make_model(tables, {Vec3(0, 0, 500), foot + Vec3(0, 0, 90)});
    const PointSource source(foot + Vec3(0, 0, -20), 0, photons, line_at_400(), Vec3::UnitZ());
    const auto hits = simulate(model, source, 1);
    const double dark = 90 - module_radius - (boundary + 0.4 * along);
    const double expected = photons * std::exp(-0.05 * dark);
    EXPECT_NEAR(static_cast<double>(hits.size()), expected, 4 * std::sqrt(expected) + 1e-3 * expected)
        << along;
  }
}

// Far from an isotropic source in scattering ice the fluence is that of diffusion theory,
// exp(-r/L)/(4 pi D r), L^2 = D/a, D = 1/(3 (b_e + a)); a module that lets photons pass counts fluence
// times its cross-section.
TEST_P(ClosedForm, ScatteredLightDiffuses) {
  const double scattering_length = 2, absorption_length = 400;
  const double a = 1 / absorption_length, D = 1 / (3 * (1 / scattering_length + a)), L = std::sqrt(D / a);
  std::vector<Vec3> positions;
  for (const double r : {25.0, 40.0})
    for (int i = 0; i < 12; ++i)
      positions.push_back(r * unit_vector(pi / 2, (30 * i + (r > 30 ? 15 : 0)) * degree));
  const Model model = make_model(uniform_tables({scattering_length, absorption_length}), positions);
  const double photons = light(3e6), oversize = 5;
  const auto hits = simulate(model, PointSource(Vec3::Zero(), 0, photons, line_at_400()), oversize);
  double near = 0, far = 0;
  for (const SimulatedHit& hit : hits) (hit.module < 12 ? near : far) += 1;
  const auto expected = [&](double r) {
    return 12 * photons * pi * module_radius * module_radius * std::exp(-r / L) / (4 * pi * D * r);
  };
  // Counts are over-dispersed where the mean free path is comparable to the widened module (factor of 3
  // in variance at most); diffusion theory itself holds to the order of (b_e-length/L)^2, 0.6%.
  EXPECT_NEAR(near, expected(25), 4 * std::sqrt(3 * near) + 0.02 * near);
  EXPECT_NEAR(far, expected(40), 4 * std::sqrt(3 * far) + 0.02 * far);
}

// A flasher does not see its own light, and a module of nominal size ends what it meets.
TEST_P(ClosedForm, TheFlashingModuleIsBlindToItself) {
  const Model model = make_model(uniform_tables({1, 50}), {Vec3::Zero(), Vec3(2, 0, 0)});
  FlasherSettings settings;
  settings.photons = light(1e5);
  settings.isotropic = true;
  const FlasherSource source(*model.detector, {1, 1}, settings, line_at_400());
  for (const double oversize : {1.0, 3.0}) {
    const auto hits = simulate(model, source, oversize);
    EXPECT_GT(hits.size(), 20U);
    for (const SimulatedHit& hit : hits) ASSERT_EQ(hit.module, 1U);
  }
}

FLOE_INSTANTIATE_ENGINES(ClosedForm);

TEST(OldAbsorptionAnisotropy, IsNothingInIsotropicIce) {
  EXPECT_NEAR(old_absorption_factor(0.0, 0.0, 1.0, 0.6, 0.0, 0.8), 1, 1e-12);
}

}  // namespace
}  // namespace floe
