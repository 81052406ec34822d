// What an emulator learns from simulations, module by module. Used by Emulator alone.
#pragma once

#include <span>
#include <vector>

#include "reco/direct_fit/arrival_profile.h"
#include "reco/direct_fit/common_shape.h"
#include "reco/direct_fit/expectation_model.h"
#include "reco/direct_fit/local_frame.h"
#include "reco/direct_fit/point_light.h"
#include "reco/direct_fit/poisson_regression.h"
#include "reco/event_data.h"

namespace floe {

// A module and what is known about its light near the emulator's origin.
struct ModuleLight {
  std::uint32_t index = 0;           // in Detector::modules()
  const ModuleData* data = nullptr;  // none: a module without hits, one bin
  Vec3 position = Vec3::Zero();
  IceLengths ice;                  // between origin and module
  double distance = 0;             // soft, from the origin [m]
  std::vector<double> edges;       // inner, of the bins, after the direct light from the origin [ns]
  ArrivalProfile profile;          // of the same time, of all simulations; empty with one bin
  ShapeTerms origin_terms;         // of the origin
  std::vector<ShapeTerms> shapes;  // one for each bin: common to many modules
  std::vector<Regression> bins;    // one for each bin: what is its own

  std::size_t bin_count() const { return data ? data->counts.size() : 1; }
};

// Fits the regressions of all bins in levels. How light changes with angle and distance is learnt from all
// modules at similar distances and bins of similar times; how bright it is, from modules in shells of
// distance; each module's deviation from that is drawn towards none, each bin's towards its module's. How
// strongly is learnt from the simulations too (the evidence approximation, MacKay 1992): slopes that are
// mostly noise would otherwise pretend to be information, and steps would come out too short.
std::vector<ModuleLight> train(const EventData& data, const MeanIce& ice, const LocalFrame& frame,
                               std::span<const LightSample* const> samples, CascadeKind kind, int threads);

}  // namespace floe
