// What a metre of birefringent ice does to light: the walk through its grains, and the functions that
// describe it.
#include <fmt/format.h>

#include "data/base/vec3.h"
#include "propagation/crystal/fabric.h"
#include "reco/crystal/crystal_study.h"
#include "reco/crystal/pattern_picture.h"
#include "reco/paper_figures/figures.h"

namespace floe {

namespace {

// Grains of the deep South Pole's ice (arXiv:2107.08692): 1.4 times as long along the flow as across it,
// c-axes in a girdle.
constexpr double elongation = 1.4, ln_S1_S2 = 0.1, ln_S2_S3 = 4, wavelength = 405;
constexpr int step = 5;  // between angles [deg]

PatternGrid grid_of(const FigureSettings& settings) {
  PatternGrid grid;
  grid.crystal.indices = crystal_indices(wavelength);
  grid.crystal.fabric = Fabric::from_eigenvalues(fabric_eigenvalues(ln_S1_S2, ln_S2_S3));
  grid.crystal.grains = spheroid(elongation);
  for (int angle = 0; angle <= 90; angle += step) grid.angles.push_back(angle * degree);
  grid.seed = settings.seed;
  grid.threads = settings.threads;
  return grid;
}

std::string csv_of(const CrystalStudy& study) {
  const DiffusionFit& fit = *study.all;
  std::string text = "angle_deg";
  for (const std::string_view name : diffusion_names) text += fmt::format(",{0},{0}_error", name);
  text += "\n";
  for (std::size_t i = 0; i < study.patterns.size(); ++i) {
    text += fmt::format("{:g}", study.patterns[i].angle / degree);
    for (const auto& points : fit.points)
      text += fmt::format(",{:.6g},{:.2g}", points[i].value, points[i].error);
    text += "\n";
  }
  return text;
}

}  // namespace

PaperFigure diffusion_figure(const FigureSettings& settings, const Progress& progress) {
  const CrystalStudy study =
      study_crystal(fmt::format("elongation {:g}, fabric {:g},{:g}", elongation, ln_S1_S2, ln_S2_S3),
                    fmt::format("{:g},{:g}", ln_S1_S2, ln_S2_S3), grid_of(settings), false, progress);
  PaperFigure figure;
  figure.svg = pattern_picture(study, PatternEstimator::all);
  figure.csv = csv_of(study);
  for (std::size_t i = 0; i < diffusion_names.size(); ++i) {
    const FunctionFit& function = study.all->functions[i];
    const auto number = [&](const char* name, double value, double error) {
      figure.numbers.push_back({std::string(diffusion_names[i]), name, "", value, error});
    };
    number("A", function.numbers.A, function.errors.A);
    number("B", function.numbers.B, function.errors.B);
    number("C", function.numbers.C, function.errors.C);
    number("D", function.numbers.D, function.errors.D);
  }
  figure.remarks.push_back(fmt::format("{} photons at each angle, {} grains of {:g} mm", study.grid.photons,
                                       study.grid.crossings, 1e3 * study.grid.grain));
  figure.remarks.push_back("the same for all ice models: those take the twelve numbers from here");
  return figure;
}

}  // namespace floe
