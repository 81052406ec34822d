// How well the light of a layer's flashers tells birefringence from scattering.
#include <fmt/format.h>

#include "reco/ice_fit/scan.h"
#include "reco/paper_figures/figures.h"
#include "reco/paper_figures/pseudo_data.h"

namespace floe {

namespace {

constexpr double quick_photons = 1e8;  // N of the flasher
// Clear ice, where much light gets far; the layer reaches beyond the flasher.
constexpr double flasher_top = 2200, flasher_bottom = 2300, beyond = 50;  // [m]
constexpr double oversize = 25;
// Scattering stays above the birefringent share of it at all points, in the built-in ice, too.
constexpr int values = 5;  // of each axis
constexpr std::uint64_t first_stream = std::uint64_t{1} << 54;

RunSettings scan_settings(const FigureSettings& settings) {
  RunSettings options;
  options.seed = settings.seed;
  options.threads = settings.threads;
  options.oversize = oversize;
  // However little the data's light is.
  options.light = {15, 100, options.light.most_photons};
  return options;
}

std::string csv_of(const IceScan& scan) {
  std::string text =
      fmt::format("{},{},neg_llh,above_minimum\n", scan.x.parameter.name, scan.y.parameter.name);
  const std::vector<double> x = scan.x.values(), y = scan.y.values();
  for (int row = 0; row < scan.neg_llh.rows; ++row)
    for (int column = 0; column < scan.neg_llh.columns; ++column)
      text += fmt::format("{:g},{:g},{:.3f},{:.3f}\n", x[static_cast<std::size_t>(column)],
                          y[static_cast<std::size_t>(row)], scan.neg_llh.at(row, column),
                          scan.neg_llh.at(row, column) - scan.minimum.value);
  return text;
}

}  // namespace

PaperFigure llh_space_figure(const FigureSettings& settings, const Progress& progress) {
  const Model& model = settings.model;
  EmitterRule rule;
  rule.count = 1;
  rule.top = flasher_top;
  rule.bottom = flasher_bottom;
  const std::vector<Emitter> emitters = choose_emitters(*model.detector, rule);
  const ScanAxis strength{
      layer_factor(LayerFamily::birefringence, rule.top - beyond, rule.bottom + beyond, model), 0.5, 1.5,
      values},
      scattering{layer_factor(LayerFamily::scattering, rule.top - beyond, rule.bottom + beyond, model), 0.85,
                 1.15, values};
  const FlasherData data = pseudo_data(model, emitters, settings.photons.value_or(quick_photons),
                                       settings.seed, first_stream, settings.threads);
  const IceScan scan = scan_ice(model, data, strength, scattering, scan_settings(settings), progress);

  PaperFigure figure;
  figure.svg = scan_picture(scan, fmt::format("-ln L of flashers in {}", model.ice->name()));
  figure.csv = csv_of(scan);
  const QuadraticMinimum& m = scan.minimum;
  figure.numbers = {{"minimum", strength.parameter.name, "", m.x, m.found ? m.x_error : 0},
                    {"minimum", scattering.parameter.name, "", m.y, m.found ? m.y_error : 0},
                    {"minimum", "correlation", "", m.correlation, 0},
                    {"noise", "standard deviation of -ln L", "", scan.noise, 0}};
  for (const Emitter& emitter : emitters)
    figure.remarks.push_back(
        fmt::format("data: flasher {}, simulated where both factors are 1", text_of(emitter)));
  if (!m.found) figure.remarks.push_back("the lowest point of the grid: a parabola has no minimum within it");
  if (scan.noise > level_68)
    figure.remarks.push_back(
        "the simulation's noise is larger than the 68% contour is high: its shape is not to be trusted");
  if (m.at_edge) figure.remarks.push_back("the minimum is at the edge of the grid");
  return figure;
}

}  // namespace floe
