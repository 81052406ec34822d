// floe simulate: light of flashers, a cascade or an f2k file, through the ice, to hits in a file.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "apps/brightness_limit.h"
#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/event_arguments.h"
#include "apps/event_parts.h"
#include "apps/event_simulation.h"
#include "apps/model_json.h"
#include "apps/model_warnings.h"
#include "apps/option_values.h"
#include "apps/planned_light.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "data/base/error.h"
#include "data/base/file_hash.h"
#include "data/event_files.h"
#include "data/event_rules.h"
#include "data/event_stream.h"
#include "propagation/engine/simulator.h"
#include "propagation/model_hash.h"

namespace floe {

namespace {

struct SimulateOptions {
  ModelRequest model;
  SimulationSettings settings;
  OutputOptions output;
  std::string file;  // -o
  Shard shard;
  double stretch = 1;  // of absorption; above 1: hits carry weights

  double most_photons = most_photons_by_default;

  FlasherRequest flasher;
  PointOptions point;
  Cascade cascade;
  std::string f2k, flashers;  // files
  std::string flasher_text, cascade_text, particle = "e-";
};

std::vector<double> parse_numbers(const std::string& option, const std::string& text, std::size_t count,
                                  const std::string& layout) {
  const auto parts = split_list(text);
  if (parts.size() != count)
    throw UsageError(
        fmt::format("{}: found \"{}\"; expected {} numbers without blanks: {}", option, text, count, layout));
  std::vector<double> numbers;
  for (const std::string& part : parts) numbers.push_back(parse_option_number(option, part, any_number));
  return numbers;
}

Cascade parse_cascade(const SimulateOptions& options) {
  const std::string name = "--cascade";
  const auto v = parse_numbers(name, options.cascade_text, 6, "x,y,z[m],zenith,azimuth[deg],energy[GeV]");
  const auto check = [&](double value, Range range, const std::string& what) {
    parse_option_number(name + ", " + what, fmt::format("{}", value), range);
  };
  for (int i = 0; i < 3; ++i) check(v[i], {-1e5, 1e5}, "position [m]");
  check(v[3], {0, 180}, "zenith [deg]");
  check(v[4], {-360, 360}, "azimuth [deg]");
  check(v[5], {0, 1e9, true}, "energy [GeV]");
  Cascade cascade = options.cascade;  // holds the time
  cascade.position = {v[0], v[1], v[2]};
  cascade.zenith = v[3] * degree;
  cascade.azimuth = (v[4] < 0 ? v[4] + 360 : v[4]) * degree;
  cascade.energy = v[5];
  cascade.kind = cascade_kind_of(options.particle);
  return cascade;
}

// "k/K": part k of K.
Shard parse_shard(const std::string& text) {
  const auto slash = text.find('/');
  if (slash == std::string::npos)
    throw UsageError(fmt::format("--shard: found \"{}\"; expected k/K, e.g. 2/10", text));
  Shard shard;
  shard.count =
      static_cast<std::uint64_t>(parse_option_integer("--shard", text.substr(slash + 1), 1, most_shards));
  shard.index = static_cast<std::uint64_t>(
      parse_option_integer("--shard", text.substr(0, slash), 1, static_cast<std::int64_t>(shard.count)));
  return shard;
}

// "", or K as in --weighted=K.
double parse_stretch(const std::string& text) {
  constexpr double usual = 4;
  return text.empty() ? usual : parse_option_number("--weighted", text, {1, 100, true});
}

SourceRequest light_request(const SimulateOptions& options) {
  const int given = !options.flasher_text.empty() + !options.flashers.empty() +
                    !options.cascade_text.empty() + !options.f2k.empty() + options.point.given();
  if (given != 1)
    throw UsageError(
        "give exactly one of --flasher, --flashers, --cascade, --f2k, --point and --standard-candle");
  SourceRequest light;
  if (!options.f2k.empty()) light.f2k = options.f2k;
  if (!options.flashers.empty()) {
    light.flashers = read_flasher_runs(options.flashers);
    for (RunToSimulate& run : *light.flashers) run.run.oversize = options.settings.oversize;
  }
  if (!options.cascade_text.empty()) light.cascade = parse_cascade(options);
  if (!options.flasher_text.empty()) {
    if (options.flasher.photons == 0) throw UsageError("--flasher needs --photons N, e.g. --photons 2e9");
    light.flasher = options.flasher;
    light.flasher->module = parse_module("--flasher", options.flasher_text);
    light.flasher->beam = options.point.beam;
    light.flasher->pulse = options.point.pulse;
  }
  if (options.point.given()) light.point = point_request(options.point);
  return light;
}

Provenance provenance_of(const SimulateOptions& options, const SourceRequest& light, const Model& model,
                         const std::string& command_line) {
  Json configuration = {{"command", "simulate"},
                        {"model", to_json(options.model)},
                        {"source", to_json(light)},
                        {"seed", options.settings.seed},
                        {"oversize", options.settings.oversize}};
  configuration["most_photons"] = options.most_photons;
  if (options.stretch > 1) configuration["weighted"] = options.stretch;
  if (options.shard.count > 1) configuration["shard"] = {options.shard.index, options.shard.count};
  Provenance provenance;
  provenance.version = FLOE_VERSION;
  provenance.command = command_line;
  provenance.configuration = json_line(configuration);
  provenance.ice_name = model.ice->name();
  provenance.ice_hash = model.ice->hash();
  provenance.detector_name = model.detector->name();
  provenance.detector_hash = model.detector->hash();
  provenance.seed = options.settings.seed;
  provenance.oversize = options.settings.oversize;
  provenance.weighted = options.stretch > 1;
  return provenance;
}

// What a run depends on, besides what its provenance says.
Json heading_of(const SimulateOptions& options, const Provenance& provenance, const Model& model) {
  Json heading = {{"journal", "floe simulate 2"},
                  {"version", FLOE_VERSION},
                  {"configuration", Json::parse(provenance.configuration)},
                  {"model", model_hash(model)}};
  if (!options.f2k.empty()) heading["f2k"] = hash_of_file(options.f2k);
  return heading;
}

// The events of a file in consecutive parts: one each, or more when there are very many.
struct Partition {
  explicit Partition(std::size_t all) : events(all), in_part((all + most_parts - 1) / most_parts) {}
  std::size_t parts() const { return (events + in_part - 1) / in_part; }
  std::size_t begin(std::size_t part) const { return part * in_part; }
  std::size_t end(std::size_t part) const { return std::min(events, begin(part + 1)); }

