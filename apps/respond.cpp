// floe respond: what the modules' electronics make of detected photons.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/event_arguments.h"
#include "apps/event_parts.h"
#include "apps/fit_options.h"
#include "apps/option_values.h"
#include "apps/parallel_events.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "data/base/atomic_file.h"
#include "data/base/error.h"
#include "data/base/file_hash.h"
#include "data/base/words.h"
#include "data/event_stream.h"
#include "data/hdf5_reader.h"
#include "response/detector_response.h"
#include "response/response_file.h"

namespace floe {

namespace {

// What the file holds beside pulses.
struct Kept {
  bool truth = true, photons = false;
  ResponseRecord record;
};

struct RespondOptions {
  std::string from, to;
  std::optional<std::string> response, write_response;
  std::vector<std::string> off;
  std::string keep = "truth,pulses";
  ModelRequest model;
  SimulationSettings settings;
  OutputOptions output;
};

Kept parse_kept(const std::string& list) {
  Kept kept{false, false, {}};
  for (const std::string& name : split_list(list)) {
    if (name == "truth")
      kept.truth = true;
    else if (name == "photons")
      kept.photons = true;
    else if (name == "photoelectrons")
      kept.record.photoelectrons = true;
    else if (name == "waveforms")
      kept.record.waveforms = true;
    else if (name != "pulses")  // which are always there
      throw UsageError(fmt::format(
          "--keep: found \"{}\"; expected truth, photons, photoelectrons, waveforms or pulses, with commas",
          name));
  }
  return kept;
}

Json to_json(const ResponseSettings& settings) {
  ResponseSettings copy = settings;
  Json json = Json::object();
  for (const ResponseSetting& setting : list_of(copy)) {
    Json& place = json[setting.section][setting.key];
    if (const auto* number = std::get_if<double*>(&setting.value))
      place = **number;
    else if (const auto* whole = std::get_if<int*>(&setting.value))
      place = **whole;
    else
      place = name_of(*std::get<CoincidenceMode*>(setting.value));
  }
  return json;
}

std::string name_of_module(ModuleId id) {
  return fmt::format("{},{}", id.string, id.dom);
}

// Everything that results depend on.
Json configuration_of(const RespondOptions& options, const ResponseSettings& settings,
                      const std::vector<ModuleId>& off, const Detector& detector, const Provenance& input) {
  Json silent = Json::array();
  for (const ModuleId id : off) silent.push_back(name_of_module(id));
  Json before = Json::parse(input.configuration, nullptr, false);
  return {{"command", "respond"},
          {"input", {{"file", options.from}, {"configuration", before.is_discarded() ? Json() : before}}},
          {"detector", {{"name", detector.name()}, {"hash", detector.hash()}}},
          {"off", silent},
          {"keep", options.keep},
          {"seed", options.settings.seed},
          {"response", to_json(settings)}};
}

Provenance provenance_of(const RespondOptions& options, const Json& configuration, const Detector& detector,
                         const Provenance& input, const std::string& command_line) {
  Provenance provenance = input;
  provenance.version = FLOE_VERSION;
  provenance.command = command_line;
  provenance.configuration = json_line(configuration);
  provenance.detector_name = detector.name();
  provenance.detector_hash = detector.hash();
  provenance.seed = options.settings.seed;
  provenance.weighted = false;  // photons were taken or not, by their weights
  provenance.pulses = true;
  return provenance;
}

// What there is to say of an event.
Json row_of(const Event& photons, const RespondedEvent& responded) {
  double light = 0, charge = 0;
  for (const Hit& hit : photons.hits) light += hit.charge;
  std::set<ModuleId> modules, saturated;
  for (const Hit& hit : responded.event.hits) {
    charge += hit.charge;
    modules.insert(hit.module);
  }
  for (const UnusableTimes& times : responded.event.readout->unusable)
    if (times.reason == UnusableTimes::Reason::saturated) saturated.insert(times.module);
  return {{"event", photons.id},
          {"photons", light},
          {"pulses", responded.event.hits.size()},
          {"charge_pe", charge},
          {"modules", modules.size()},
          {"saturated_modules", saturated.size()},
          {"launches", responded.launches},
          {"hard_launches", responded.hard_launches}};
}

void write_responded(EventFileWriter& writer, const RespondedEvent& responded,
                     const std::vector<Hit>& photons, const Kept& kept) {
  writer.begin_event(responded.event);
  writer.append(responded.event.hits);
  if (kept.photons) writer.append_photons(photons);
  if (kept.record.photoelectrons) writer.append_photoelectrons(responded.photoelectrons);
  if (kept.record.waveforms) writer.append_waveforms(responded.waveforms);
}

void copy_part(const std::filesystem::path& part, EventFileWriter& writer, const Kept& kept) {
  const EventFileReader reader(part);
  RespondedEvent responded;
  responded.event = reader.read(0);
  responded.photoelectrons = reader.photoelectrons(0);
  responded.waveforms = reader.waveforms(0);
  write_responded(writer, responded, reader.photons(0), kept);
}

void print_row(const Json& row) {
  fmt::print(
      "event {}: {:.6g} photons, {:.6g} pe in {} pulses of {} modules ({} launches, {} in coincidence{})\n",
      row["event"].get<std::string>(), row["photons"].get<double>(), row["charge_pe"].get<double>(),
      row["pulses"].get<std::size_t>(), row["modules"].get<std::size_t>(), row["launches"].get<std::size_t>(),
      row["hard_launches"].get<std::size_t>(),
      row["saturated_modules"] == 0
          ? ""
          : fmt::format("; {} modules saturated", row["saturated_modules"].get<std::size_t>()));
}

// Responds to the events that no earlier run has done, over all cores.
void respond_to_all(const EventFileReader& reader, const DetectorResponse& response,
                    const RespondOptions& options, const Kept& kept, const Provenance& provenance,
                    EventParts& parts) {
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < reader.size(); ++i)
    if (!parts.row(i)) left.push_back(i);
  ProgressBar bar(options.output.quiet);
  const Progress progress = bar.callback();
  std::size_t done = 0;
  for_each_event(left.size(), options.settings.threads, [&](std::size_t k, int threads) {
    const Event event = [&] {
      const auto locked = parts.lock();
      return reader.read(left[k]);
    }();
    RespondedEvent responded = response.respond(event, kept.record, threads);
    if (!kept.truth) responded.event.truth.clear();
    parts.add(
        left[k], provenance,
        [&](EventFileWriter& writer) { write_responded(writer, responded, event.hits, kept); },
        row_of(event, responded));
    const auto locked = parts.lock();
    ++done;
    if (progress)
      progress(double(done) / double(left.size()), fmt::format("{} of {} events", done, left.size()));
  });
}

void check_usage(const RespondOptions& options) {
  if (options.write_response) {
    if (!options.from.empty() || !options.to.empty())
      throw UsageError("--write-response writes settings and nothing else: leave EVENTS and --output out");
    return;
  }
  if (options.from.empty() || options.to.empty())
    throw UsageError("give EVENTS.h5 and -o FILE.h5, or --write-response FILE.toml");
  require_event_file_name(options.to);
}

std::vector<ModuleId> modules_off(const RespondOptions& options) {
  std::vector<ModuleId> off;
  for (const std::string& text : options.off)
    for (const ModuleId id : parse_modules("--off", text)) off.push_back(id);
  return off;
}

void expect_hdf5(const std::string& name) {
  if (!is_hdf5(name))
    throw InputError({name}, "a file that is not HDF5", "an event file of floe",
                     "floe import makes one of a text of hits");
}

void check_input(const std::string& name, const Provenance& input, const Detector& detector) {
  if (input.pulses)
    throw InputError({name}, "pulses, which are no photons", "an event file with photons",
                     "What floe respond writes has been through the electronics already");
  if (!input.detector_hash.empty() && input.detector_hash != detector.hash())
    fmt::print(stderr,
               "floe: warning: {}: events of detector {}, not of {}; name it with --ice or --detector\n",
               name, input.detector_name, detector.name());
}

Json results_of(const RespondOptions& options, const EventParts& parts, std::size_t events) {
  Json results = {{"output", options.to}, {"seed", options.settings.seed}, {"events", Json::array()}};
  for (std::size_t i = 0; i < events; ++i) {
    results["events"].push_back(*parts.row(i));
    results["events"].back().erase("event_row");
  }
  return results;
}

void respond_to_file(const RespondOptions& options, const ResponseSettings& settings,
                     const std::string& command_line) {
  const Kept kept = parse_kept(options.keep);
  PlannedOutput json(options.output.json);
  expect_hdf5(options.from);
  const Model model = load_model(options.model);
  const Detector& detector = *model.detector;
  const std::vector<ModuleId> off = modules_off(options);
  const EventFileReader reader(options.from);
  check_input(options.from, reader.provenance(), detector);
  const DetectorResponse response(detector, settings, options.settings.seed, off);
  const Json configuration = configuration_of(options, settings, off, detector, reader.provenance());
  const Provenance provenance =
      provenance_of(options, configuration, detector, reader.provenance(), command_line);
  EventParts parts(options.to,
                   {{"journal", "floe respond 1"},
                    {"version", FLOE_VERSION},
                    {"input", hash_of_file(options.from)},
                    {"configuration", configuration}},
                   reader.size());
  if (parts.found() > 0)
    fmt::print(stderr, "floe: going on after {} of {} events, found in {}.parts\n", parts.found(),
               reader.size(), options.to);
  respond_to_all(reader, response, options, kept, provenance, parts);
  const Json results = results_of(options, parts, reader.size());
  json.write(json_text(results));
  parts.finish(provenance, [&](const auto& part, EventFileWriter& writer) { copy_part(part, writer, kept); });
  json.commit();
  if (options.output.quiet) return;
  for (const Json& row : results["events"]) print_row(row);
}

void run_respond(const RespondOptions& options, const std::string& command_line) {
  const ResponseSettings settings =
      options.response ? read_response_file(*options.response) : ResponseSettings();
  check_usage(options);
  if (options.write_response)
    write_whole_file(*options.write_response, response_file_text(settings));
  else
    respond_to_file(options, settings, command_line);
}

}  // namespace

