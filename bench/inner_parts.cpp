// inner_parts: what each part of a photon's step costs by itself, on the built-in ice.
//
// Parts that all lanes take together are timed on lanes recorded in a real walk of the flasher's light, fresh
// ones each time, so that neither the photons' states nor the branches repeat themselves.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/text_table.h"
#include "bench/recorded_states.h"
#include "bench/scatter_bound.h"
#include "bench/statistics.h"
#include "bench/vector_costs.h"
#include "geometry/column_finder.h"
#include "geometry/module_scene.h"
#include "propagation/engine/lane_steps.h"
#include "propagation/ice/ice_files.h"
#include "propagation/sources/cascade.h"
#include "propagation/sources/flasher.h"

namespace floe {

namespace {

constexpr double oversize = 5;
constexpr const char* whole_step = "whole step, modules out of reach";
constexpr const char* time_each = "time";  // the counter: seconds for one lane, photon or question

double seconds_between(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

// What reading the clock twice takes.
double clock_overhead() {
  std::vector<double> gaps;
  for (int i = 0; i < 1001; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const auto end = std::chrono::steady_clock::now();
    gaps.push_back(seconds_between(start, end));
  }
  return spread_of(gaps).median;
}

// The time of one of `count` things that an iteration does.
benchmark::Counter each_of(double count) {
  return benchmark::Counter(count,
                            benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Times `part` on copies of recorded lanes, which fit into the first-level cache.
void time_on_lanes(benchmark::State& state, const std::vector<Lanes>& recorded,
                   const std::function<void(Lanes&)>& part) {
  static const double overhead = clock_overhead();
  std::array<Lanes, 4> working;
  std::size_t next = 0;
  for (auto _ : state) {
    for (Lanes& lanes : working) lanes = recorded[next++ % recorded.size()];
    benchmark::ClobberMemory();
    const auto start = std::chrono::steady_clock::now();
    for (Lanes& lanes : working) part(lanes);
    benchmark::ClobberMemory();
    const auto end = std::chrono::steady_clock::now();
    state.SetIterationTime(std::max(1e-10, seconds_between(start, end) - overhead));
  }
  state.counters[time_each] = each_of(working.size() * Lanes::count);
}

// Everything that the parts need, made once.
class Bench {
 public:
  Bench()
      : model_(load_model({})),
        view_(*model_.ice),
        view_without_birefringence_(view_),
        clearance_(*model_.detector, oversize),
        column_finder_(*model_.detector, oversize),
        finder_(make_embree_finder(*model_.detector, oversize)),
        flasher_(*model_.detector, {63, 20}, flasher_settings(), reference_led_line()),
        cascade_({{20, -40, -300}, 0, 70 * degree, 130 * degree, 50000}, model_.acceptance.spectrum),
        lines_(tilted_along_lines(), *model_.detector),
        map_(tilted_on_a_map(), *model_.detector),
        states_(record_states(model_, flasher_, clearance_)),
        wavelengths_(*model_.ice, PhotonAcceptance(*model_.detector, model_.acceptance)) {
    view_without_birefringence_.birefringent = false;
    vector_costs::fill(costs_);
  }

  void register_all() {
    register_ingredients();
    register_lane_parts();
    register_photon_parts();
    register_geometry();
  }

 private:
  static FlasherSettings flasher_settings() {
    FlasherSettings settings;
    settings.photons = 1;
    return settings;
  }

  // Smooth shifts of some ten metres; what they are does not matter for the time of a look-up.
  static double some_shift(double a, double b) { return 20 * std::sin(a / 3.0) * std::cos(b / 5.0); }
  static std::vector<double> tilt_depths() {
    std::vector<double> depths;
    for (double depth = 1350; depth <= 2500; depth += 25) depths.push_back(depth);
    return depths;
  }
  static std::vector<std::vector<double>> some_shifts(std::size_t rows, std::size_t columns) {
    std::vector<std::vector<double>> shifts(rows);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j)
        shifts[i].push_back(some_shift(static_cast<double>(i), static_cast<double>(j)));
    return shifts;
  }
  static IceTables tilted_along_lines() {
    IceTables tables = south_pole_ice();
    TiltLines lines{{50, 66, 36, 37, 2, 14}, {-500, -350, 0, 50, 350, 500}, tilt_depths(), {}};
    lines.shifts = some_shifts(lines.depths.size(), lines.distances.size());
    tables.tilt_lines = lines;
    return tables;
  }
  static IceTables tilted_on_a_map() {
    IceTables tables = south_pole_ice();
    TiltMap map{{9.3, -600, 125, 11, 7}, {129.3, -600, 125, 11, 7}, tilt_depths(), {}};
    map.shifts = some_shifts(map.depths.size(), ice_files::kept_points(map));
    tables.tilt_map = map;
    return tables;
  }

  template <typename Part>
  static void add(const std::string& name, double count, Part part) {
    benchmark::RegisterBenchmark(name.c_str(), [count, part](benchmark::State& state) mutable {
      for (auto _ : state) {
        part();
        benchmark::ClobberMemory();
      }
      state.counters[time_each] = each_of(count);
    });
  }
  static void add_on_lanes(const std::string& name, const std::vector<Lanes>& recorded,
                           const std::function<void(Lanes&)>& part) {
    benchmark::RegisterBenchmark(name.c_str(), [&recorded, part](benchmark::State& state) {
      time_on_lanes(state, recorded, part);
    })->UseManualTime();
  }

  void register_ingredients() {
    using namespace vector_costs;
    const auto ingredient = [this](const char* name, void (*loop)(Data&)) {
      add(name, lanes, [this, loop] { loop(costs_); });
    };
    ingredient("random number", random_numbers);
    ingredient("logarithm", logarithms);
    ingredient("exponential", exponentials);
    ingredient("sine and cosine", sines_and_cosines);
    ingredient("square root", square_roots);
    ingredient("division", divisions);
    ingredient("table look-up", table_lookups);
    ingredient("row of a table", table_rows);
    ingredient("load and store", loads_and_stores);
  }

  void step(Lanes& lanes) const {
    draw_scattering_depths(lanes);
    find_heights(model_.ice->tilt(), lanes);
    find_segments(view_, lanes);
    find_reach(clearance_.view(), lanes);
    advance(view_, lanes);
    scatter(view_, lanes);
  }
  void find_heights(const LayerTilt& tilt, Lanes& lanes) const {
    float shift[Lanes::count];
    tilt.shifts(lanes.x, lanes.y, lanes.z, shift, Lanes::count);
    for (int i = 0; i < Lanes::count; ++i)
      lanes.height[i] = (lanes.z[i] - shift[i] - view_.z_bottom) * view_.layers_per_metre;
  }

  void register_lane_parts() {
    add_on_lanes(whole_step, states_.begun, [this](Lanes& lanes) { step(lanes); });
    add_on_lanes("depth to the next scatter", states_.begun, draw_scattering_depths);
    add_on_lanes("height in flat layers", states_.begun,
                 [this](Lanes& lanes) { find_heights(model_.ice->tilt(), lanes); });
    add_on_lanes("height in layers tilted in 1D", states_.begun,
                 [this](Lanes& lanes) { find_heights(lines_, lanes); });
    add_on_lanes("height in layers tilted in 2D", states_.begun,
                 [this](Lanes& lanes) { find_heights(map_, lanes); });
    add_on_lanes("walk through the layers", states_.drawn,
                 [this](Lanes& lanes) { find_segments(view_, lanes); });
    add_on_lanes("advance, birefringence, scattering", states_.found,
                 [this](Lanes& lanes) { advance(view_, lanes), scatter(view_, lanes); });
    add_on_lanes("the same without birefringence", states_.found, [this](Lanes& lanes) {
      advance(view_without_birefringence_, lanes), scatter(view_without_birefringence_, lanes);
    });
    add_on_lanes("clearance of the modules", states_.found,
                 [this](Lanes& lanes) { find_reach(clearance_.view(), lanes); });
  }

  void add_source(const std::string& name, const Source& source) {
    add(name, Newborns::count, [this, &source, first = std::uint64_t{0}]() mutable {
      bear_photons(source, {1, 0, first, Newborns::count}, wavelengths_, first, newborns_);
      first += Newborns::count;
    });
  }
  void register_photon_parts() {
    add("random stream of a photon", 1,
        [photon = std::uint64_t{0}]() mutable { benchmark::DoNotOptimize(RandomStream(1, 0, photon++)); });
    add("random number, one at a time", 1,
        [random = RandomStream(1, 0, 0)]() mutable { benchmark::DoNotOptimize(random.uniform()); });
    add_source("birth of a flasher's photon", flasher_);
    add_source("birth of a cascade's photon", cascade_);
  }

  void register_geometry() {
    add("clearance, one at a time", 1, [this, i = std::size_t{0}]() mutable {
      const Lanes& lanes = states_.found[i / Lanes::count % states_.found.size()];
      const std::size_t lane = i++ % Lanes::count;
      benchmark::DoNotOptimize(clearance_.at(lanes.x[lane], lanes.y[lane], lanes.z[lane]));
    });
    add("nearest column alone", 1, [this, i = std::size_t{0}]() mutable {
      const RecordedSegment& s = states_.near_one[i++ % states_.near_one.size()];
      crossings_.clear();
      column_finder_.find(s.nearest_module, s.origin, s.direction, s.length, crossings_);
    });
    add("Embree near several columns", 1, [this, i = std::size_t{0}]() mutable {
      const RecordedSegment& s = states_.near_more[i++ % states_.near_more.size()];
      crossings_.clear();
      finder_->find(s.origin, s.direction, s.length, crossings_);
    });
  }

  Model model_;
  IceView view_, view_without_birefringence_;
  ClearanceMap clearance_;
  ColumnFinder column_finder_;
  std::unique_ptr<ModuleFinder> finder_;
  FlasherSource flasher_;
  CascadeSource cascade_;
  LayerTilt lines_, map_;
  RecordedStates states_;
  WavelengthTable wavelengths_;
  Newborns newborns_{};
  vector_costs::Data costs_{};
  std::vector<ModuleCrossing> crossings_;
};

// Keeps what the repetitions of each benchmark found.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      const auto counter = run.counters.find(time_each);
      if (run.run_type != Run::RT_Iteration || counter == run.counters.end()) continue;
      if (times_.find(run.run_name.function_name) == times_.end())
        order_.push_back(run.run_name.function_name);
      times_[run.run_name.function_name].push_back(1e9 * counter->second.value);
    }
  }

