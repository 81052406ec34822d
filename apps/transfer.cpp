// floe import, floe export: between floe's event files and the texts of other tools.
#include <fmt/format.h>

#include <map>
#include <memory>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/event_arguments.h"
#include "apps/option_values.h"
#include "apps/planned_output.h"
#include "data/base/error.h"
#include "data/event_files.h"

namespace floe {

namespace {

struct TransferOptions {
  std::string from, to;
  std::string format;  // of export; empty: by suffix
  std::string event;   // of export; empty: all
  OutputOptions output;
};

Json results_json(const std::string& output, const std::vector<Event>& events) {
  Json json = {{"output", output}, {"events", Json::array()}};
  for (const Event& event : events)
    json["events"].push_back({{"event", event.id}, {"hits", event.hits.size()}});
  return json;
}

void print_results(const TransferOptions& options, const std::vector<Event>& events) {
  if (options.output.quiet) return;
  std::size_t hits = 0;
  for (const Event& event : events) hits += event.hits.size();
  fmt::print("{}: {} event{}, {} hits\n", options.to, events.size(), events.size() == 1 ? "" : "s", hits);
}

EventFormat format_of(const TransferOptions& options) {
  if (options.format.empty()) return event_format_of(options.to);
  static const std::map<std::string, EventFormat> formats{
      {"hits", EventFormat::hits}, {"dat", EventFormat::dat}, {"csv", EventFormat::csv}};
  const auto found = formats.find(options.format);
  if (found == formats.end())
    throw UsageError(fmt::format("--format: found \"{}\"; expected hits, dat or csv", options.format));
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
  json.write(json_text(results_json(options.to, events)));
  export_events(options.to, format, events);
  json.commit();
  print_results(options, events);
}

void run_import(const TransferOptions& options, const std::string& command_line) {
  require_event_file_name(options.to);
  PlannedOutput json(options.output.json);
  const std::vector<Event> events = read_event_file(options.from).events;
  Provenance provenance;
  provenance.version = FLOE_VERSION;
  provenance.command = command_line;
  provenance.configuration = Json{{"command", "import"}, {"input", options.from}}.dump();
  EventFileWriter writer(options.to, provenance);
  for (const Event& event : events) {
    writer.begin_event(event.id, event.truth, event.repeats);
    writer.append(event.hits);
  }
  json.write(json_text(results_json(options.to, events)));
  writer.close();
  json.commit();
  print_results(options, events);
}

}  // namespace

void add_export(CLI::App& floe) {
  CLI::App& app = *floe.add_subcommand("export", "Write an event file as text for other tools");
  const auto options = std::make_shared<TransferOptions>();
  app.add_option("FILE", options->from, "Event file to read")->type_name("FILE")->required();
  app.add_option("-o,--output", options->to,
                 "Text to write; the format follows the suffix: .hits, .dat, .csv, also with .gz")
      ->type_name("OUT")
      ->required();
  app.add_option("--format", options->format, "hits, dat or csv, whatever the suffix")->type_name("NAME");
  app.add_option("--event", options->event, "Only the event of this name")->type_name("NAME");
  add_output_options(app, options->output);
  app.footer(
      "Examples:\n"
      "  floe export event.h5 -o event.hits\n"
      "  floe export event.h5 -o charges.dat.gz\n"
      "  floe export event.h5 -o table.txt --format csv");
  app.callback([options] { run_export(*options); });
}

void add_import(CLI::App& floe, const std::string& command_line) {
  CLI::App& app = *floe.add_subcommand("import", "Read a text of hits or charges into an event file");
  const auto options = std::make_shared<TransferOptions>();
  app.add_option("IN", options->from, "Text to read: .hits, .dat, also with .gz")
      ->type_name("FILE")
      ->required();
  app.add_option("-o,--output", options->to, "Event file to write")->type_name("FILE.h5")->required();
  add_output_options(app, options->output);
  app.footer(
      "Examples:\n"
      "  floe import event.hits -o imported.h5\n"
      "  floe import charges.dat.gz -o charges.h5");
  app.callback([options, command_line] { run_import(*options, command_line); });
}

}  // namespace floe