void add_respond(CLI::App& floe, const std::string& command_line) {
  CLI::App& app =
      *floe.add_subcommand("respond", "Simulate the modules' electronics: from photons to pulses");
  const auto options = std::make_shared<RespondOptions>();
  app.add_option("EVENTS", options->from, "Event file with photons")->type_name("FILE.h5");
  app.add_option("-o,--output", options->to, "Event file to write: the hits are pulses")
      ->type_name("FILE.h5");
  app.add_option("--response", options->response,
                 "Settings of the electronics; what it does not name is as built in")
      ->type_name("FILE.toml");
  app.add_option("--write-response", options->write_response,
                 "Write all settings, with what they mean and their sources, and end")
      ->type_name("FILE.toml");
  app.add_option("--keep", options->keep,
                 "What the file holds: truth, photons, photoelectrons, waveforms, pulses (always)")
      ->type_name("NAME[,NAME]")
      ->capture_default_str();
  app.add_option("--off", options->off, "Modules that are switched off, or a file with STRING DOM on a line")
      ->type_name("STRING,DOM[;...]|FILE")
      ->allow_extra_args(false);
  add_model_options(app, options->model);
  add_run_options(app, options->settings);
  add_output_options(app, options->output);
  app.footer(
      "Examples:\n"
      "  floe respond event.h5 -o pulses.h5\n"
      "  floe respond event.h5 -o pulses.h5 --keep truth,photons,waveforms --off '21,30;36,12' --seed 2\n"
      "  floe respond --write-response response.toml\n"
      "  floe respond runs.h5 --response response.toml -o measured.h5\n"
      "Of the model only the detector matters. Each event is kept in OUTPUT.parts as soon as it is done,\n"
      "and the same command goes on where a stopped one was.");
  app.callback([options, command_line] { run_respond(*options, command_line); });
}

}  // namespace floe
