// floe-bench: how fast whole workloads are, where their time goes, and how that compares with another
// program or with more threads.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/option_values.h"
#include "apps/planned_output.h"
#include "apps/text_table.h"
#include "bench/child_process.h"
#include "bench/machine.h"
#include "bench/peer.h"
#include "bench/sampling_profile.h"
#include "bench/scaling.h"
#include "bench/statistics.h"
#include "bench/workloads.h"
#include "data/base/error.h"

namespace floe {

namespace {

struct BenchOptions {
  std::vector<std::string> ice{"south-pole"};
  std::vector<std::string> workloads{"flasher", "cascade"};
  double photons = 1e6;
  double oversize = 5;
  int threads = 1, rounds = 5;
  std::uint64_t seed = 1;
  bool scaling = false;
  std::optional<std::string> peer, peer_count, json;
  std::optional<double> peer_photons;
};

struct Case {
  std::string ice;
  Workload workload;
};

std::string title(const Case& c) {
  return fmt::format("{}, {}", std::filesystem::path(c.ice).filename().string(), c.workload.name);
}

Simulator make_simulator(const BenchOptions& options, const Case& c) {
  ModelRequest request;
  request.ice = c.ice;
  return Simulator(load_model(request), options.oversize);
}

// Speed: in a process of its own, so that its peak memory is its own, too.
Json measure_speed(const BenchOptions& options, const Case& c) {
  const ChildResult child = run_in_child([&] {
    const Simulator simulator = make_simulator(options, c);
    const auto source = make_source(c.workload, simulator.model(), reference_brightness(c.workload));
    std::vector<double> per_core, wall_speed;
    SimulationSummary sum;
    for (int round = 0; round < options.rounds; ++round) {
      const TimedRun run = run_photons(simulator, *source, options.photons,
                                       options.seed + static_cast<std::uint64_t>(round), options.threads);
      const auto photons = static_cast<double>(run.summary.propagated);
      per_core.push_back(photons / run.cpu_seconds);
      wall_speed.push_back(photons / run.summary.seconds);
      sum.propagated += run.summary.propagated;
      sum.scatters += run.summary.scatters;
      sum.queries += run.summary.queries;
      sum.hits += run.summary.hits;
    }
    const auto photons = static_cast<double>(sum.propagated);
    const double speed = spread_of(per_core).median;
    const double scatters = static_cast<double>(sum.scatters) / photons;
    return Json{{"photons", sum.propagated},
                {"hits", sum.hits},
                {"photons_per_second_and_core", speed},
                {"photons_per_second", spread_of(wall_speed).median},
                {"ns_per_scatter", 1e9 / (speed * scatters)},
                {"scatters_per_photon", scatters},
                {"embree_queries_per_photon", static_cast<double>(sum.queries) / photons}};
  });
  Json result = child.result;
  result["peak_megabytes"] = child.cost.peak_megabytes;
  return result;
}

Json parts_json(const char* kind, const std::vector<ProfilePart>& parts) {
  Json json = Json::array();
  for (const ProfilePart& part : parts) json.push_back({{kind, part.name}, {"share", part.share}});
  return json;
}

// Shares of time, with one thread.
Json measure_profile(const BenchOptions& options, const Case& c) {
  return run_in_child([&] {
           const Simulator simulator = make_simulator(options, c);
           const auto source = make_source(c.workload, simulator.model(), reference_brightness(c.workload));
           const Profile profile = profile_of([&] {
             for (int round = 0; round < options.rounds; ++round)
               run_photons(simulator, *source, options.photons,
                           options.seed + static_cast<std::uint64_t>(round), 1);
           });
           return Json{{"samples", profile.samples},
                       {"parts", parts_json("part", profile.parts)},
                       {"functions", parts_json("function", profile.functions)}};
         })
      .result;
}

Json spread_json(const Spread& spread) {
  return {{"median", spread.median}, {"lowest", spread.lowest}, {"highest", spread.highest}};
}

Json measure_peer(const BenchOptions& options, const Case& c) {
  const PeerRequest request{*options.peer, options.peer_photons.value_or(options.photons / 10),
                            options.peer_count, options.rounds};
  const Simulator simulator = make_simulator(options, c);
  const PeerComparison result = compare_with_peer(simulator, c.ice, c.workload, options.photons, options.seed,
                                                  options.threads, request);
  return {{"brightness", result.brightness},
          {"peer_photons", result.peer_photons},
          {"peer_startup_seconds", result.startup},
          {"floe_photons_per_second_and_core", spread_json(result.floe)},
          {"peer_photons_per_second_and_core", spread_json(result.peer)},
          {"ratio", spread_json(result.ratio)},
          {"ratio_by_wall", spread_json(result.ratio_by_wall)}};
}

Json measure_scaling(const BenchOptions& options, const Case& c) {
  const ScalingComparison result = compare_scaling([&] { return make_simulator(options, c); }, c.workload,
                                                   options.photons, options.seed, options.rounds);
  return {{"two_threads_photons_per_second", spread_json(result.two_threads)},
          {"two_processes_photons_per_second", spread_json(result.two_processes)},
          {"ratio", spread_json(result.ratio)}};
}

double number(const Json& json, const char* key) {
  return json.at(key).get<double>();
}
std::string with_range(const Json& spread, const char* format) {
  return fmt::format(fmt::runtime(fmt::format("{0} ({0} to {0})", format)), number(spread, "median"),
                     number(spread, "lowest"), number(spread, "highest"));
}

// Each kind of table: a header, and a row a case.
void print_speed(const std::vector<Json>& results, const BenchOptions& options) {
  TextTable table({"ice, workload", "photons/s per core", "ns/scatter", "scatters/photon",
                   "Embree queries/photon", "peak memory [MB]"});
  for (const Json& result : results) {
    const Json& speed = result.at("speed");
    table.add({result.at("case"), fmt::format("{:.0f}", number(speed, "photons_per_second_and_core")),
               fmt::format("{:.2f}", number(speed, "ns_per_scatter")),
               fmt::format("{:.1f}", number(speed, "scatters_per_photon")),
               fmt::format("{:.3f}", number(speed, "embree_queries_per_photon")),
               fmt::format("{:.0f}", number(speed, "peak_megabytes"))});
  }
  fmt::print("Speed: {} thread{}, {} x {:.3g} photons, oversize {:g}\n{}\n", options.threads,
             options.threads == 1 ? "" : "s", options.rounds, options.photons, options.oversize, table.str());
}

void print_profile(const std::vector<Json>& results) {
  std::vector<std::string> header{"part"};
  for (const Json& result : results) header.push_back(result.at("case"));
  TextTable table(header);
  const std::size_t parts = results.front().at("profile").at("parts").size();
  for (std::size_t i = 0; i < parts; ++i) {
    std::vector<std::string> row;
    for (const Json& result : results) {
      const Json& part = result.at("profile").at("parts").at(i);
      if (row.empty()) row.push_back(part.at("part"));
      row.push_back(fmt::format("{:.1f}", 100 * number(part, "share")));
    }
    table.add(row);
  }
  fmt::print("Shares of time in percent, by sampling a thousand times a second\n{}\n", table.str());
}

void print_peer(const std::vector<Json>& results, const BenchOptions& options) {
  TextTable table({"ice, workload", "brightness", "floe/s per core", "peer/s per core", "ratio", "by wall"});
  for (const Json& result : results) {
    const Json& peer = result.at("peer");
    table.add({result.at("case"), fmt::format("{:.4g}", number(peer, "brightness")),
               fmt::format("{:.0f}", number(peer.at("floe_photons_per_second_and_core"), "median")),
               fmt::format("{:.0f}", number(peer.at("peer_photons_per_second_and_core"), "median")),
               with_range(peer.at("ratio"), "{:.2f}"), with_range(peer.at("ratio_by_wall"), "{:.2f}")});
  }
  fmt::print(
      "Beside the peer, turn by turn: {} rounds, {:.3g} photons here and {:.3g} there, start-up subtracted\n"
      "(brightness: N of the flasher, energy of the cascade in GeV, the same in both programs)\n{}\n",
      options.rounds, options.photons, options.peer_photons.value_or(options.photons / 10), table.str());
}

void print_scaling(const std::vector<Json>& results, const BenchOptions& options) {
  TextTable table({"ice, workload", "two threads [photons/s]", "two processes [photons/s]", "ratio"});
  for (const Json& result : results) {
    const Json& scaling = result.at("scaling");
    table.add({result.at("case"),
               fmt::format("{:.0f}", number(scaling.at("two_threads_photons_per_second"), "median")),
               fmt::format("{:.0f}", number(scaling.at("two_processes_photons_per_second"), "median")),
               with_range(scaling.at("ratio"), "{:.3f}")});
  }
  fmt::print("Two threads against two processes: {} rounds of {:.3g} photons a thread\n{}\n", options.rounds,
             options.photons, table.str());
}

Json measure(const BenchOptions& options, const Case& c) {
  Json result{{"case", title(c)}, {"ice", c.ice}, {"workload", c.workload.name}};
  result["speed"] = measure_speed(options, c);
  result["profile"] = measure_profile(options, c);
  if (options.scaling) result["scaling"] = measure_scaling(options, c);
  if (options.peer) result["peer"] = run_in_child([&] { return measure_peer(options, c); }).result;
  return result;
}

void run_bench(const BenchOptions& options) {
  PlannedOutput json(options.json);
  std::vector<Case> cases;
  for (const std::string& ice : options.ice)
    for (const std::string& name : options.workloads) cases.push_back({ice, workload_of(name)});
  // What is wrong with an ice model shows itself before any work is done. Like all else that may start
  // threads, simulators are made in children, since a process with threads cannot be forked safely.
  for (const Case& c : cases)
    run_in_child([&] {
      make_simulator(options, c);
      return Json();
    });

  std::vector<Json> results;
  for (const Case& c : cases) results.push_back(measure(options, c));
  json.write(json_text({{"version", FLOE_VERSION},
                        {"machine", machine_description()},
                        {"threads", options.threads},
                        {"rounds", options.rounds},
                        {"photons", options.photons},
                        {"oversize", options.oversize},
                        {"seed", options.seed},
                        {"results", results}}));
  json.commit();

  fmt::print("floe {}; {}\n\n", FLOE_VERSION, machine_description());
  print_speed(results, options);
  print_profile(results);
  if (options.scaling) print_scaling(results, options);
  if (options.peer) print_peer(results, options);
}

void add_options(CLI::App& app, BenchOptions& options) {
  app.add_option("--ice", options.ice, "Ice-model directories, or south-pole (built in); repeatable")
      ->type_name("DIR")
      ->capture_default_str();
  app.add_option("--workload", options.workloads, "flasher, cascade; repeatable; default: both")
      ->type_name("NAME");
  add_number(app, "--photons", "N", {1000, 1e12}, "To propagate in each round; default 1e6", options.photons);
  add_number(app, "--oversize", "X", {1, 100}, "As in floe simulate; default 5", options.oversize);
  add_integer(app, "--threads", 1, 4096, "Default 1",
              [&](std::int64_t n) { options.threads = static_cast<int>(n); });
  add_integer(app, "--rounds", 1, 1000, "Repetitions; medians are printed; default 5",
              [&](std::int64_t n) { options.rounds = static_cast<int>(n); });
  add_integer(app, "--seed", 0, std::numeric_limits<std::int64_t>::max(), "Of the first round; default 1",
              [&](std::int64_t n) { options.seed = static_cast<std::uint64_t>(n); });
  app.add_option("--json", options.json, "Write the results to this file, too")->type_name("FILE");
  app.add_flag("--scaling", options.scaling, "Two threads against two processes side by side, too");
  auto* peer =
      app.add_option("--peer", options.peer,
                     "Shell command of another program that does the same work, timed in turns; "
                     "replaced in it: {workload}, {ice}, {photons} to propagate, and {brightness}, the "
                     "source that gives as many (N of the flasher, GeV of the cascade)")
          ->type_name("CMD");
  app.add_option_function<double>(
         "--peer-photons", [&](double n) { options.peer_photons = n; },
         "That the other program propagates in a round; default: a tenth of --photons")
      ->type_name("N")
      ->check(CLI::Range(1.0, 1e12))
      ->needs(peer);
  app.add_option(
         "--peer-count", options.peer_count,
         "Regular expression whose first group is the number of photons that the other program says it "
         "propagated, e.g. 'photons: ([0-9]+)'")
      ->type_name("REGEX")
      ->needs(peer);
}

int bench_main(int argc, char** argv) {
  CLI::App app("How fast floe propagates photons, and where the time goes.", "floe-bench");
  BenchOptions options;
  add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
  }
  run_bench(options);
  return 0;
}

}  // namespace

}  // namespace floe

int main(int argc, char** argv) {
  try {
    return floe::bench_main(argc, argv);
  } catch (const floe::Error& error) {
    fmt::print(stderr, "floe-bench: error: {}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "floe-bench: internal error: {}\n", error.what());
    return 70;
  }
}
