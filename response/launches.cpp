#include "response/launches.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace floe {

namespace {

// Goes through the crossings of all modules in order of time. Whether a launch was a hard one is known when
// it matters: an isolated launch is busy for longer than the window of the coincidence.
class Sweep {
 public:
  Sweep(const LaunchSettings& settings, std::span<const ModuleCrossings> modules)
      : settings_(settings), modules_(modules), launches_(modules.size()) {
    for (std::size_t i = 0; i < modules.size(); ++i) place_of_[modules[i].module] = i;
  }

  std::vector<std::vector<Launch>> run() {
    struct Crossing {
      double time;
      std::size_t module;
    };
    std::vector<Crossing> crossings;
    for (std::size_t i = 0; i < modules_.size(); ++i)
      for (const double time : modules_[i].times) crossings.push_back({time, i});
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
      return a.time != b.time ? a.time < b.time : a.module < b.module;
    });
    for (const Crossing& crossing : crossings)
      if (is_free(crossing.module, crossing.time)) launch(crossing.module, crossing.time);
    return std::move(launches_);
  }

 private:
  bool whole(const Launch& launch) const { return launch.hard || settings_.mode == CoincidenceMode::none; }

  bool is_free(std::size_t module, double time) const {
    const std::vector<Launch>& before = launches_[module];
    if (before.empty()) return true;
    const double busy = whole(before.back()) ? settings_.record + settings_.rearm : settings_.soft_busy;
    if (time < before.back().time + busy) return false;
    int digitising = 0;
    for (auto launch = before.rbegin(); launch != before.rend(); ++launch) {
      if (launch->time + settings_.chip_busy < time) break;
      digitising += whole(*launch);
    }
    return digitising < settings_.chips;
  }

  void launch(std::size_t module, double time) {
    Launch now{time, false};
    const ModuleId id = modules_[module].module;
    for (int away = -settings_.distance; away <= settings_.distance; ++away) {
      if (away == 0) continue;
      const auto neighbour = place_of_.find({id.string, id.dom + away});
      if (neighbour == place_of_.end()) continue;
      std::vector<Launch>& theirs = launches_[neighbour->second];
      for (auto other = theirs.rbegin(); other != theirs.rend() && time - other->time <= settings_.window;
           ++other)
        other->hard = now.hard = true;
    }
    launches_[module].push_back(now);
  }

  const LaunchSettings& settings_;
  std::span<const ModuleCrossings> modules_;
  std::vector<std::vector<Launch>> launches_;
  std::map<ModuleId, std::size_t> place_of_;
};

}  // namespace

std::vector<std::vector<Launch>> launches_of(const LaunchSettings& settings,
                                             std::span<const ModuleCrossings> modules) {
  return Sweep(settings, modules).run();
}

}  // namespace floe
