// Arrival times of a flasher's light on a neighbouring string along the flow and on one across it, in the
// models that floe ladder compares, none of them refitted.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/base/error.h"
#include "data/base/vec3.h"
#include "reco/ice_fit/anisotropies.h"
#include "reco/paper_figures/emitters.h"
#include "reco/paper_figures/figures.h"
#include "reco/paper_figures/light_curves_picture.h"

namespace floe {

namespace {

constexpr double quick_photons = 4e9;    // N
constexpr double depth_difference = 30;  // of the modules, at most: their distances are alike [m]
// Clear ice, where much light gets to the next string.
constexpr double top = 2200, bottom = 2300;  // of the flasher [m]
constexpr std::uint64_t first_stream = std::uint64_t{1} << 53;

// Between two axes, neither of which has a sign: [0, pi/2].
double angle_between_axes(double a, double b) {
  return std::abs(std::remainder(a - b, pi));
}

const Neighbour& nearest_to_axis(const Emitter& emitter, double axis) {
  return *std::min_element(emitter.neighbours.begin(), emitter.neighbours.end(),
                           [&](const Neighbour& a, const Neighbour& b) {
                             return angle_between_axes(a.azimuth, axis) < angle_between_axes(b.azimuth, axis);
                           });
}

// Those of the ladder that this ice has: without its strength, an anisotropy is isotropic ice once more.
struct Models {
  std::vector<std::string> names, absent;
  std::vector<Model> models;
};

Models models_of(const Model& full) {
  Models found;
  for (const AnisotropyDescription& description : anisotropy_descriptions()) {
    const Model model = with_anisotropy_of(full, description.effects);
    const auto same = std::find_if(found.models.begin(), found.models.end(), [&](const Model& other) {
      return other.ice->hash() == model.ice->hash();
    });
    if (same != found.models.end()) {
      found.absent.push_back(fmt::format("{}: the same as {} in this ice, not drawn", description.name,
                                         found.names[static_cast<std::size_t>(same - found.models.begin())]));
      continue;
    }
    found.names.push_back(description.name);
    found.models.push_back(model);
  }
  return found;
}

CurvePanel panel_of(const std::string& key, const Neighbour& neighbour, double flow) {
  return {fmt::format("{}: string {}, {:.0f} m away, {:.0f}\u00b0 off the flow", key, neighbour.string,
                      neighbour.distance, angle_between_axes(neighbour.azimuth, flow) / degree),
          key,
          arrival_edges(neighbour.distance),
          {}};
}

void add_numbers(const CurvePanel& panel, const LightCurves& curves, std::vector<FigureNumber>& numbers) {
  for (std::size_t m = 0; m < curves.models.size(); ++m) {
    const ArrivalCurve& curve = panel.curves[m];
    const double unit = 1e9 / curves.photons;
    const std::string of = fmt::format("{}, {} the flow", curves.models[m], panel.key);
    numbers.push_back(
        {of, "charge for 1e9 photons", "pe", curve.total * unit, std::sqrt(curve.total_variance) * unit});
    numbers.push_back({of, "median time", "ns", curve.median, curve.median_error});
  }
}

}  // namespace

PaperFigure light_curves_figure(const FigureSettings& settings, const Progress& progress) {
  const Detector& detector = *settings.model.detector;
  const double flow = settings.model.ice->flow_azimuth();
  EmitterRule rule;
  rule.count = 1;
  rule.top = top;
  rule.bottom = bottom;
  const Emitter emitter = narrowed(choose_emitters(detector, rule).front(), depth_difference, detector);
  const Neighbour* const strings[] = {&nearest_to_axis(emitter, flow),
                                      &nearest_to_axis(emitter, flow + pi / 2)};
  const Models models = models_of(settings.model);

  LightCurves curves;
  curves.photons = settings.photons.value_or(quick_photons);
  curves.models = models.names;
  curves.panels = {panel_of("along", *strings[0], flow), panel_of("across", *strings[1], flow)};
  for (std::size_t m = 0; m < models.models.size(); ++m) {
    if (progress)
      progress(static_cast<double>(m) / static_cast<double>(models.models.size()), models.names[m]);
    const SimulatedRun run = simulate_run(models.models[m], ring_flash(emitter, curves.photons, settings.seed,
                                                                       first_stream + m, settings.threads));
    for (std::size_t p = 0; p < curves.panels.size(); ++p) {
      CurvePanel& panel = curves.panels[p];
      panel.curves.push_back(arrival_curve(run.hits, strings[p]->modules, panel.edges));
      if (!(panel.curves.back().total > 0))
        throw NoResult(fmt::format("string {} saw no light of flasher {}: more photons are needed",
                                   strings[p]->string, text_of(emitter)));
    }
  }

  PaperFigure figure;
  figure.svg = light_curves_picture(
      curves, fmt::format("Arrival times in {}: flasher {}", settings.model.ice->name(), text_of(emitter)));
  figure.csv = light_curves_csv(curves);
  for (const CurvePanel& panel : curves.panels) add_numbers(panel, curves, figure.numbers);
  figure.remarks.push_back(
      fmt::format("flasher {}; modules within {:g} m of its depth", text_of(emitter), depth_difference));
  figure.remarks.insert(figure.remarks.end(), models.absent.begin(), models.absent.end());
  return figure;
}

}  // namespace floe