  const std::vector<std::string>& names() const { return order_; }
  Spread spread(const std::string& name) const { return spread_of(times_.at(name)); }

 private:
  std::vector<std::string> order_;
  std::map<std::string, std::vector<double>> times_;  // [ns]
};

void print_parts(const Collector& collector) {
  TextTable table({"part", "ns", "lowest", "highest"});
  for (const std::string& name : collector.names()) {
    const Spread spread = collector.spread(name);
    table.add({name, fmt::format("{:.3f}", spread.median), fmt::format("{:.3f}", spread.lowest),
               fmt::format("{:.3f}", spread.highest)});
  }
  fmt::print(
      "Parts by themselves: for one lane of {}, one photon, one question (median of repetitions)\n{}\n",
      Lanes::count, table.str());
}

void print_bound(const Collector& collector) {
  std::map<std::string, double> medians;
  for (const std::string& name : collector.names()) medians[name] = collector.spread(name).median;
  bool complete = medians.count(whole_step) > 0;
  for (const Ingredient& ingredient : scatter_ingredients()) complete &= medians.count(ingredient.name) > 0;
  if (!complete) return;  // --benchmark_filter has left some out
  fmt::print("The bound of a scatter, from its ingredients\n{}\n",
             scatter_bound_table(medians, medians.at(whole_step)));
}

}  // namespace

}  // namespace floe

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  floe::Bench bench;
  bench.register_all();
  floe::Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  floe::print_parts(collector);
  floe::print_bound(collector);
}
