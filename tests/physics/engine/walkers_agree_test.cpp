// The vector engine against the plain walk: the same photons, one by one.
#include <gtest/gtest.h>

#include <map>

#include "propagation/engine/walker.h"
#include "propagation/sources/cascade.h"
#include "propagation/sources/flasher.h"

namespace floe {
namespace {

struct Scene {
  const char* name;
  double oversize;
  void (*change)(IceTables&);
};
void PrintTo(const Scene& scene, std::ostream* out) {
  *out << scene.name;
}

class WalkersAgree : public ::testing::TestWithParam<Scene> {};

Model built_in_model(const Scene& scene) {
  IceTables tables = south_pole_ice();
  scene.change(tables);
  Model model;
  model.detector = std::make_shared<Detector>(ic86_detector());
  model.ice = std::make_shared<IceModel>(std::move(tables), *model.detector);
  model.acceptance = builtin_acceptance();
  return model;
}

TEST_P(WalkersAgree, PhotonByPhoton) {
  const Model model = built_in_model(GetParam());
  Cascade cascade;
  cascade.position = {20, -40, -300};
  cascade.zenith = 1.2;
  cascade.azimuth = 2.3;
  cascade.energy = 1000;
  const CascadeSource source(cascade, model.acceptance.spectrum);
  const PhotonBatch batch{7, 3, 12345, 60000};
  std::vector<SimulatedHit> plain, vector;
  const WalkerCounts plain_counts = make_plain_walker(model, GetParam().oversize)->walk(source, batch, plain);
  const WalkerCounts vector_counts =
      make_vector_walker(model, GetParam().oversize)->walk(source, batch, vector);

  EXPECT_EQ(plain_counts.walked, vector_counts.walked);
  const auto scatters = static_cast<double>(plain_counts.scatters);
  EXPECT_NEAR(scatters, static_cast<double>(vector_counts.scatters), 1e-3 * scatters);
  ASSERT_GT(plain.size(), 200U);

  // Rounding differs between the engines and grows along a path: a photon in some hundred meets a layer's
  // boundary or a module's rim on the other side. All others agree closely.
  std::map<std::pair<std::uint64_t, std::uint32_t>, const SimulatedHit*> by_photon;
  for (const SimulatedHit& hit : plain) by_photon.emplace(std::pair(hit.photon, hit.module), &hit);
  int agree = 0;
  for (const SimulatedHit& hit : vector) {
    const auto found = by_photon.find({hit.photon, hit.module});
    if (found == by_photon.end()) continue;
    const SimulatedHit& same = *found->second;
    agree += std::abs(same.time - hit.time) < 0.1 && (same.direction - hit.direction).norm() < 0.01 &&
             (same.inward - hit.inward).norm() < 0.05 && same.wavelength == hit.wavelength;
  }
  const double all = static_cast<double>(std::max(plain.size(), vector.size()));
  EXPECT_GT(agree, 0.95 * all);
  EXPECT_NEAR(static_cast<double>(plain.size()), static_cast<double>(vector.size()), 0.01 * all + 2);
}

const Scene scenes[] = {
    {"south_pole", 16, [](IceTables&) {}},
    {"twice_the_size", 8, [](IceTables&) {}},
    {"no_birefringence", 16, [](IceTables& t) { t.configuration.birefringence.reset(); }},
    {"no_displacement", 16, [](IceTables& t) { t.configuration.birefringence->displacement = false; }},
    {"no_deflection", 16, [](IceTables& t) { t.configuration.birefringence->deflection = false; }},
    {"no_diffusion", 16, [](IceTables& t) { t.configuration.birefringence->diffusion = false; }},
    {"scattering_anisotropy", 16,
     [](IceTables& t) {
       for (IceLayerRow& row : t.layers) row.k1 = 0.08, row.k2 = -0.04;
       t.configuration.old_absorption_scaling = 1;
     }},
    {"tilted", 16,
     [](IceTables& t) {
       TiltLines tilt;
       tilt.strings = {36, 1};
       tilt.distances = {0, 500};
       tilt.depths = {1200, 2400};
       tilt.shifts = {{-10, 60}, {5, -30}};
       t.tilt_lines = tilt;
     }},
};
INSTANTIATE_TEST_SUITE_P(Scenes, WalkersAgree, ::testing::ValuesIn(scenes),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace floe
