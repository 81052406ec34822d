// floe compare: which of two ice models describes events better.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/event_arguments.h"
#include "apps/fit_options.h"
#include "apps/model_json.h"
#include "apps/model_warnings.h"
#include "apps/option_values.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "apps/text_table.h"
#include "data/base/error.h"
#include "reco/compare.h"
#include "reco/event_data.h"
#include "reco/figure_arrival_times.h"

namespace floe {

namespace {

struct CompareOptions {
  std::vector<std::string> files, ice;
  std::vector<std::string> without;
  std::vector<EffectSetting> with;
  std::optional<int> ice_version;
  std::optional<std::string> detector, picture;
  FitSettings fit;
  OutputOptions output;
};

// A, B.
std::array<ModelRequest, 2> model_requests(const CompareOptions& options) {
  ModelRequest a;
  a.ice_version = options.ice_version;
  a.detector = options.detector;
  if (!options.ice.empty()) a.ice = options.ice.front();
  ModelRequest b = a;
  if (options.ice.size() > 2)
    throw UsageError(fmt::format("--ice: found {} models; expected at most two", options.ice.size()));
  if (options.ice.size() == 2) {
    if (!options.without.empty() || !options.with.empty())
      throw UsageError(
          fmt::format("{} makes the second model from the first; expected one --ice with it, found two",
                      options.without.empty() ? "--with" : "--without"));
    b.ice = options.ice.back();
  } else if (options.without.empty() && options.with.empty()) {
    throw UsageError(
        "a second model is missing; expected --ice A --ice B, or --without or --with to make B from A");
  } else {
    b.without = options.without;
    b.with = options.with;
  }
  return {a, b};
}

// The picture of one of `count` events: NAME.svg, or NAME-1.svg, NAME-2.svg, ...
std::optional<std::string> picture_name(const std::optional<std::string>& picture, std::size_t index,
                                        std::size_t count) {
  if (!picture || count == 1) return picture;
  const std::filesystem::path path(*picture);
  return (path.parent_path() / fmt::format("{}-{}.svg", path.stem().string(), index + 1)).string();
}

struct ParameterRow {
  std::string name;
  double a, b, error_a, error_b;
  int digits;
};

std::vector<ParameterRow> parameter_rows(const CascadeFit& a, const CascadeFit& b) {
  const Vector7 va = to_vector(a.cascade), vb = to_vector(b.cascade);
  std::vector<ParameterRow> rows;
  for (int i = 0; i < 7; ++i) {
    const ShownParameter& shown = shown_parameters[static_cast<std::size_t>(i)];
    const double unit = shown.unit_size;
    rows.push_back({fmt::format("{} [{}]", shown.name, shown.unit), va[i] / unit, vb[i] / unit,
                    std::sqrt(a.covariance(i, i)) / unit, std::sqrt(b.covariance(i, i)) / unit,
                    i < 3   ? 2
                    : i < 6 ? 1
                            : 0});
  }
  return rows;
}

// B - A of an angle around the circle is the short way round.
double difference(const ParameterRow& row) {
  const double plain = row.b - row.a;
  return row.name.starts_with("azimuth") ? std::remainder(plain, 360.0) : plain;
}

std::string comparison_table(const ModelComparison& comparison) {
  const auto& [a, b] = comparison.fits;
  TextTable table({"", "A", "B", "B - A"});
  const auto with_error = [](double value, double error, int digits) {
    return fmt::format("{:.{}f} +- {:.{}f}", value, digits, error, digits);
  };
  table.add(
      {"  -ln L", with_error(a.neg_llh, a.neg_llh_error, 1), with_error(b.neg_llh, b.neg_llh_error, 1), ""});
  table.add({"  degrees of freedom", fmt::format("{:.0f}", a.ndof), fmt::format("{:.0f}", b.ndof), ""});
  table.add({"  p value", fmt::format("{:.2g}", a.p_value), fmt::format("{:.2g}", b.p_value), ""});
  for (const ParameterRow& row : parameter_rows(a, b))
    table.add({fmt::format("  {}", row.name), with_error(row.a, row.error_a, row.digits),
               with_error(row.b, row.error_b, row.digits),
               fmt::format("{:+.{}f}", difference(row), row.digits)});
  return table.str();
}

std::string verdict(const ModelComparison& comparison) {
  // Three standard errors of the finite simulations.
  const double delta = comparison.delta_neg_llh, error = comparison.delta_neg_llh_error;
  const std::string measured =
      fmt::format("With equal simulations of both fits, -ln L of B - A is {:.1f} +- {:.1f}: ", delta, error);
  if (!(std::abs(delta) > 3 * error))
    return measured + "this does not tell which model describes the event better.";
  return measured + fmt::format("{} describes the event better.", delta > 0 ? "A" : "B");
}

void print_comparison(const ModelComparison& comparison, const std::array<ModelRequest, 2>& requests) {
  fmt::print("event {}\n  A: {}\n  B: {}\n", comparison.event, model_label(requests[0]),
             model_label(requests[1]));
  if (!comparison.usable()) {
    for (std::size_t i = 0; i < 2; ++i) fmt::print("Fit {}: {}", "AB"[i], describe(comparison.fits[i]));
    return;
  }
  fmt::print("{}Vertices {:.2f} m apart, directions {:.1f} deg apart, energy of B / A {:.3f}.\n{}\n",
             comparison_table(comparison), comparison.distance, comparison.angle / degree,
             comparison.energy_ratio, verdict(comparison));
}

Json event_json(const ModelComparison& comparison) {
  const auto& [a, b] = comparison.fits;
  // The first status that stands in the way of a comparison, if there is one.
  const CascadeFit& telling = a.usable() ? b : a;
  return {{"event", comparison.event},
          {"status", name_of(telling.status)},
          {"reason", telling.reason},
          {"fits", {fit_json(a), fit_json(b)}},
          {"delta_neg_llh", comparison.delta_neg_llh},
          {"delta_neg_llh_error", comparison.delta_neg_llh_error},
          {"distance_m", comparison.distance},
          {"angle_deg", comparison.angle / degree},
          {"energy_ratio", comparison.energy_ratio},
          {"seconds", a.seconds + b.seconds}};
}

std::string picture_of(const ModelComparison& comparison, const std::array<ModelRequest, 2>& requests) {
  const std::array<FigureFit, 2> fits{{{"A: " + model_label(requests[0]), &comparison.fits[0]},
                                       {"B: " + model_label(requests[1]), &comparison.fits[1]}}};
  return figure_arrival_times(fits,
                              fmt::format("Event {}: light in the brightest modules", comparison.event));
}

struct Models {
  std::array<ModelRequest, 2> requests;
  Model a, b;
};

ModelComparison compare_event(const Models& models, const Event& event, const CompareOptions& options,
                              const FitOptions& fit) {
  ProgressBar bar(options.output.quiet);
  return compare_models(models.a, models.b, event, fit, bar.callback());
}

void run_compare(const CompareOptions& options) {
  const auto requests = model_requests(options);
  const FitOptions fit = to_fit_options(options.fit);
  PlannedOutput json(options.output.json);
  const std::vector<Event> events = read_events(options.files);
  std::vector<std::unique_ptr<PlannedOutput>> pictures;
  for (std::size_t i = 0; i < events.size(); ++i)
    pictures.push_back(std::make_unique<PlannedOutput>(picture_name(options.picture, i, events.size())));
  const Models models{requests, load_model(requests[0]), load_model(requests[1])};
  // A bad event is found before the work on others begins.
  for (const Event& event : events) EventData(*models.a.detector, event, fit.selection);

  Json results = {{"models", {to_json(models.a), to_json(models.b)}},
                  {"seed", fit.seed},
                  {"warnings", Json::array({warn_of_model(models.a, fit.oversize),
                                            warn_of_model(models.b, fit.oversize)})},
                  {"events", Json::array()}};
  std::string failures;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const ModelComparison comparison = compare_event(models, events[i], options, fit);
    results["events"].push_back(event_json(comparison));
    if (!options.output.quiet) print_comparison(comparison, requests);
    if (comparison.usable())
      pictures[i]->write(picture_of(comparison, requests));
    else
      failures += fmt::format("{}event {}: no comparison: {}", failures.empty() ? "" : "\n", events[i].id,
                              results["events"].back()["reason"].get<std::string>());
  }
  json.write(json_text(results));
  json.commit();
  for (const auto& picture : pictures) picture->commit();
  if (!failures.empty()) throw NoResult(failures);
}

}  // namespace

