// What earlier versions gave, so that a change of it is a decision: random streams (a seed named in a paper
// must go on meaning the same photons), the built-in ice and detector, a simulation's hits.
#include <gtest/gtest.h>

#include "propagation/engine/random.h"
#include "propagation/engine/simulator.h"
#include "propagation/sources/cascade.h"

namespace floe {
namespace {

TEST(Unchanged, RandomStreams) {
  RandomStream random(1, 2, 3);
  const std::uint32_t expected[] = {3445296415U, 1607581443U, 1491693603U, 2515699678U};
  for (const std::uint32_t value : expected) EXPECT_EQ(random.bits(), value);
}

TEST(Unchanged, BuiltInIceAndDetector) {
  const Model model = load_model({});
  EXPECT_EQ(model.ice->hash(), "da0b49324404d24d3ca3cff496c8eb39");
  EXPECT_EQ(model.detector->hash(), "dec0c8a37efd4660fd905ad00924f2ea");
}

TEST(Unchanged, HitsOfASimulation) {
  const Model model = load_model({});
  Cascade cascade;
  cascade.position = {20, -40, -300};
  cascade.zenith = 70 * degree;
  cascade.azimuth = 130 * degree;
  cascade.energy = 500;
  std::vector<SimulatedHit> hits;
  Simulator(model, 5).run(CascadeSource(cascade, model.acceptance.spectrum), {},
                          [&](std::span<const SimulatedHit> portion) {
                            hits.insert(hits.end(), portion.begin(), portion.end());
                          });
  // Processors round differently: a few photons may end elsewhere.
  constexpr double count = 1072.0;
  EXPECT_NEAR(static_cast<double>(hits.size()), count, 0.01 * count);
  double time = 0;
  for (const SimulatedHit& hit : hits) time += hit.time / static_cast<double>(hits.size());
  constexpr double mean_time = 503.2;  // [ns]
  EXPECT_NEAR(time, mean_time, 0.02 * mean_time);
}

}  // namespace
}  // namespace floe
