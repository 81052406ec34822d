// What the page of an event is drawn from: one JSON object.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/planned_output.h"
#include "apps/view/fit_results.h"
#include "apps/view/light_curves.h"
#include "data/readout.h"
#include "propagation/ice/ice_model.h"

namespace floe {

struct EventToShow {
  std::string file;  // from which it was read
  Event event;
  std::string source;  // the file's record of its source of light, JSON; empty when there is none
  std::vector<ModuleWaveform> waveforms;  // of the first repetition
  std::optional<FitResults> fit;
};

// Keys: event, file, repeats, hits; detector {name, string, dom, x, y, z, on: a list each}; time {begin, end,
// bin_width}; curves [{module, hits, charge, first, bins: steps from bin to bin, charges}]; truth, fits
// [{x, y, z, time, zenith_deg, azimuth_deg, energy, ...}]; light [{x, y, z, label}]; waveforms; ice
// {name, flow_azimuth_deg, z, absorption, scattering}. Units: m, ns, pe, GeV, deg, 1/m at 400 nm.
Json page_data(const EventToShow& shown, const LightCurves& curves, const Detector& detector,
               const IceModel* ice);

}  // namespace floe
