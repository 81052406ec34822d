// Light against azimuth, 125 m away: what each description of anisotropy makes of a flasher that is the same
// all around.
#include <fmt/format.h>

#include <cmath>

#include "data/base/vec3.h"
#include "reco/ice_fit/anisotropies.h"
#include "reco/paper_figures/azimuth_light.h"
#include "reco/paper_figures/figures.h"

namespace floe {

namespace {

constexpr double quick_photons = 4e9;  // N: errors of c of about 0.02
// Wider than in fits, for the light's time does not matter, and what wide modules do to its amount is the
// same in both simulations of a ratio.
constexpr double oversize = 25;
constexpr std::uint64_t first_stream = std::uint64_t{1} << 52;

struct NamedModel {
  std::string name;
  Model model;
};

// The first is what the others are measured by. Isotropic ice is there twice: its own ratio must be 1.
std::vector<NamedModel> models_of(const Model& full) {
  return {{"reference", with_anisotropy_of(full, {})},
          {"isotropic", with_anisotropy_of(full, {})},
          {"absorption anisotropy", with_anisotropy_of(full, {"absorption-anisotropy"})},
          {"birefringence", with_anisotropy_of(full, {"birefringence"})},
          {"full ice", full}};
}

class Azimuth {
 public:
  Azimuth(const FigureSettings& settings, const Progress& progress)
      : settings_(settings), progress_(progress) {}

  AzimuthStudy run() {
    AzimuthStudy study;
    study.emitters = choose_emitters(*settings_.model.detector);
    study.flow = std::fmod(settings_.model.ice->flow_azimuth() + 2 * pi, pi);
    const std::vector<NamedModel> models = models_of(settings_.model);
    runs_ = models.size() * study.emitters.size();
    study.isotropic = light_in(models[0], study.emitters);
    for (std::size_t m = 1; m < models.size(); ++m) {
      AzimuthModel model{models[m].name, light_in(models[m], study.emitters), {}, {}};
      model.points = azimuth_points(study.emitters, model.light, study.isotropic);
      model.fit = fit_azimuth(model.points);
      study.models.push_back(std::move(model));
    }
    return study;
  }

 private:
  // Every run has random numbers of its own: errors of ratios are those of independent counts.
  RingLight light_in(const NamedModel& model, const std::vector<Emitter>& emitters) {
    RingLight light;
    for (const Emitter& emitter : emitters) {
      if (progress_) progress_(static_cast<double>(done_) / static_cast<double>(runs_), model.name);
      RunRequest request = ring_flash(emitter, settings_.photons.value_or(quick_photons), settings_.seed,
                                      first_stream + done_, settings_.threads);
      request.oversize = oversize;
      light.push_back(light_on_neighbours(emitter, simulate_run(model.model, request).hits));
      ++done_;
    }
    return light;
  }

  const FigureSettings& settings_;
  const Progress& progress_;
  std::size_t runs_ = 1, done_ = 0;
};

void add_numbers(const AzimuthModel& model, double flow, std::vector<FigureNumber>& numbers) {
  const AzimuthFit& fit = model.fit;
  const auto add = [&](const char* name, const char* unit, double value, double error) {
    numbers.push_back({model.name, name, unit, value, error});
  };
  add("c", "", fit.amplitude(), fit.amplitude_error());
  add("phi", "deg", fit.phase() / degree, fit.phase_error() / degree);
  add("max/min", "", fit.max_over_min(), fit.max_over_min_error());
  add("c along the flow", "", fit.along(flow), fit.along_error(flow));
  add("p value of isotropy", "", fit.isotropy_p_value(), 0);
  add("chi2 / degrees of freedom", "", fit.chi2 / fit.ndof, std::sqrt(2.0 / fit.ndof));
}

}  // namespace

PaperFigure azimuth_figure(const FigureSettings& settings, const Progress& progress) {
  const AzimuthStudy study = Azimuth(settings, progress).run();
  PaperFigure figure;
  figure.svg = azimuth_picture(
      study, fmt::format("Light on the neighbouring strings in {}", settings.model.ice->name()));
  figure.csv = azimuth_csv(study);
  for (const AzimuthModel& model : study.models) add_numbers(model, study.flow, figure.numbers);
  for (const Emitter& emitter : study.emitters)
    figure.remarks.push_back(fmt::format("flasher {}", text_of(emitter)));
  figure.remarks.push_back(fmt::format("the ice flows along {:.1f} deg", study.flow / degree));
  return figure;
}

}  // namespace floe
