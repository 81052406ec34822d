// floe import, floe export: between floe's event files and the texts of other tools.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/event_arguments.h"
#include "apps/option_values.h"
#include "apps/planned_output.h"
#include "data/base/error.h"
#include "data/event_files.h"
#include "data/flasher_text.h"
#include "data/icetray_tables.h"

namespace floe {

namespace {

struct TransferOptions {
  std::string from, to;
  std::string format;                // of export; empty: by suffix
  std::string event;                 // of export; empty: all
  bool flashers = false;             // of import: a set of flasher runs
  std::optional<std::string> table;  // of import: of an IceTray file with several
  OutputOptions output;
};

// What is left to say of an event once its hits are written.
struct Transferred {
  std::string id;
  std::size_t hits;
};

std::vector<Transferred> transferred(const std::vector<Event>& events) {
  std::vector<Transferred> result;
  for (const Event& event : events) result.push_back({event.id, event.hits.size()});
  return result;
}

Json results_json(const std::string& output, const std::vector<Transferred>& events) {
  Json json = {{"output", output}, {"events", Json::array()}};
  for (const Transferred& event : events)
    json["events"].push_back({{"event", event.id}, {"hits", event.hits}});
  return json;
}

void print_results(const TransferOptions& options, const std::vector<Transferred>& events) {
  if (options.output.quiet) return;
  std::size_t hits = 0;
  for (const Transferred& event : events) hits += event.hits;
  fmt::print("{}: {} event{}, {} hits\n", options.to, events.size(), events.size() == 1 ? "" : "s", hits);
}

EventFormat format_of(const TransferOptions& options) {
  if (options.format.empty()) return event_format_of(options.to);
  static const std::map<std::string, EventFormat> formats{{"hits", EventFormat::hits},
                                                          {"dat", EventFormat::dat},
                                                          {"csv", EventFormat::csv},
                                                          {"icetray", EventFormat::icetray}};
  const auto found = formats.find(options.format);
  if (found == formats.end())
    throw UsageError(
        fmt::format("--format: found \"{}\"; expected hits, dat, csv or icetray", options.format));
  return found->second;
}

void keep_only(std::vector<Event>& events, const std::string& id) {
  std::string known;
  for (const Event& event : events) known += (known.empty() ? "" : ", ") + event.id;
  std::erase_if(events, [&id](const Event& event) { return event.id != id; });
  if (events.empty()) throw UsageError(fmt::format("--event: found \"{}\"; expected one of {}", id, known));
}

void run_export(const TransferOptions& options) {
  const EventFormat format = format_of(options);
  PlannedOutput json(options.output.json);
  std::vector<Event> events = read_event_file(options.from).events;
  if (!options.event.empty()) keep_only(events, options.event);
  const std::vector<Transferred> results = transferred(events);
  json.write(json_text(results_json(options.to, results)));
  export_events(options.to, format, events);
  json.commit();
  print_results(options, results);
}

Provenance provenance_of(const TransferOptions& options, const std::string& command_line) {
  Provenance provenance;
  provenance.version = FLOE_VERSION;
  provenance.command = command_line;
  Json configuration = {{"command", "import"}, {"input", options.from}};
  if (options.flashers) configuration["flashers"] = true;
  provenance.configuration = json_line(configuration);
  return provenance;
}

void write_event(EventFileWriter& writer, const Event& event) {
  writer.begin_event(event);
  writer.append(event.hits);
}

// An event file knows more than its events: weights, how it was made, what stands beside pulses.
std::vector<Event> events_to_import(const TransferOptions& options) {
  if (options.table) return read_icetray_pulses(options.from, options.table);
  EventFile file = read_event_file(options.from);
  if (file.provenance)
    throw InputError({options.from}, "an event file of floe, which all commands read as it is",
                     "a text of hits or charges, or pulses of IceTray's HDF5 writer");
  return std::move(file.events);
}

bool has_widths(const Event& event) {
  return std::any_of(event.hits.begin(), event.hits.end(),
                     [](const Hit& hit) { return !std::isnan(hit.width); });
}

void import_events(const TransferOptions& options, Provenance provenance,
                   std::optional<EventFileWriter>& writer, std::vector<Transferred>& results) {
  const std::vector<Event> events = events_to_import(options);
  provenance.pulses = std::any_of(events.begin(), events.end(), has_widths);
  writer.emplace(options.to, provenance);
  for (const Event& event : events) write_event(*writer, event);
  results = transferred(events);
}

// The file's oversize is that of the first run; each run says its own.
void import_flashers(const TransferOptions& options, Provenance provenance,
                     std::optional<EventFileWriter>& writer, std::vector<Transferred>& results) {
  for_each_flasher_run(options.from, [&](const Event& run) {
    provenance.oversize = run.flasher->oversize;
    if (!writer) writer.emplace(options.to, provenance);
    write_event(*writer, run);
    results.push_back({run.id, run.hits.size()});
  });
}

void run_import(const TransferOptions& options, const std::string& command_line) {
  require_event_file_name(options.to);
  PlannedOutput json(options.output.json);
  std::optional<EventFileWriter> writer;
  std::vector<Transferred> results;
  const auto transfer = options.flashers ? import_flashers : import_events;
  transfer(options, provenance_of(options, command_line), writer, results);
  json.write(json_text(results_json(options.to, results)));
  writer->close();
  json.commit();
  print_results(options, results);
}

}  // namespace

void add_export(CLI::App& floe) {
  CLI::App& app = *floe.add_subcommand("export", "Write an event file for other tools");
  const auto options = std::make_shared<TransferOptions>();
  app.add_option("FILE", options->from, "Event file to read")->type_name("FILE")->required();
  app.add_option("-o,--output", options->to,
                 "File to write; the format follows the suffix: .hits, .dat, .csv, also with .gz, or .i3.h5")
      ->type_name("OUT")
      ->required();
  app.add_option("--format", options->format, "hits, dat, csv or icetray, whatever the suffix")
      ->type_name("NAME");
  app.add_option("--event", options->event, "Only the event of this name")->type_name("NAME");
  add_output_options(app, options->output);
  app.footer(
      "Examples:\n"
      "  floe export event.h5 -o event.hits\n"
      "  floe export event.h5 -o charges.dat.gz\n"
      "  floe export event.h5 -o table.txt --format csv\n"
      "  floe export runs.h5 -o runs.hits\n"
      "  floe export event.h5 -o pulses.i3.h5");
  app.callback([options] { run_export(*options); });
}

void add_import(CLI::App& floe, const std::string& command_line) {
  CLI::App& app = *floe.add_subcommand(
      "import", "Read a text of hits or charges, or IceTray's pulses, into an event file");
  const auto options = std::make_shared<TransferOptions>();
  app.add_option("IN", options->from,
                 "File to read: .hits, .dat, also with .gz, or pulses of IceTray's HDF5 writer")
      ->type_name("FILE")
      ->required();
  app.add_option("-o,--output", options->to, "Event file to write")->type_name("FILE.h5")->required();
  app.add_flag(
      "--flashers", options->flashers,
      "The text is a set of flasher runs, each opened by a FLASHER line: .hits, .txt, or .dat with charges "
      "that are averages over the flashes");
  app.add_option("--table", options->table, "Of an IceTray file with several tables of pulses")
      ->type_name("NAME");
  add_output_options(app, options->output);
  app.footer(
      "Examples:\n"
      "  floe import event.hits -o imported.h5\n"
      "  floe import charges.dat.gz -o charges.h5\n"
      "  floe import --flashers runs.hits -o imported-runs.h5");
  app.callback([options, command_line] { run_import(*options, command_line); });
}

}  // namespace floe
