// floe view: an event as a page to look at, in any browser, without a network.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/option_values.h"
#include "apps/view/page.h"
#include "apps/view/page_data.h"
#include "data/base/error.h"
#include "data/event_files.h"
#include "data/event_stream.h"

namespace floe {

namespace {

struct ViewOptions {
  ModelRequest model;
  OutputOptions output;
  std::string events, event, fit;
  std::optional<std::string> page;  // none: named after the event file
  bool ice = false;                 // whether --ice was given: then it is shown
};

// The index of the event of this name, or 0 when none was named.
std::size_t index_of(const std::vector<Event>& events, const std::string& id) {
  std::string known;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (id.empty() || events[i].id == id) return i;
    if (i < 20) known += (i == 0 ? "" : ", ") + events[i].id;
  }
  throw UsageError(fmt::format("--event: found \"{}\"; expected one of {}{}", id, known,
                               events.size() > 20 ? ", ..." : ""));
}

// What the file says of its source of light.
std::string source_of(const std::optional<Provenance>& provenance) {
  if (!provenance) return "";
  const Json configuration = Json::parse(provenance->configuration, nullptr, false);
  return configuration.is_object() && configuration.contains("source") ? json_line(configuration["source"])
                                                                       : "";
}

void warn_of_another_detector(const std::optional<Provenance>& provenance, const Detector& detector) {
  if (provenance && !provenance->detector_hash.empty() && provenance->detector_hash != detector.hash())
    fmt::print(stderr,
               "floe: warning: the event was simulated with the detector {}, and is shown with {}, which is "
               "another one; --ice or --detector names the right one\n",
               provenance->detector_name, detector.name());
}

std::string page_name(const ViewOptions& options) {
  if (options.page) return *options.page;
  std::filesystem::path name = std::filesystem::path(options.events).filename();
  if (name.extension() == ".gz") name = name.stem();
  return name.replace_extension(".html").string();
}

EventToShow read_event(const ViewOptions& options, const Detector& detector, std::size_t& count) {
  EventFile file = read_event_file(options.events);
  warn_of_another_detector(file.provenance, detector);
  count = file.events.size();
  const std::size_t index = index_of(file.events, options.event);
  EventToShow shown;
  shown.file = std::filesystem::path(options.events).filename().string();
  shown.event = std::move(file.events[index]);
  shown.source = source_of(file.provenance);
  // Files of other programs hold none.
  if (file.provenance) shown.waveforms = EventFileReader(options.events).waveforms(index);
  std::erase_if(shown.waveforms, [](const ModuleWaveform& waveform) { return waveform.repeat > 0; });
  if (!options.fit.empty()) shown.fit = read_fit_results(options.fit, options.events, shown.event.id);
  return shown;
}

void say_what_is_missing(const EventToShow& shown, const LightCurves& curves, const Detector& detector) {
  if (shown.fit && shown.fit->fits.empty())
    fmt::print(stderr, "floe: warning: event {} has no fit to show: {}\n", shown.event.id, shown.fit->status);
  if (curves.left_out > 0)
    fmt::print(stderr, "floe: warning: {} hits are of modules that the detector {} does not have\n",
               curves.left_out, detector.name());
}

void run_view(const ViewOptions& options) {
  const std::string page = page_name(options);
  PlannedOutput output(page), json(options.output.json);
  const Model model = load_model(options.model);
  const Detector& detector = *model.detector;
  std::size_t events = 0;
  const EventToShow shown = read_event(options, detector, events);
  const LightCurves curves = light_curves(shown.event.hits, detector);
  const Json data = page_data(shown, curves, detector, options.ice ? model.ice.get() : nullptr);
  say_what_is_missing(shown, curves, detector);
  output.write(event_page("floe: event " + shown.event.id, data));
  json.write(json_text(data));
  output.commit();
  json.commit();
  if (options.output.quiet) return;
  fmt::print("{}: event {}, {} hits in {} modules, light curves in bins of {:g} ns\n", page, shown.event.id,
             shown.event.hits.size(), curves.modules.size(), curves.bin_width);
  if (options.event.empty() && events > 1)
    fmt::print("{} more events are in {}; --event ID shows another\n", events - 1, options.events);
}

}  // namespace

void add_view(CLI::App& floe) {
  CLI::App& app =
      *floe.add_subcommand("view", "Show an event in 3D: a page for any browser, without a network");
  const auto options = std::make_shared<ViewOptions>();
  app.add_option("EVENTS", options->events, "Event file: .h5, or text .hits, .dat, also with .gz")
      ->type_name("FILE")
      ->required();
  app.add_option("--event", options->event, "Of this name; default: the file's first")->type_name("ID");
  app.add_option("--fit", options->fit, "Its fit, as floe reconstruct --json or floe compare --json wrote it")
      ->type_name("FIT.json");
  add_output_file(app, "-o,--output", ".html", "Page to write; default: named after the event file",
                  options->page);
  add_model_options(app, options->model);
  app.get_option("--ice")->description(
      "Ice-model directory, or south-pole: its dust and flow are shown, and its detector is taken");
  add_output_options(app, options->output);
  app.get_option("--json")->description("Also write what the page shows to FILE");
  app.footer(
      "Examples:\n"
      "  floe view event.h5\n"
      "  floe view event.h5 --fit fit.json --ice south-pole -o event.html\n"
      "  floe view runs.h5 --event 63,20 -o flasher.html");
  app.callback([options, &app] {
    options->ice = app.count("--ice") > 0;
    run_view(*options);
  });
}

}  // namespace floe
