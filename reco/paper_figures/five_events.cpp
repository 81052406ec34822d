// Cascades in birefringent ice, fitted with birefringence and without.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "data/base/error.h"
#include "reco/ice_fit/anisotropies.h"
#include "reco/paper_figures/figures.h"
#include "reco/study/summary.h"

namespace floe {

namespace {

constexpr int events = 5;
constexpr double energy = 5e4;   // [GeV]
constexpr double oversize = 20;  // of data and fit
constexpr double quick_effort = 0.1;

StudySettings study_settings(const FigureSettings& settings) {
  StudySettings study;
  study.truth = settings.model;
  ModelParts parts = parts_of(settings.model);
  switch_off(parts.ice, "birefringence");
  study.other = freeze(std::move(parts));
  if (study.other->ice->hash() == study.truth.ice->hash())
    throw UsageError(fmt::format("five-events: {} has no birefringence to be left out of the fit",
                                 settings.model.ice->name()));
  study.seed = settings.seed;
  study.fit.model_error = 0;  // simulated data have none
  study.fit.effort = quick_effort;
  return study;
}

void add_row(const StudyRow& row, const StudyFit& fit, const char* model, std::string& csv) {
  const Vec3 true_direction = travel_direction(row.truth.zenith, row.truth.azimuth),
             direction = travel_direction(fit.cascade.zenith, fit.cascade.azimuth);
  const double angle = std::acos(std::clamp(direction.dot(true_direction), -1.0, 1.0));
  csv += fmt::format("{},{},{:.1f},{:.3f},{:.3f},{:.5f},{:.2f}\n", row.index, model, row.charge,
                     (fit.cascade.position - row.truth.position).norm(), angle / degree,
                     fit.cascade.energy / row.truth.energy, fit.neg_llh);
}

}  // namespace

PaperFigure five_events_figure(const FigureSettings& settings, const Progress& progress) {
  const StudySettings study = study_settings(settings);
  std::vector<StudyRow> rows;
  PaperFigure figure;
  figure.csv = "event,fitted,charge,distance_m,angle_deg,energy_over_truth,neg_llh\n";
  for (int index = 0; index < events; ++index) {
    if (progress) progress(double(index) / events, fmt::format("event {} of {}", index + 1, events));
    rows.push_back(study_event(study, {energy, events, oversize}, index, settings.threads));
    add_row(rows.back(), rows.back().fit, "with birefringence", figure.csv);
    add_row(rows.back(), *rows.back().other, "without birefringence", figure.csv);
  }
  figure.svg = figure_of_study(
      rows, fmt::format("{} cascades of {:g} TeV in {}", events, energy / 1000, settings.model.ice->name()));
  const StudyBias bias = summarise_bias(rows);
  figure.numbers = {
      {"with birefringence", "median angle from the truth", "deg", bias.median_angle_truth / degree, 0},
      {"without", "median angle from the truth", "deg", bias.median_angle / degree, 0},
      {"with birefringence", "mean of ln(energy / truth)", "", bias.mean_log_energy_truth,
       bias.mean_log_energy_truth_error},
      {"without", "mean of ln(energy / truth)", "", bias.mean_log_energy, bias.mean_log_energy_error},
      {"without", "-ln L above that with birefringence, mean", "", bias.mean_delta, bias.mean_delta_error}};
  figure.remarks.push_back("the picture shows the fits with birefringence, the table both");
  return figure;
}

}  // namespace floe
