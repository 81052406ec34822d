// Light of flashers on the strings around them, in a model of the ice, in units of that in isotropic ice.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "propagation/engine/simulator.h"
#include "reco/paper_figures/azimuth_fit.h"
#include "reco/paper_figures/emitters.h"

namespace floe {

struct LightSum {
  double sum = 0;       // charge [photoelectrons]
  double variance = 0;  // of the sum: a photon may be seen more than once
};

// Of each neighbour of the emitter, in their order. Hits are in the order of the photons.
std::vector<LightSum> light_on_neighbours(const Emitter& emitter, std::span<const SimulatedHit> hits);

// Light of all emitters, one entry each, with a vector over their neighbours.
using RingLight = std::vector<std::vector<LightSum>>;

// What a neighbour's light is in units of that of the same flasher in isotropic ice: distance, depth and
// efficiency are the same in both. Errors are those of both simulations. Throws NoResult where a neighbour
// saw nothing.
std::vector<AzimuthPoint> azimuth_points(std::span<const Emitter> emitters, const RingLight& light,
                                         const RingLight& isotropic);

// Of one model, for a table and a picture.
struct AzimuthModel {
  std::string name;
  RingLight light;
  std::vector<AzimuthPoint> points;  // by emitter, by neighbour
  AzimuthFit fit;
};

struct AzimuthStudy {
  std::vector<Emitter> emitters;
  RingLight isotropic;  // in units of which light is measured
  std::vector<AzimuthModel> models;
  double flow = 0;  // azimuth of the ice's flow, in [0, pi) [rad]
};

std::string azimuth_csv(const AzimuthStudy& study);
std::string azimuth_picture(const AzimuthStudy& study, const std::string& title);

}  // namespace floe
