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

namespace floe {

namespace {

struct MergeOptions {
  std::vector<std::string> from;
  std::string to;
  OutputOptions output;
};

struct Part {
  std::string file;
  EventFile content;
  Json configuration;
  std::uint64_t shard = 1, shards = 1;
};

Part read_part(const std::string& file) {
  Part part{file, read_event_file(file), {}, 1, 1};
  if (!part.content.provenance)
    throw InputError({file}, "a text of hits", "floe's own event files (.h5)", "floe import makes one of it");
  part.configuration = Json::parse(part.content.provenance->configuration, nullptr, false);
  if (part.configuration.is_object() && part.configuration.contains("shard")) {
    const Json& shard = part.configuration["shard"];
    if (!shard.is_array() || shard.size() != 2 || !shard[0].is_number_unsigned() ||
        !shard[1].is_number_unsigned())
      throw InputError({file}, "a shard " + shard.dump(), "two whole numbers, [k, K], in its configuration");
    part.shard = shard[0];
    part.shards = shard[1];
    part.configuration.erase("shard");
  }
  return part;
}

// Shards belong together when everything but their number is the same, and none is missing or there twice.
void check_shards(const std::vector<Part>& parts) {
  const Part& first = parts.front();
  const Provenance& source = *first.content.provenance;
  std::vector<const Part*> found(first.shards, nullptr);
  for (const Part& part : parts) {
    const Provenance& other = *part.content.provenance;
    if (part.shards != first.shards)
      throw InputError({part.file}, fmt::format("shard {} of {}", part.shard, part.shards),
                       fmt::format("one of {} shards, like {}", first.shards, first.file));
    if (part.configuration != first.configuration || other.ice_hash != source.ice_hash ||
        other.detector_hash != source.detector_hash || other.version != source.version)
      throw InputError({part.file}, "a shard of another simulation",
                       fmt::format("the settings, ice, detector and version of {}", first.file));
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

// The events of all shards, hits in the order of the shards.
std::vector<Event> joined_events(std::vector<Part>& parts) {
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.shard < b.shard; });
  std::vector<Event> events = std::move(parts.front().content.events);
  for (std::size_t p = 1; p < parts.size(); ++p)
    for (std::size_t e = 0; e < events.size(); ++e) {
      const auto& hits = parts[p].content.events.at(e).hits;
      events[e].hits.insert(events[e].hits.end(), hits.begin(), hits.end());
    }
  return events;
}

// The events of different files, which must have different names.
std::vector<Event> listed_events(std::vector<Part>& parts) {
  std::map<std::string, std::string> file_of;
  std::vector<Event> events;
  for (Part& part : parts) {
    const Provenance &here = *part.content.provenance, &first = *parts.front().content.provenance;
    if (here.detector_hash != first.detector_hash)
      throw InputError({part.file}, "events of detector " + here.detector_name,
                       fmt::format("the detector of {}, {}", parts.front().file, first.detector_name));
    if (here.pulses != first.pulses)
      throw InputError({part.file}, here.pulses ? "pulses" : "photons",
                       fmt::format("{}, as in {}", first.pulses ? "pulses" : "photons", parts.front().file));
    for (Event& event : part.content.events) {
      const auto [known, is_new] = file_of.emplace(event.id, part.file);
      if (!is_new)
        throw InputError({part.file}, fmt::format("event {} again", event.id), "events of different names",
                         fmt::format("One of this name is in {}", known->second));
      events.push_back(std::move(event));
    }
  }
  return events;
}

Provenance provenance_of(const std::vector<Part>& parts, bool shards, const std::string& command_line) {
  Provenance provenance = *parts.front().content.provenance;
  provenance.command = command_line;
  if (shards) {
    provenance.configuration = parts.front().configuration.dump();
    return provenance;
  }
  Json configuration = {{"command", "merge"}, {"files", Json::array()}};
  for (const Part& part : parts)
    configuration["files"].push_back({{"file", part.file},
                                      {"ice_hash", part.content.provenance->ice_hash},
                                      {"configuration", part.configuration}});
  provenance.configuration = configuration.dump();
  provenance.weighted = std::any_of(parts.begin(), parts.end(),
                                    [](const Part& part) { return part.content.provenance->weighted; });
  return provenance;
}

void run_merge(const MergeOptions& options, const std::string& command_line) {
  require_event_file_name(options.to);
  PlannedOutput json(options.output.json);
  std::vector<Part> parts;
  for (const std::string& file : options.from) parts.push_back(read_part(file));
  const bool shards =
      std::any_of(parts.begin(), parts.end(), [](const Part& part) { return part.shards > 1; });
  if (shards) check_shards(parts);
  const Provenance provenance = provenance_of(parts, shards, command_line);
  const std::vector<Event> events = shards ? joined_events(parts) : listed_events(parts);

  EventFileWriter writer(options.to, provenance);
  std::size_t hits = 0;
  for (const Event& event : events) {
    writer.begin_event(event);
    writer.append(event.hits);
    hits += event.hits.size();
  }
  json.write(json_text({{"output", options.to},
                        {"files", parts.size()},
                        {"shards", shards},
                        {"events", events.size()},
                        {"hits", hits}}));
  writer.close();
  json.commit();
  if (!options.output.quiet)
    fmt::print("{}: {} {}{}, {} event{}, {} hits\n", options.to, parts.size(), shards ? "shard" : "file",
               parts.size() == 1 ? "" : "s", events.size(), events.size() == 1 ? "" : "s", hits);
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
      "The merged shards hold the hits of the whole run, photon by photon.");
  app.callback([options, command_line] { run_merge(*options, command_line); });
}

}  // namespace floe
