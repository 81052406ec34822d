// floe reconstruct: position, time, direction and energy of cascades from their hits.
#include <fmt/format.h>

#include <memory>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/event_arguments.h"
#include "apps/fit_options.h"
#include "apps/model_json.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "data/base/error.h"
#include "reco/direct_fit/cascade_fit.h"

namespace floe {

namespace {

struct ReconstructOptions {
  std::vector<std::string> files;
  ModelRequest model;
  FitSettings fit;
  OutputOptions output;
};

Json event_json(const Event& event, const CascadeFit& fit) {
  return {{"event", event.id},
          {"status", name_of(fit.status)},
          {"reason", fit.reason},
          {"fit", fit_json(fit)},
          {"seconds", fit.seconds}};
}

void run_reconstruct(const ReconstructOptions& options) {
  const FitOptions fit_options = to_fit_options(options.fit);
  PlannedOutput json(options.output.json);
  const std::vector<Event> events = read_events(options.files);
  const Model model = load_model(options.model);

  Json results = {{"model", to_json(model)}, {"seed", fit_options.seed}, {"events", Json::array()}};
  std::string failures;
  for (const Event& event : events) {
    CascadeFit fit;
    {
      ProgressBar bar(options.output.quiet);
      fit = fit_cascade(model, event, fit_options, bar.callback());
    }
    results["events"].push_back(event_json(event, fit));
    if (fit.status == FitStatus::track_like)
      fmt::print(stderr, "floe: warning: event {}: {}\n", event.id, fit.reason);
    if (!fit.usable())
      failures += fmt::format("{}event {}: {}", failures.empty() ? "" : "\n", event.id, fit.reason);
    if (!options.output.quiet) fmt::print("event {}: {}", event.id, describe(fit));
  }
  json.write(json_text(results));
  json.commit();
  if (!failures.empty()) throw NoResult(failures);
}

}  // namespace

void add_reconstruct(CLI::App& floe) {
  CLI::App& app = *floe.add_subcommand("reconstruct", "Fit cascades to events");
  const auto options = std::make_shared<ReconstructOptions>();
  add_event_arguments(app, options->files);
  add_model_options(app, options->model);
  add_fit_options(app, options->fit);
  add_output_options(app, options->output);
  app.footer(
      "Examples:\n"
      "  floe reconstruct event.h5\n"
      "  floe reconstruct event.hits.gz --ice my-ice --json fit.json\n"
      "  floe reconstruct event.h5 --hypothesis hadron --threads 2\n"
      "Exit code 4 when an event has no result: the reason is printed, and stands in the JSON file.");
  app.callback([options] { run_reconstruct(*options); });
}

}  // namespace floe
