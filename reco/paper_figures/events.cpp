// What birefringence is worth to cascades: five of them, simulated with it, fitted with it and without.
#include <fmt/format.h>

#include "data/base/error.h"
#include "data/base/vec3.h"
#include "reco/paper_figures/events_picture.h"
#include "reco/paper_figures/figures.h"
#include "reco/study/summary.h"

namespace floe {

namespace {

constexpr int events = 5;
const StudyGroup group{5e4, events, 20};
constexpr double effort = 0.25;  // few photons, to be quick: differences of ln L are known to about 15

Model without_birefringence(const Model& model) {
  ModelParts parts = parts_of(model);
  switch_off(parts.ice, "birefringence");
  return freeze(std::move(parts));
}

std::string csv_of(const std::vector<EventErrors>& all) {
  std::string text = "event,fit,angle_deg,distance_m,energy_ratio,delta_neg_llh,delta_neg_llh_error\n";
  for (const EventErrors& event : all) {
    const auto line = [&](const char* fit, const FitErrors& e, double delta, double error) {
      text += fmt::format("{},{},{:.3f},{:.3f},{:.4f},{:.2f},{:.2f}\n", event.number, fit, e.angle / degree,
                          e.distance, e.energy_ratio, delta, error);
    };
    line("with", event.with, 0, 0);
    line("without", event.without, event.delta_neg_llh, event.delta_neg_llh_error);
  }
  return text;
}

FitErrors errors_of(const StudyFit& fit, const CascadeParameters& truth) {
  return {angle_between(fit.cascade, truth), (fit.cascade.position - truth.position).norm(),
          fit.cascade.energy / truth.energy};
}

std::vector<FigureNumber> numbers_of(const std::vector<EventErrors>& all) {
  std::vector<FigureNumber> numbers;
  const auto add = [&](const char* fit, FitErrors EventErrors::*side) {
    std::vector<double> angles, distances, energies;
    for (const EventErrors& event : all) {
      angles.push_back((event.*side).angle / degree);
      distances.push_back((event.*side).distance);
      energies.push_back((event.*side).energy_ratio);
    }
    numbers.push_back({fit, "median angle from the truth", "deg", median(angles), 0});
    numbers.push_back({fit, "median distance from the truth", "m", median(distances), 0});
    numbers.push_back({fit, "median energy over truth", "", median(energies), 0});
  };
  add("with birefringence", &EventErrors::with);
  add("without", &EventErrors::without);
  std::vector<double> deltas;
  for (const EventErrors& event : all) deltas.push_back(event.delta_neg_llh);
  numbers.push_back({"without", "median loss of ln L", "", median(deltas), 0});
  return numbers;
}

}  // namespace

PaperFigure events_figure(const FigureSettings& settings, const Progress& progress) {
  StudySettings study;
  study.truth = settings.model;
  study.other = without_birefringence(settings.model);
  study.seed = settings.seed;
  study.fit.effort = effort;
  std::vector<EventErrors> all;
  PaperFigure figure;
  for (int i = 0; i < events; ++i) {
    if (progress) progress(i / static_cast<double>(events), fmt::format("event {}", i + 1));
    const StudyRow row = study_event(study, group, i, settings.threads);
    if (!is_usable(row.fit.status) || !is_usable(row.other->status)) {
      figure.remarks.push_back(fmt::format("event {} was left out: {}", i + 1,
                                           is_usable(row.fit.status) ? row.other->reason : row.fit.reason));
      continue;
    }
    all.push_back({i + 1, errors_of(row.fit, row.truth), errors_of(*row.other, row.truth), row.delta_neg_llh,
                   row.delta_neg_llh_error});
  }
  if (all.empty()) throw NoResult("no cascade could be fitted both with and without birefringence");
  figure.svg =
      events_picture(all, fmt::format("Cascades of {:g} TeV in {}, fitted with and without birefringence",
                                      group.energy / 1e3, settings.model.ice->name()));
  figure.csv = csv_of(all);
  figure.numbers = numbers_of(all);
  figure.remarks.push_back(fmt::format(
      "data and fits with modules {:g} times wider; --photons is of flashers, not of these", group.oversize));
  if (!settings.model.ice->birefringence())
    figure.remarks.push_back("this ice has no birefringence: both fits are the same");
  return figure;
}

}  // namespace floe
