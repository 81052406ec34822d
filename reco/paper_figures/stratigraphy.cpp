// The ice of several layers from a few flashers at once.
#include <fmt/format.h>

#include <cmath>

#include "reco/ice_fit/stratigraphy.h"
#include "reco/paper_figures/figures.h"
#include "reco/paper_figures/pseudo_data.h"

namespace floe {

namespace {

constexpr double quick_photons = 4e8;  // N of each flasher
// Clear ice, where much light gets far.
constexpr double top = 2150, bottom = 2350;  // of the flashers [m]
constexpr double oversize = 25;
constexpr double beyond_flashers = 25;  // as far as the layers go above and below them [m]
constexpr int layers = 4;
constexpr std::uint64_t first_stream = std::uint64_t{1} << 55;
// What the data's ice is, in units of the model that the fit begins with.
constexpr double true_absorption = 1.2, true_strength = 0.7;

double truth_of(const IceParameter& parameter) {
  return parameter.family == "absorption" ? true_absorption : true_strength;
}

Model truth_from(const Model& model, const std::vector<IceParameter>& parameters) {
  std::vector<double> numbers;
  for (const IceParameter& parameter : parameters)
    numbers.push_back(parameter.start + std::log(truth_of(parameter)));
  return with_parameters(model, parameters, numbers);
}

IceFitOptions fit_options(const FigureSettings& settings) {
  IceFitOptions options;
  options.seed = settings.seed;
  options.threads = settings.threads;
  options.oversize = oversize;
  options.light = {5, 100, options.light.most_photons};  // however little the data's light is
  options.most_rounds = 4;
  return options;
}

}  // namespace

PaperFigure stratigraphy_figure(const FigureSettings& settings, const Progress& progress) {
  const Model& model = settings.model;
  EmitterRule rule;
  rule.top = top;
  rule.bottom = bottom;
  const std::vector<Emitter> emitters = choose_emitters(*model.detector, rule);
  const DepthRange range{rule.top - beyond_flashers, rule.bottom + beyond_flashers, layers};
  std::vector<IceParameter> parameters = layer_parameters(LayerFamily::absorption, range);
  const std::vector<IceParameter> strengths = layer_parameters(LayerFamily::birefringence, range);
  parameters.insert(parameters.end(), strengths.begin(), strengths.end());

  const FlasherData data =
      pseudo_data(truth_from(model, parameters), emitters, settings.photons.value_or(quick_photons),
                  settings.seed, first_stream, settings.threads);
  const IceFit fit = fit_ice(model, data, parameters, fit_options(settings), progress);
  const auto rows = stratigraphy(model, with_parameters(model, fit.parameters, fit.numbers), fit);

  PaperFigure figure;
  figure.svg = stratigraphy_picture(rows, fmt::format("{} fitted to flashers", model.ice->name()));
  figure.csv = stratigraphy_csv(rows);
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    figure.numbers.push_back({"fitted", fit.parameters[i].name, "", fit.value(i), fit.error(i)});
  for (const Emitter& emitter : emitters)
    figure.remarks.push_back(fmt::format("data: flasher {}", text_of(emitter)));
  figure.remarks.push_back(
      fmt::format("the data's ice has {:g} times the model's absorption and {:g} times its birefringence",
                  true_absorption, true_strength));
  if (!fit.converged) figure.remarks.push_back("the fit's last step was not yet small");
  return figure;
}

}  // namespace floe
