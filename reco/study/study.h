// The calibration study: fits of cascades whose truth is known, to see whether results and errors can be
// believed, and how far they are from the least errors that are possible.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reco/compare.h"
#include "reco/direct_fit/cascade_fit.h"
#include "response/detector_response.h"

namespace floe {

// Cascades of one energy, contained in the detector.
struct StudyGroup {
  double energy = 1e4;   // [GeV]
  int events = 10;       // >= 0
  double oversize = 10;  // of the modules, for data and fit alike; 1-100
};

struct StudySettings {
  Model truth;                 // that the events are simulated in, and fitted with
  std::optional<Model> other;  // that they are fitted with as well
  std::vector<StudyGroup> groups;
  std::uint64_t seed = 1;
  FitOptions fit;  // oversize and seed are set for each event
  // Of the truth's detector: pulses are fitted. None: photons are. Bounds are of photons in any case.
  std::shared_ptr<const DetectorResponse> response;
};

struct StudyFit {
  FitStatus status = FitStatus::not_enough_light;
  std::string reason;
  CascadeParameters cascade;
  Matrix7 covariance = Matrix7::Constant(std::numeric_limits<double>::quiet_NaN());
  double neg_llh = 0, ndof = 0, p_value = 0;
  std::uint64_t photons = 0;
  double seconds = 0;
  std::optional<OtherMinimum> other_minimum;
};

struct StudyRow {
  double energy = 0;  // of the group [GeV]
  int index = 0;      // of the event in its group, from 0
  CascadeParameters truth;
  double charge = 0;  // [photoelectrons]
  std::size_t modules = 0;
  StudyFit fit;
  // Cramer-Rao bound at the truth, of x, y, z, time, zenith, azimuth, energy.
  Matrix7 bound = Matrix7::Constant(std::numeric_limits<double>::quiet_NaN());
  std::optional<StudyFit> other;                      // with the other model
  double delta_neg_llh = 0, delta_neg_llh_error = 0;  // other - truth
};

// The truth of an event: a function of seed, energy and index alone. Uniform in the instrumented volume, at
// least 50 m inside, and over directions.
CascadeParameters draw_contained_cascade(const Detector& detector, std::uint64_t seed, double energy,
                                         int index);

// Simulates and fits one event. A row is a function of the settings and of (group, index); the number of
// threads does not change it, except for the seconds.
StudyRow study_event(const StudySettings& settings, const StudyGroup& group, int index, int threads);

}  // namespace floe