void add_compare(CLI::App& floe) {
  CLI::App& app =
      *floe.add_subcommand("compare", "Fit events with two ice models and say which describes them better");
  const auto options = std::make_shared<CompareOptions>();
  add_event_arguments(app, options->files);
  app.add_option("--ice", options->ice, "Given twice: the models A and B; given once: A")
      ->type_name("DIR|south-pole")
      ->allow_extra_args(false);
  add_integer(
      app, "--ice-version", 0, 1000, "Read ice directories as this version, whatever they say",
      [options = options.get()](std::int64_t version) { options->ice_version = static_cast<int>(version); });
  add_detector_option(app, options->detector);
  add_without_option(app, options->without)
      ->description("B is A without these effects; floe info --help lists them");
  add_effect_settings(app, "--with", "B is A with this changed; floe effects lists what there is",
                      options->with);
  add_picture(app, "-o,--picture",
              "Picture of the data and both fits: arrival times in the brightest modules; of several "
              "events, FILE-1.svg, FILE-2.svg, ...",
              options->picture);
  add_fit_options(app, options->fit);
  add_output_options(app, options->output);
  app.footer(
      "Examples:\n"
      "  floe compare event.h5 --without birefringence --picture compare.svg\n"
      "  floe compare event.hits --ice my-ice --ice south-pole --json compare.json\n"
      "  floe compare event.h5 imported.h5 --ice south-pole --without birefringence.deflection\n"
      "  floe compare event.h5 --with absorption-scale.factor=1.1\n"
      "A positive B - A of -ln L means that A describes the event better.");
  app.callback([options] { run_compare(*options); });
}

}  // namespace floe