  static constexpr std::size_t most_parts = 1000;
  std::size_t events, in_part;
};

// Simulates the parts that no earlier run has left.
std::vector<EventResult> simulate_parts(EventSimulation& simulation, const Partition& partition,
                                        const Provenance& provenance, EventParts& parts) {
  std::vector<EventResult> results;
  for (std::size_t p = 0; p < partition.parts(); ++p) {
    if (parts.row(p)) {
      for (const Json& row : parts.row(p)->at("events")) results.push_back(event_result_of(row));
      for (std::size_t e = partition.begin(p); e < partition.end(p); ++e) simulation.pass_over(e);
      continue;
    }
    Json row = {{"events", Json::array()}};  // filled while the part is written
    const auto write = [&](EventFileWriter& writer) {
      for (std::size_t e = partition.begin(p); e < partition.end(p); ++e) {
        results.push_back(simulation.simulate(e, writer));
        row["events"].push_back(to_json(results.back()));
      }
    };
    parts.add(p, provenance, write, row);
  }
  return results;
}

void copy_part(const std::filesystem::path& part, EventFileWriter& writer) {
  const EventFileReader reader(part);
  for (std::size_t e = 0; e < reader.size(); ++e) {
    const Event event = reader.read(e);
    writer.begin_event(event);
    writer.append(event.hits);
  }
}

// One event is written as its light comes. With many, none is lost when the run is killed.
std::vector<EventResult> simulate_all(const SimulateOptions& options, EventSimulation& simulation,
                                      std::size_t events, const Model& model, const Provenance& provenance,
                                      const std::function<void(const std::vector<EventResult>&)>& report) {
  if (events == 1) {
    EventFileWriter writer(options.file, provenance);
    const std::vector<EventResult> results{simulation.simulate(0, writer)};
    report(results);
    writer.close();
    return results;
  }
  const Partition partition(events);
  EventParts parts(options.file, heading_of(options, provenance, model), partition.parts());
  if (parts.found() > 0)
    fmt::print(stderr, "floe: going on after {} of {} parts, found in {}.parts\n", parts.found(),
               partition.parts(), options.file);
  const std::vector<EventResult> results = simulate_parts(simulation, partition, provenance, parts);
  report(results);
  parts.finish(provenance, copy_part);
  return results;
}

SimulationSummary total(const std::vector<EventResult>& results) {
  SimulationSummary sum;
  for (const EventResult& result : results) add(result.summary, sum);
  return sum;
}

double photons_per_second(const SimulationSummary& summary) {
  return summary.seconds > 0 ? static_cast<double>(summary.propagated) / summary.seconds : 0;
}

Json results_json(const std::vector<EventResult>& results, const SimulateOptions& options, const Model& model,
                  const std::vector<std::string>& warnings) {
  const SimulationSummary sum = total(results);
  Json json = {{"output", options.file},
               {"model", to_json(model)},
               {"seed", options.settings.seed},
               {"photons_propagated", sum.propagated},
               {"hits", sum.hits},
               {"seconds", sum.seconds},
               {"photons_per_second", photons_per_second(sum)},
               {"absorption_stretch", options.stretch},
               {"warnings", warnings}};
  put_weights(sum.weights, json);
  Json& events = json["events"] = Json::array();
  for (const EventResult& result : results) {
    events.push_back(to_json(result));
    events.back().erase("seconds");
  }
  return json;
}

void warn_of_darkness(const std::vector<EventResult>& results) {
  for (const EventResult& result : results)
    if (result.summary.hits == 0)
      fmt::print(stderr,
                 "floe: warning: event {}: no light reached a module; is the source inside the detector and "
                 "bright enough?\n",
                 result.id);
}

std::string weight_words(const WeightSums& weights) {
  return fmt::format("weights {:.6g} +- {:.2g}, worth {:.4g} hits", weights.sum, std::sqrt(weights.squares),
                     weights.effective_hits());
}

void print_results(const std::vector<EventResult>& results, const SimulateOptions& options) {
  for (const EventResult& result : results)
    fmt::print("event {}: {} hits in {} modules{}\n", result.id, result.summary.hits, result.modules,
               options.stretch > 1 ? ", " + weight_words(result.summary.weights) : "");
  const SimulationSummary sum = total(results);
  fmt::print("{}: {} photons propagated, {} hits, {:.2f} s, {:.3g} photons/s\n", options.file, sum.propagated,
             sum.hits, sum.seconds, photons_per_second(sum));
}

void run_simulate(const SimulateOptions& options, const std::string& command_line) {
  const SourceRequest light = light_request(options);
  require_event_file_name(options.file);
  PlannedOutput json(options.output.json);
  const Model model = load_model(options.model);
  const Simulator simulator(model, options.settings.oversize);
  auto events = plan_light(light, simulator, options.settings.seed);
  const std::vector<std::string> warnings = warn_of_model(model, options.settings.oversize);
  limit_brightness(options.most_photons, events);

  SimulationOptions usual;
  usual.seed = options.settings.seed;
  usual.threads = options.settings.threads;
  usual.shard = options.shard;
  usual.absorption_stretch = options.stretch;
  std::vector<EventResult> results;
  {
    ProgressBar bar(options.output.quiet);
    EventSimulation simulation(simulator, events, usual, bar.callback());
    results = simulate_all(options, simulation, events.size(), model,
                           provenance_of(options, light, model, command_line),
                           [&](const std::vector<EventResult>& all) {
                             json.write(json_text(results_json(all, options, model, warnings)));
                           });
  }
  json.commit();
  warn_of_darkness(results);
  if (!options.output.quiet) print_results(results, options);
}

void add_source_options(CLI::App& app, SimulateOptions& options) {
  auto* flasher = app.add_option("--flasher", options.flasher_text, "Light of the LEDs of a module")
                      ->type_name("STRING,DOM");
  auto* cascade = app.add_option("--cascade", options.cascade_text,
                                 "Particle shower: vertex [m], origin of its direction [deg], energy [GeV]")
                      ->type_name("X,Y,Z,ZENITH,AZIMUTH,ENERGY");
  app.add_option("--flashers", options.flashers, "Flasher runs, an event per [[run]] table of a TOML file")
      ->type_name("RUNS.toml");
  app.add_option("--f2k", options.f2k, "All particles of an f2k text file, an event per EM line")
      ->type_name("FILE");

  app.add_option("--particle", options.particle,
                 "Of the cascade: e-, e+, gamma or hadron; or the hadron's kind: pi+, pi-, K0L, p, n, pbar")
      ->type_name("NAME")
      ->capture_default_str()
      ->needs(cascade);
  FlasherRequest& light = options.flasher;
  PointOptions& point = options.point;
  add_number(app, "--time", "NS", {-1e9, 1e9}, "Of the cascade's vertex, of the point or candle",
             [&options, &point](double time) { point.time = options.cascade.time = time; })
      ->default_str("0");
  add_number(app, "--photons", "N", positive,
             "Of the flasher, point or candle, counted as a nominal module would accept them",
             [&light, &point](double n) { point.photons = light.photons = n; });
  add_number(app, "--wavelength", "NM", {300, 600},
             "Of the flasher's line, simulated whole; default: the middle of the line at 405 nm, with 0.68 "
             "of its light. Of the point (default: 405) or candle (337), a sharp line",
             [&light, &point](double nm) { point.wavelength = light.wavelength = nm; });
  auto* isotropic =
      app.add_flag("--isotropic", light.isotropic, "The flasher shines into all directions alike")
          ->needs(flasher);
  add_number(app, "--width", "DEG", {0, 90}, "Of the flasher's beam (sigma)", light.width_deg)
      ->needs(flasher)
      ->excludes(isotropic);
  add_number(app, "--elevation", "DEG", {-90, 90},
             "Above the horizontal, of the flasher's beam (default: -0.2) or the cone's axis (90)",
             [&light, &point](double angle) { point.elevation_deg = light.elevation_deg = angle; })
      ->excludes(isotropic);
  add_number(app, "--azimuth", "DEG", {-360, 360},
             "Of the flasher's beam, by default into all azimuths alike, or of the cone's axis",
             [&light, &point](double azimuth) { point.azimuth_deg = light.azimuth_deg = azimuth; })
      ->excludes(isotropic);
  add_point_options(app, options.point);
  app.get_option("--beam")->excludes(isotropic)->excludes(app.get_option("--width"));
}

// Options that several sources have mean nothing without one of them.
void expect_owners(const CLI::App& app) {
  const std::vector<std::string> points{"--point", "--standard-candle"},
      lights{"--flasher", "--point", "--standard-candle"}, timed{"--cascade", "--point", "--standard-candle"},
      flasher{"--flasher"};
  const std::vector<std::pair<const char*, const std::vector<std::string>*>> owners{
      {"--time", &timed},       {"--photons", &lights}, {"--wavelength", &lights},
      {"--elevation", &lights}, {"--azimuth", &lights}, {"--pulse", &lights},
      {"--beam", &flasher},     {"--emitted", &points}, {"--opening", &points}};
  for (const auto& [option, sources] : owners) {
    const auto typed = [&](const std::string& source) { return app.count(source) > 0; };
    if (app.count(option) > 0 && std::none_of(sources->begin(), sources->end(), typed))
      throw UsageError(fmt::format("{} requires {}", option, fmt::join(*sources, ", or ")));
  }
}

}  // namespace

void add_simulate(CLI::App& floe, const std::string& command_line) {
  CLI::App& app = *floe.add_subcommand("simulate", "Propagate light through the ice and write the hits");
  const auto options = std::make_shared<SimulateOptions>();
  add_source_options(app, *options);
  app.add_option("-o,--output", options->file, "Event file to write")->type_name("FILE.h5")->required();
  add_model_options(app, options->model);
  add_simulation_options(app, options->settings);
  app.add_option_function<std::string>(
         "--shard", [options](const std::string& text) { options->shard = parse_shard(text); },
         "Only part k of K of the photons; floe merge puts the K files together")
      ->type_name("k/K");
  app.add_option_function<std::string>(
         "--weighted", [options](const std::string& text) { options->stretch = parse_stretch(text); },
         "Let photons live K absorption lengths, 1 < K <= 100 (4 when not said), and weight their hits: less "
         "noise far from the source")
      ->type_name("[=K]")
      ->expected(0, 1);
  add_number(app, "--most-photons", "N", {1, 1e18},
             "Photons to propagate for an event at most; of brighter ones a share is simulated, and its hits "
             "count for the rest",
             options->most_photons)
      ->default_str("1e9");
  add_output_options(app, options->output);
  app.footer(
      "Examples:\n"
      "  floe simulate --cascade 20,-40,-300,70,130,3000 -o event.h5\n"
      "  floe simulate --flasher 63,20 --photons 1e7 -o flasher.h5\n"
      "  floe simulate --flashers runs.toml --oversize 16 -o runs.h5\n"
      "  floe simulate --ice my-ice --cascade 20,-40,-300,70,130,1000 --particle hadron --without tilt -o "
      "hadron.h5\n"
      "  floe simulate --flasher 63,20 --photons 1e6 --with birefringence.strength=0.5 -o half.h5\n"
      "  floe simulate --flasher 63,20 --photons 1e6 --weighted=6 -o far.h5\n"
      "  floe simulate --point 20,-40,-300 --photons 1e6 -o point.h5\n"
      "  floe simulate --standard-candle 20,-40,-300 --emitted 1e9 -o candle.h5\n"
      "  floe simulate --f2k events.f2k --seed 2 --json summary.json -o events.h5\n"
      "Of many events each is kept in OUTPUT.parts as soon as it is done, and the same command goes on\n"
      "where a stopped one was.");
  app.callback([options, command_line, &app] {
    expect_owners(app);
    run_simulate(*options, command_line);
  });
}

}  // namespace floe
