// floe reconstruct: position, time, direction and energy of cascades from their hits.
#include <fmt/format.h>

#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/event_arguments.h"
#include "apps/fit_options.h"
#include "apps/model_json.h"
#include "apps/model_warnings.h"
#include "apps/option_values.h"
#include "apps/parallel_events.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "apps/row_journal.h"
#include "data/base/atomic_file.h"
#include "data/base/error.h"
#include "data/event_hash.h"
#include "propagation/model_hash.h"
#include "reco/direct_fit/cascade_fit.h"
#include "reco/direct_fit/sky_map_file.h"
#include "reco/direct_fit/sky_map_picture.h"
#include "reco/event_data.h"

namespace floe {

namespace {

constexpr int sky_map_pixels = 41;

struct ReconstructOptions {
  std::vector<std::string> files;
  ModelRequest model;
  FitSettings fit;
  OutputOptions output;
  std::optional<std::string> sky_map, sky_map_picture;
  bool profile = false;
};

// What is kept of one event: everything that is printed and written.
struct FittedEvent {
  Json json;          // as it stands in the output
  std::string words;  // of the fit, for people
  bool usable = false, track_like = false;
  std::optional<SkyMap> sky_map;
};

FittedEvent result_of(const Event& event, const CascadeFit& fit) {
  return {{{"event", event.id},
           {"status", name_of(fit.status)},
           {"reason", fit.reason},
           {"fit", fit_json(fit)},
           {"seconds", fit.seconds}},
          describe(fit),
          fit.usable(),
          fit.status == FitStatus::track_like,
          fit.sky_map};
}

// Everything of a map, so that a run that goes on later can write it: what is not known becomes null.
Json to_json(const SkyMap& map) {
  return {{"pixels", map.pixels},
          {"step", map.step},
          {"zenith", map.zenith},
          {"azimuth", map.azimuth},
          {"errors_are_wider", map.errors_are_wider},
          {"delta_neg_llh", map.delta_neg_llh}};
}

SkyMap sky_map_of(const Json& json) {
  SkyMap map{json.at("pixels").get<int>(),
             json.at("step").get<double>(),
             json.at("zenith").get<double>(),
             json.at("azimuth").get<double>(),
             {},
             json.at("errors_are_wider").get<bool>()};
  for (const Json& delta : json.at("delta_neg_llh"))
    map.delta_neg_llh.push_back(delta.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                                : delta.get<double>());
  return map;
}

Json row_of(std::size_t index, const FittedEvent& result) {
  return {{"index", index},
          {"result", result.json},
          {"words", result.words},
          {"usable", result.usable},
          {"track_like", result.track_like},
          {"sky_map", result.sky_map ? to_json(*result.sky_map) : Json()}};
}

FittedEvent result_of(const Json& row) {
  FittedEvent result{row.at("result"),
                     row.at("words").get<std::string>(),
                     row.at("usable").get<bool>(),
                     row.at("track_like").get<bool>(),
                     {}};
  if (const Json& map = row.at("sky_map"); !map.is_null()) result.sky_map = sky_map_of(map);
  return result;
}

// All that results depend on.
Json heading_of(const Model& model, const FitOptions& fit, const std::vector<Event>& events) {
  return {{"journal", "floe reconstruct"}, {"fit", cascade_fit_revision},
          {"version", FLOE_VERSION},       {"model", model_hash(model)},
          {"settings", to_json(fit)},      {"sky_map_pixels", fit.sky_map_pixels},
          {"profile", fit.profile},        {"events", hash_of(events)}};
}

// Fits the events over all cores and says what it found, in their order.
class EventRun {
 public:
  EventRun(const std::vector<Event>& events, const Model& model, const FitOptions& fit,
           const OutputOptions& output)
      : events_(events), model_(model), fit_(fit), quiet_(output.quiet), results_(events.size()) {
    if (output.json && events.size() > 1) {
      journal_ = std::make_unique<RowJournal>(*output.json + ".rows", heading_of(model, fit, events),
                                              RowJournal::Mismatch::error);
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
      FittedEvent result = result_of(event, fit);
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
  std::vector<SkyMapOfEvent> sky_maps() const {
    std::vector<SkyMapOfEvent> maps;
    for (std::size_t i = 0; i < events_.size(); ++i)
      if (results_[i]->sky_map) maps.push_back({events_[i].id, *results_[i]->sky_map});
    return maps;
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
      const FittedEvent& result = *results_[said_];
      const std::string& id = events_[said_].id;
      if (result.track_like)
        fmt::print(stderr, "floe: warning: event {}: {}\n", id, result.json["reason"].get<std::string>());
      if (fit_.sky_map_pixels > 0 && result.usable && !result.sky_map)
        fmt::print(stderr, "floe: warning: event {}: no map: the fit ended without its last step\n", id);
      if (fit_.profile && result.usable && !result.json.at("fit").contains("profile"))
        fmt::print(stderr, "floe: warning: event {}: no profile: the fit ended without its last step\n", id);
      if (!quiet_) fmt::print("event {}: {}", id, result.words);
    }
  }

  const std::vector<Event>& events_;
  const Model& model_;
  const FitOptions& fit_;
  bool quiet_;
  std::vector<std::optional<FittedEvent>> results_;
  std::vector<std::size_t> left_;
  std::unique_ptr<RowJournal> journal_;
  std::mutex mutex_;
  std::size_t done_ = 0, said_ = 0;
};

FitOptions fit_options_of(const ReconstructOptions& options) {
  FitOptions fit = to_fit_options(options.fit);
  if (options.sky_map || options.sky_map_picture) fit.sky_map_pixels = sky_map_pixels;
  fit.profile = options.profile;
  return fit;
}

// The truth stands in pictures of simulated cascades; no fit sees it.
std::string picture_of(const Event& event, const SkyMap& map) {
  std::optional<Origin> truth;
  if (event.truth.size() == 1) truth = Origin{event.truth[0].zenith, event.truth[0].azimuth};
  return figure_of_sky_map(map, "event " + event.id, truth);
}

void run_reconstruct(const ReconstructOptions& options) {
  const FitOptions fit_options = fit_options_of(options);
  PlannedOutput json(options.output.json), picture(options.sky_map_picture);
  std::optional<AtomicFile> map_file;
  if (options.sky_map) map_file.emplace(*options.sky_map);
  const std::vector<Event> events = read_events(options.files);
  if (options.sky_map_picture && events.size() != 1)
    throw UsageError(fmt::format(
        "--skymap-picture: found {} events; expected one (--skymap writes the maps of many)", events.size()));
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
  const std::vector<SkyMapOfEvent> maps = run.sky_maps();
  if (!maps.empty()) picture.write(picture_of(events.front(), maps.front().map));
  if (map_file) write_sky_maps(*map_file, {FLOE_VERSION, model.ice->name(), model.ice->hash()}, maps);
  picture.commit();
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
  add_output_file(app, "--skymap", ".h5", "Write maps of -ln L over directions to this file",
                  options->sky_map);
  add_picture(app, "--skymap-picture", "Draw the map, of one event", options->sky_map_picture);
  app.add_flag("--profile", options->profile, "Intervals of the profile likelihood: errors on both sides");
  app.footer(
      "Examples:\n"
      "  floe reconstruct event.h5\n"
      "  floe reconstruct event.hits.gz --ice my-ice --json fit.json\n"
      "  floe reconstruct event.h5 --hypothesis hadron --threads 2\n"
      "  floe reconstruct event.h5 --skymap map.h5 --skymap-picture map.svg --profile\n"
      "  floe reconstruct run.h5 --json fits.json --bad 21,30 --noise-rate 500 --charge-cap 300\n"
      "Many events run side by side. With --json each is kept in FILE.rows as soon as it is done,\n"
      "and the same command goes on where a stopped one was.\n"
      "Exit code 4 when an event has no result: the reason is printed, and stands in the JSON file.");
  app.callback([options] { run_reconstruct(*options); });
}

}  // namespace floe
