// What judges of the weights may take from them.
#include "reco/direct_fit/score_weights.h"

#include <gtest/gtest.h>

#include <vector>

#include "reco/direct_fit/arrival_bins.h"
#include "reco/direct_fit/calibration_stages.h"
#include "reco/event_data.h"
#include "tests/unit/reco/toy_light.h"

namespace floe {
namespace {

constexpr PlaceErrors errors{0.4, 1.5 * degree};
constexpr double oversize = 5;

// Two metres from a bright module, where the emulator is off by more than much light leaves open.
struct NextToModule {
  ToyLight light{3};
  CascadeParameters truth{light.model().detector->modules()[1500].position + Vec3(1.5, 1, 0.9), 100, 1.2, 2.0,
                          1e5};
  EventData measured{*light.model().detector, light.draw(truth, 77777)};
  LocalFrame frame{light_centre(truth, CascadeKind::electron)};
  MeanIce ice{*light.model().ice};
  CalibrationStages stages = calibration_stages(measured, frame.origin(), errors, 1, oversize);

  // Simulations of so many events together.
  std::vector<LightSample> simulate(Stage stage, double events, std::uint64_t draw) {
    stage.photons = events * light.photons_per_cascade(truth, stage.oversize);
    std::vector<LightSample> samples;
    for (const LightRequest& request :
         design_requests(frame, stage, CascadeKind::electron, 3, draw, 100 * draw))
      samples.push_back(light.sample(request));
    return samples;
  }
};

std::vector<const LightSample*> pointers(const std::vector<LightSample>& samples) {
  std::vector<const LightSample*> result;
  for (const LightSample& sample : samples) result.push_back(&sample);
  return result;
}

// Variances of the sums, which are the information of each number if weights are perfect.
Vector7 variances(NextToModule& scene, const EventData& data, const Emulator& emulator, double events) {
  const std::vector<LightSample> judges = scene.simulate(scene.stages.narrow, events, 7);
  const ScoreWeights weights(data, emulator, 2 * events, pointers(judges), 0.1);
  return weights.poisson_variance().diagonal();
}

// What is off stays off by as much in units of the data's noise, whether or not there is light to show it.
// Where four events of light are judged by, some scatter stays below what is usual, which is the quarter
// here; weights that follow the scatter in units of the simulation's noise lose two thirds.
TEST(ScoreWeights, MoreLightToJudgeThemDoesNotWeakenThem) {
  NextToModule scene;
  const std::vector<LightSample> taught = scene.simulate(scene.stages.wide, 3, 1);
  const EventData data = scene.measured.with_edges(
      arrival_edges(scene.measured, scene.frame, pointers(taught), CascadeKind::electron));
  EmulatorSettings settings;
  settings.model_error = 0;
  settings.position_step = scene.stages.wide.position_step;
  settings.direction_step = scene.stages.wide.direction_step;
  const Emulator emulator(data, scene.ice, scene.frame.origin(), pointers(taught), settings);
  const Vector7 some = variances(scene, data, emulator, 4), much = variances(scene, data, emulator, 40);
  for (int k = 0; k < 7; ++k) EXPECT_GT(much(k), 0.75 * some(k)) << k;
}

}  // namespace
}  // namespace floe
