#include "reco/paper_figures/azimuth_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "data/base/error.h"
#include "data/base/vec3.h"

namespace floe {

std::vector<LightSum> light_on_neighbours(const Emitter& emitter, std::span<const SimulatedHit> hits) {
  std::map<std::uint32_t, std::size_t> neighbour_of;
  for (std::size_t k = 0; k < emitter.neighbours.size(); ++k)
    for (const std::uint32_t module : emitter.neighbours[k].modules) neighbour_of[module] = k;
  std::vector<LightSum> light(emitter.neighbours.size());
  std::vector<double> of_photon(light.size(), 0.0);
  const auto close_photon = [&] {
    for (std::size_t k = 0; k < light.size(); ++k) {
      light[k].sum += of_photon[k];
      light[k].variance += of_photon[k] * of_photon[k];
      of_photon[k] = 0;
    }
  };
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (i > 0 && hits[i].photon != hits[i - 1].photon) close_photon();
    const auto found = neighbour_of.find(hits[i].module);
    if (found != neighbour_of.end()) of_photon[found->second] += hits[i].weight;
  }
  close_photon();
  return light;
}

std::vector<AzimuthPoint> azimuth_points(std::span<const Emitter> emitters, const RingLight& light,
                                         const RingLight& isotropic) {
  std::vector<AzimuthPoint> points;
  for (std::size_t e = 0; e < emitters.size(); ++e)
    for (std::size_t k = 0; k < emitters[e].neighbours.size(); ++k) {
      const LightSum &seen = light[e][k], &unit = isotropic[e][k];
      const Neighbour& neighbour = emitters[e].neighbours[k];
      if (!(seen.sum > 0 && unit.sum > 0))
        throw NoResult(fmt::format("string {} saw no light of flasher {}: more photons are needed",
                                   neighbour.string, text_of(emitters[e])));
      const double relative =
          std::sqrt(seen.variance / (seen.sum * seen.sum) + unit.variance / (unit.sum * unit.sum));
      points.push_back({e, neighbour.azimuth, seen.sum / unit.sum, relative});
    }
  return points;
}

std::string azimuth_csv(const AzimuthStudy& study) {
  std::string text =
      "model,flasher_string,flasher_dom,flasher_depth_m,string,distance_m,azimuth_deg,charge,"
      "charge_isotropic,ratio,ratio_error,ratio_over_level,fit_over_level\n";
  for (const AzimuthModel& model : study.models) {
    auto point = model.points.begin();
    for (std::size_t e = 0; e < study.emitters.size(); ++e)
      for (std::size_t k = 0; k < study.emitters[e].neighbours.size(); ++k, ++point) {
        const Emitter& emitter = study.emitters[e];
        const Neighbour& neighbour = emitter.neighbours[k];
        text += fmt::format("{},{},{},{:.2f},{},{:.2f},{:.3f},{:g},{:g},{:.6g},{:.3g},{:.6g},{:.6g}\n",
                            model.name, emitter.module.string, emitter.module.dom, emitter.depth,
                            neighbour.string, neighbour.distance, neighbour.azimuth / degree,
                            model.light[e][k].sum, study.isotropic[e][k].sum, point->ratio,
                            point->ratio * point->relative_error, point->ratio / model.fit.levels[e],
                            model.fit.value(neighbour.azimuth));
      }
  }
  return text;
}

}  // namespace floe
