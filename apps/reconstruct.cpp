// floe reconstruct: position, time, direction and energy of cascades from their hits.
#include <fmt/format.h>

#include <memory>
#include <mutex>
#include <optional>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/event_arguments.h"
#include "apps/fit_options.h"
#include "apps/model_json.h"
#include "apps/model_warnings.h"
#include "apps/parallel_events.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "apps/row_journal.h"
#include "data/base/error.h"
#include "data/base/hash.h"
#include "reco/direct_fit/cascade_fit.h"
#include "reco/event_data.h"

namespace floe {

namespace {

struct ReconstructOptions {
  std::vector<std::string> files;
  ModelRequest model;
  FitSettings fit;
  OutputOptions output;
};

// What is kept of one event: everything that is printed and written.
struct EventResult {
  Json json;          // as it stands in the output
  std::string words;  // of the fit, for people
  bool usable = false, track_like = false;
};

EventResult result_of(const Event& event, const CascadeFit& fit) {
  return {{{"event", event.id},
           {"status", name_of(fit.status)},
           {"reason", fit.reason},
           {"fit", fit_json(fit)},
           {"seconds", fit.seconds}},
          describe(fit),
          fit.usable(),
          fit.status == FitStatus::track_like};
}

Json row_of(std::size_t index, const EventResult& result) {
  return {{"index", index},
          {"result", result.json},
          {"words", result.words},
          {"usable", result.usable},
          {"track_like", result.track_like}};
}

EventResult result_of(const Json& row) {
  return {row.at("result"), row.at("words").get<std::string>(), row.at("usable").get<bool>(),
          row.at("track_like").get<bool>()};
}

std::string hash_of(const std::vector<Event>& events) {
  Hasher hasher;
  for (const Event& event : events) {
    hasher.add(event.id).add(event.repeats).add(event.hits.size());
    for (const Hit& hit : event.hits)
      hasher.add(hit.module.string).add(hit.module.dom).add(hit.time).add(double(hit.charge));
  }
  return hasher.hex();
}

// All that results depend on.
Json heading_of(const Model& model, const FitOptions& fit, const std::vector<Event>& events) {
  return {{"journal", "floe reconstruct 1"},
          {"version", FLOE_VERSION},
          {"model", to_json(model)},
          {"settings", to_json(fit)},
          {"events", hash_of(events)}};
}

// Fits the events over all cores and says what it found, in their order.
class EventRun {
 public:
  EventRun(const std::vector<Event>& events, const Model& model, const FitOptions& fit,
           const OutputOptions& output)
      : events_(events), model_(model), fit_(fit), quiet_(output.quiet), results_(events.size()) {
    if (output.json && events.size() > 1) {
      journal_ = std::make_unique<RowJournal>(*output.json + ".rows", heading_of(model, fit, events),
                                              RowJournal::Mismatch::start_again);
      for (const Json& row : journal_->rows())
        results_.at(row.at("index").get<std::size_t>()) = result_of(row);
    }
    for (std::size_t i = 0; i < events.size(); ++i)
      if (!results_[i]) left_.push_back(i);
    if (left_.size() < events.size())
      fmt::print(stderr, "floe: going on after {} of {} events, found in {}.rows\n",
                 events.size() - left_.size(), events.size(), *output.json);
  }

  void run() {
    ProgressBar bar(quiet_);
    const Progress progress = bar.callback();
    say();
    for_each_event(left_.size(), fit_.threads, [&](std::size_t i, int threads) {
      FitOptions options = fit_;
      options.threads = threads;
      const Event& event = events_[left_[i]];
      const CascadeFit fit = fit_cascade(model_, event, options, events_.size() == 1 ? progress : Progress());
      EventResult result = result_of(event, fit);
      if (journal_) journal_->append(row_of(left_[i], result));
      const std::lock_guard lock(mutex_);
      results_[left_[i]] = std::move(result);
      ++done_;
      if (progress && events_.size() > 1)
        progress(double(done_) / double(left_.size()), fmt::format("{} of {} events", done_, left_.size()));
      say();
    });
  }

  Json json() const {
    Json list = Json::array();
    for (const auto& result : results_) list.push_back(result->json);
    return list;
  }
  // "event NAME: REASON" of those without result, a line each.
  std::string failures() const {
    std::string text;
    for (std::size_t i = 0; i < events_.size(); ++i)
      if (!results_[i]->usable)
        text += fmt::format("{}event {}: {}", text.empty() ? "" : "\n", events_[i].id,
                            results_[i]->json["reason"].get<std::string>());
    return text;
  }
  void finish() {
    if (journal_) journal_->remove();
  }

 private:
  // What is known of the events that are next in order.
  void say() {
    for (; said_ < results_.size() && results_[said_]; ++said_) {
      const EventResult& result = *results_[said_];
      const std::string& id = events_[said_].id;
      if (result.track_like)
        fmt::print(stderr, "floe: warning: event {}: {}\n", id, result.json["reason"].get<std::string>());
      if (!quiet_) fmt::print("event {}: {}", id, result.words);
    }
  }

  const std::vector<Event>& events_;
  const Model& model_;
  const FitOptions& fit_;
  bool quiet_;
  std::vector<std::optional<EventResult>> results_;
  std::vector<std::size_t> left_;
  std::unique_ptr<RowJournal> journal_;
  std::mutex mutex_;
  std::size_t done_ = 0, said_ = 0;
};

void run_reconstruct(const ReconstructOptions& options) {
  const FitOptions fit_options = to_fit_options(options.fit);
  PlannedOutput json(options.output.json);
  const std::vector<Event> events = read_events(options.files);
  const Model model = load_model(options.model);
  // A bad event is found before the work on others begins.
  for (const Event& event : events) EventData(*model.detector, event, fit_options.selection);

  Json results = {{"model", to_json(model)},
                  {"seed", fit_options.seed},
                  {"warnings", warn_of_model(model, fit_options.oversize)}};
  EventRun run(events, model, fit_options, options.output);
  run.run();
  results["events"] = run.json();
  json.write(json_text(results));
  json.commit();
  run.finish();
  const std::string failures = run.failures();
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
      "  floe reconstruct run.h5 --json fits.json --bad 21,30 --noise-rate 500 --charge-cap 300\n"
      "Many events run side by side. With --json each is kept in FILE.rows as soon as it is done,\n"
      "and the same command goes on where a stopped one was.\n"
      "Exit code 4 when an event has no result: the reason is printed, and stands in the JSON file.");
  app.callback([options] { run_reconstruct(*options); });
}

}  // namespace floe
