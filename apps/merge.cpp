// floe merge: the shards of one simulation, or the events of several files, in one file.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/event_arguments.h"
#include "apps/planned_output.h"
#include "data/base/error.h"
#include "data/event_files.h"
#include "data/event_rules.h"
#include "data/event_stream.h"

namespace floe {

namespace {

struct MergeOptions {
  std::vector<std::string> from;
  std::string to;
  OutputOptions output;
};

struct Part {
  std::string file;
  EventFileReader events;
  Json configuration;
  std::uint64_t shard = 1, shards = 1;
};

Part open_part(const std::string& file) {
  Part part{file, EventFileReader(file), {}, 1, 1};
  if (part.events.provenance().weighted) read_event_file(file);  // its sums are of the whole file
  part.configuration = Json::parse(part.events.provenance().configuration, nullptr, false);
  if (part.configuration.is_object() && part.configuration.contains("shard")) {
    const Json& shard = part.configuration["shard"];
    if (!shard.is_array() || shard.size() != 2 || !shard[0].is_number_unsigned() ||
        !shard[1].is_number_unsigned())
      throw InputError({file}, "a shard " + json_line(shard),
                       "two whole numbers, [k, K], in its configuration");
    part.shard = shard[0];
    part.shards = shard[1];
    if (part.shards > most_shards)
      throw InputError({file}, fmt::format("{} shards", part.shards), fmt::format("at most {}", most_shards));
    part.configuration.erase("shard");
  }
  return part;
}

// Shards belong together when everything but their number is the same, and none is missing or there twice.
void check_shards(const std::vector<Part>& parts) {
  const Part& first = parts.front();
  const Provenance& source = first.events.provenance();
  std::vector<const Part*> found(first.shards, nullptr);
  for (const Part& part : parts) {
    const Provenance& other = part.events.provenance();
    if (part.shards != first.shards)
      throw InputError({part.file}, fmt::format("shard {} of {}", part.shard, part.shards),
                       fmt::format("one of {} shards, like {}", first.shards, first.file));
    if (part.configuration != first.configuration || other.ice_hash != source.ice_hash ||
        other.detector_hash != source.detector_hash || other.version != source.version)
      throw InputError({part.file}, "a shard of another simulation",
                       fmt::format("the settings, ice, detector and version of {}", first.file));
    if (part.events.size() != first.events.size())
      throw InputError({part.file}, fmt::format("{} events", part.events.size()),
                       fmt::format("{}, as in {}", first.events.size(), first.file));
    if (part.shard < 1 || part.shard > part.shards)
      throw InputError({part.file}, fmt::format("shard {} of {}", part.shard, part.shards),
                       "k of K with 1 <= k <= K");
    const Part*& place = found[part.shard - 1];
    if (place)
      throw InputError({part.file}, fmt::format("shard {} again", part.shard), "each shard once",
                       fmt::format("It is in {}, too", place->file));
    place = &part;
  }
  const auto missing = std::find(found.begin(), found.end(), nullptr);
  if (missing != found.end())
    throw InputError({first.file},
                     fmt::format("no file with shard {} of {}", missing - found.begin() + 1, first.shards),
                     "all shards of the simulation");
}

// The events of different files must have different names.
void check_events(const std::vector<Part>& parts) {
  std::map<std::string, std::string> file_of;
  const Provenance& first = parts.front().events.provenance();
  for (const Part& part : parts) {
    const Provenance& here = part.events.provenance();
    if (here.detector_hash != first.detector_hash)
      throw InputError({part.file}, "events of detector " + here.detector_name,
                       fmt::format("the detector of {}, {}", parts.front().file, first.detector_name));
    if (here.pulses != first.pulses)
      throw InputError({part.file}, here.pulses ? "pulses" : "photons",
                       fmt::format("{}, as in {}", first.pulses ? "pulses" : "photons", parts.front().file));
    for (std::size_t e = 0; e < part.events.size(); ++e) {
      const auto [known, is_new] = file_of.emplace(part.events.id(e), part.file);
      if (!is_new)
        throw InputError({part.file}, fmt::format("event {} again", part.events.id(e)),
                         "events of different names",
                         fmt::format("One of this name is in {}", known->second));
    }
  }
}

struct Counts {
  std::size_t events = 0, hits = 0;
};

// Adds event `e` of a file with all that stands beside its hits, as an event of its own or to the one begun
// last.
void copy(const EventFileReader& from, std::size_t e, bool begins, EventFileWriter& to, Counts& counts) {
  const Event event = from.read(e);
  if (begins) to.begin_event(event);
  to.append(event.hits);
  const auto beside = [](const auto& rows, const auto& write) {
    if (!rows.empty()) write(rows);
  };
  beside(from.photons(e), [&](const auto& rows) { to.append_photons(rows); });
  beside(from.photoelectrons(e), [&](const auto& rows) { to.append_photoelectrons(rows); });
  beside(from.waveforms(e), [&](const auto& rows) { to.append_waveforms(rows); });
  counts.events += begins;
  counts.hits += event.hits.size();
}

// One event at a time. Of shards, hits in the order of the shards.
Counts copy_shards(std::vector<Part>& parts, EventFileWriter& writer) {
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.shard < b.shard; });
  Counts counts;
  for (std::size_t e = 0; e < parts.front().events.size(); ++e)
    for (const Part& part : parts) copy(part.events, e, &part == &parts.front(), writer, counts);
  return counts;
}

