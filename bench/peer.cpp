#include "bench/peer.h"

#include <fmt/format.h>

#include <regex>
#include <sstream>

#include "bench/child_process.h"
#include "data/base/error.h"

namespace floe {

namespace {

std::string replaced(std::string text, const std::string& name, const std::string& value) {
  for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; at += value.size())
    text.replace(at, name.size(), value);
  return text;
}

// What the peer is asked to do.
class PeerCommand {
 public:
  PeerCommand(const PeerRequest& request, const Simulator& simulator, const std::string& ice,
              const Workload& workload)
      : request_(request), simulator_(simulator), ice_(ice), workload_(workload) {
    try {
      if (request.count) count_ = std::regex(*request.count);
    } catch (const std::regex_error& error) {
      throw UsageError(fmt::format("--peer-count: \"{}\": {}", *request.count, error.what()));
    }
    if (request.count && count_->mark_count() < 1)
      throw UsageError(
          "--peer-count: expected a group in it that holds the number, as in 'photons: ([0-9]+)'");
  }

  std::string text(double photons) const {
    const double brightness = brightness_for(workload_, simulator_, photons);
    std::string text = replaced(request_.command, "{photons}", fmt::format("{:.0f}", photons));
    text = replaced(text, "{brightness}",
                    brightness < 1e4 ? fmt::format("{:.6g}", brightness) : fmt::format("{:.0f}", brightness));
    return replaced(replaced(text, "{workload}", workload_.name), "{ice}", ice_);
  }

  // How many photons the command says that it propagated.
  double counted(const CommandResult& result, double asked) const {
    if (!count_) return asked;
    std::istringstream lines(result.printed);
    double sum = 0;
    std::smatch match;
    for (std::string line; std::getline(lines, line);)
      if (std::regex_search(line, match, *count_)) sum += std::stod(match[1]);
    return sum;
  }

 private:
  const PeerRequest& request_;
  const Simulator& simulator_;
  const std::string& ice_;
  const Workload& workload_;
  std::optional<std::regex> count_;
};

struct Turn {
  double photons, cpu_seconds, wall_seconds;
};

Turn peer_turn(const PeerCommand& command, double photons) {
  const CommandResult result = run_command(command.text(photons));
  return {command.counted(result, photons), result.cost.cpu_seconds, result.cost.wall_seconds};
}

Turn floe_turn(const Simulator& simulator, const Source& source, double photons, std::uint64_t seed,
               int threads) {
  const TimedRun run = run_photons(simulator, source, photons, seed, threads);
  return {static_cast<double>(run.summary.propagated), run.cpu_seconds, run.summary.seconds};
}

struct Startup {
  double cpu_seconds, wall_seconds;
};
Startup startup_of(const std::vector<Turn>& smallest) {
  std::vector<double> cpu, wall;
  for (const Turn& turn : smallest) {
    cpu.push_back(turn.cpu_seconds);
    wall.push_back(turn.wall_seconds);
  }
  return {spread_of(cpu).median, spread_of(wall).median};
}

PeerComparison comparison_of(const std::vector<Turn>& floe, const std::vector<Turn>& peer,
                             const Startup& startup) {
  std::vector<double> photons, floe_speed, peer_speed, ratio, ratio_by_wall;
  for (std::size_t i = 0; i < floe.size(); ++i) {
    const double cpu = peer[i].cpu_seconds - startup.cpu_seconds;
    const double wall = peer[i].wall_seconds - startup.wall_seconds;
    if (!(peer[i].photons > 0 && cpu > 0 && wall > 0))
      throw UsageError(fmt::format(
          "the peer propagated {} photons in {:.3g} s beyond its start-up; expected more of both. "
          "Raise --peer-photons, and see that --peer-count finds the number",
          peer[i].photons, cpu));
    photons.push_back(peer[i].photons);
    floe_speed.push_back(floe[i].photons / floe[i].cpu_seconds);
    peer_speed.push_back(peer[i].photons / cpu);
    ratio.push_back(floe_speed.back() / peer_speed.back());
    ratio_by_wall.push_back(floe[i].photons / floe[i].wall_seconds * wall / peer[i].photons);
  }
  return {0,
          spread_of(photons).median,
          startup.cpu_seconds,
          spread_of(floe_speed),
          spread_of(peer_speed),
          spread_of(ratio),
          spread_of(ratio_by_wall)};
}

}  // namespace

PeerComparison compare_with_peer(const Simulator& simulator, const std::string& ice, const Workload& workload,
                                 double photons, std::uint64_t seed, int threads,
                                 const PeerRequest& request) {
  const PeerCommand command(request, simulator, ice, workload);
  const double brightness = brightness_for(workload, simulator, request.photons);
  const auto source = make_source(workload, simulator.model(), brightness);
  constexpr double smallest_work = 1;

  std::vector<Turn> floe, peer, smallest;
  for (int round = 0; round < request.rounds; ++round) {
    floe.push_back(floe_turn(simulator, *source, photons, seed + static_cast<std::uint64_t>(round), threads));
    peer.push_back(peer_turn(command, request.photons));
    smallest.push_back(peer_turn(command, smallest_work));
  }
  PeerComparison comparison = comparison_of(floe, peer, startup_of(smallest));
  comparison.brightness = brightness;
  return comparison;
}

}  // namespace floe
