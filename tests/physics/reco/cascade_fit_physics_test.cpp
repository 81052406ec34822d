// The direct fit on propagated light: finds its own cascades, and tells the right ice from the wrong one.
#include <gtest/gtest.h>

#include "propagation/engine/simulator.h"
#include "reco/compare.h"

namespace floe {
namespace {

Event simulate(const Model& model, const CascadeParameters& truth, std::uint64_t seed) {
  const Simulator simulator(model, 5);
  const CascadeSource source(to_cascade(truth, CascadeKind::electron), model.acceptance.spectrum);
  Event event;
  event.id = "simulated";
  SimulationOptions options;
  options.seed = seed;
  simulator.run(source, options, [&](std::span<const SimulatedHit> hits) {
    for (const SimulatedHit& hit : hits) event.hits.push_back(to_hit(hit, *model.detector));
  });
  return event;
}

TEST(CascadeFitPhysics, FindsASimulatedCascadeAndTheIceItWasIn) {
  const Model right = load_model({});
  ModelRequest request;
  request.without = {"birefringence"};
  const Model wrong = load_model(request);
  const CascadeParameters truth{{30, -50, -330}, 250, 65 * degree, 220 * degree, 2e4};
  const Event event = simulate(right, truth, 2024);

  FitOptions options;
  options.effort = 0.2;
  const ModelComparison result = compare_models(right, wrong, event, options);
  const CascadeFit& fit = result.fits[0];
  ASSERT_TRUE(result.usable()) << describe(fit) << describe(result.fits[1]);
  EXPECT_LT(distance_between(fit.cascade, truth), 2) << describe(fit);
  EXPECT_LT(angle_between(fit.cascade, truth), 6 * degree) << describe(fit);
  EXPECT_NEAR(fit.cascade.time, truth.time, 8) << describe(fit);
  EXPECT_NEAR(fit.cascade.energy / truth.energy, 1, 0.06) << describe(fit);
  EXPECT_GT(result.delta_neg_llh, 2 * result.delta_neg_llh_error);
}

}  // namespace
}  // namespace floe