Counts copy_events(const std::vector<Part>& parts, EventFileWriter& writer) {
  Counts counts;
  for (const Part& part : parts)
    for (std::size_t e = 0; e < part.events.size(); ++e) copy(part.events, e, true, writer, counts);
  return counts;
}

Provenance provenance_of(const std::vector<Part>& parts, bool shards, const std::string& command_line) {
  Provenance provenance = parts.front().events.provenance();
  provenance.command = command_line;
  if (shards) {
    provenance.configuration = json_line(parts.front().configuration);
    return provenance;
  }
  Json configuration = {{"command", "merge"}, {"files", Json::array()}};
  for (const Part& part : parts)
    configuration["files"].push_back({{"file", part.file},
                                      {"ice_hash", part.events.provenance().ice_hash},
                                      {"configuration", part.configuration}});
  provenance.configuration = json_line(configuration);
  provenance.weighted = std::any_of(parts.begin(), parts.end(),
                                    [](const Part& part) { return part.events.provenance().weighted; });
  return provenance;
}

void run_merge(const MergeOptions& options, const std::string& command_line) {
  require_event_file_name(options.to);
  PlannedOutput json(options.output.json);
  std::vector<Part> parts;
  for (const std::string& file : options.from) parts.push_back(open_part(file));
  const bool shards =
      std::any_of(parts.begin(), parts.end(), [](const Part& part) { return part.shards > 1; });
  if (shards)
    check_shards(parts);
  else
    check_events(parts);
  EventFileWriter writer(options.to, provenance_of(parts, shards, command_line));
  const Counts counts = shards ? copy_shards(parts, writer) : copy_events(parts, writer);
  json.write(json_text({{"output", options.to},
                        {"files", parts.size()},
                        {"shards", shards},
                        {"events", counts.events},
                        {"hits", counts.hits}}));
  writer.close();
  json.commit();
  if (!options.output.quiet)
    fmt::print("{}: {} {}{}, {} event{}, {} hits\n", options.to, parts.size(), shards ? "shard" : "file",
               parts.size() == 1 ? "" : "s", counts.events, counts.events == 1 ? "" : "s", counts.hits);
}

}  // namespace

void add_merge(CLI::App& floe, const std::string& command_line) {
  CLI::App& app =
      *floe.add_subcommand("merge", "Put the shards of a simulation, or several event files, together");
  const auto options = std::make_shared<MergeOptions>();
  app.add_option("FILE", options->from,
                 "Event files: all shards of one simulation, or files of different events")
      ->type_name("FILE...")
      ->required();
  app.add_option("-o,--output", options->to, "Event file to write")->type_name("FILE.h5")->required();
  add_output_options(app, options->output);
  app.footer(
      "Examples:\n"
      "  floe simulate --flasher 63,20 --photons 1e7 --shard 1/2 -o part1.h5\n"
      "  floe simulate --flasher 63,20 --photons 1e7 --shard 2/2 -o part2.h5\n"
      "  floe merge part1.h5 part2.h5 -o whole.h5\n"
      "The merged shards hold the hits of the whole run, photon by photon. What stands beside pulses is "
      "kept.");
  app.callback([options, command_line] { run_merge(*options, command_line); });
}

}  // namespace floe
