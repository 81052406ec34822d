#include "reco/ice_fit/run_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "data/base/constants.h"
#include "data/base/error.h"

namespace floe {

namespace {

// A module that should have seen so much and saw nothing is dead: exp(-30).
constexpr double plenty = 30;
// Less than this share of the expected light, in every run where that is plenty, is no property of ice
// either.
constexpr double hardly_any = 0.02;

// Single photoelectrons do not all have the same charge. Told by modules that seldom have two in a flash: a
// sum of n charges q has the variance n <q^2>.
double charge_dispersion(const RunData& data) {
  constexpr double seldom = 0.1;  // photoelectrons a flash
  std::vector<double> light(data.used.size(), 0);
  for (const RunData::Pulse& pulse : data.pulses) light[pulse.module] += pulse.charge / data.repeats;
  double sum = 0, squares = 0;
  for (const RunData::Pulse& pulse : data.pulses) {
    if (light[pulse.module] > seldom) continue;
    sum += pulse.charge;
    squares += pulse.charge * pulse.charge;
  }
  return sum > 0 ? std::max(1.0, squares / sum) : 1;
}

// Modules that were off in the record, and those that could not follow the light.
void leave_out_recorded_badly(const Detector& detector, const Readout& readout, std::vector<char>& used) {
  for (const RecordingModule& module : *readout.modules)
    if (!module.on) used[detector.index_of(module.id)] = 0;
  for (const UnusableTimes& times : readout.unusable)
    if (times.reason == UnusableTimes::Reason::saturated) used[detector.index_of(times.module)] = 0;
}

// What fits have to know of the electronics that are not in the light.
void take_record(const Readout& readout, RunData& data) {
  data.first = readout.begin, data.last = readout.end;
  data.afterpulses = readout.afterpulses;
  data.delays = readout.delays;
  double on = 0;
  for (const RecordingModule& module : *readout.modules) {
    if (!module.on) continue;
    data.noise_rate += module.noise_rate;
    on += 1;
  }
  if (on > 0) data.noise_rate /= on;
  data.charge_dispersion = charge_dispersion(data);
}

RunData run_data(const Detector& detector, const Event& event) {
  RunData data;
  data.name = event.id;
  data.run = *event.flasher;
  data.repeats = event.repeats;
  data.used.assign(detector.size(), 1);
  for (std::size_t i = 0; i < detector.size(); ++i)
    if (!detector.modules()[i].on) data.used[i] = 0;
  data.used[detector.index_of(data.run.module)] = 0;  // it does not see its own light
  if (event.readout) leave_out_recorded_badly(detector, *event.readout, data.used);
  for (const Hit& hit : event.hits) {
    const auto module = static_cast<std::uint32_t>(detector.index_of(hit.module));
    if (!data.used[module]) continue;
    data.pulses.push_back({module, hit.time, hit.width > 0 ? hit.width : 0, hit.charge * event.repeats});
    data.charge += data.pulses.back().charge;
  }
  if (!data.pulses.empty()) {
    const auto [first, last] = std::ranges::minmax(data.pulses, {}, &RunData::Pulse::time);
    data.first = first.time, data.last = last.time;
  }
  if (event.readout) take_record(*event.readout, data);
  return data;
}

// The wavelength of most runs.
double usual_wavelength(const std::vector<RunData>& runs) {
  std::map<double, int> count;
  for (const RunData& run : runs) ++count[run.run.wavelength];
  double usual = 0;
  for (const auto& [wavelength, runs_of_it] : count)
    if (usual == 0 || runs_of_it > count[usual]) usual = wavelength;
  return usual;
}

// `problem` says in words why a run is left out; empty: it is not.
template <class Problem>
void leave_out_runs(FlasherData& data, Problem problem) {
  std::vector<RunData> good;
  for (RunData& run : data.runs)
    if (const std::string why = problem(run); why.empty())
      good.push_back(std::move(run));
    else
      data.left_out.push_back(fmt::format("run {}: {}", run.name, why));
  data.runs = std::move(good);
}

}  // namespace

Eigen::VectorXd RunData::counts(const RunBins& bins) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(bins.size());
  for (const Pulse& pulse : pulses)
    bins.add_spread(pulse.module, pulse.time, pulse.width, pulse.charge, result);
  return result;
}

double flasher_depth(const RunData& run, const Detector& detector) {
  return origin_depth - detector.modules()[detector.index_of(run.run.module)].position.z();
}

FlasherDepths flasher_depths(const FlasherData& data, const Detector& detector) {
  const double first = flasher_depth(data.runs.front(), detector);
  FlasherDepths depths{first, first};
  for (const RunData& run : data.runs) {
    const double depth = flasher_depth(run, detector);
    depths = {std::min(depths.shallowest, depth), std::max(depths.deepest, depth)};
  }
  return depths;
}

FlasherData flasher_data(const Detector& detector, std::span<const Event> events) {
  FlasherData data;
  for (const Event& event : events) {
    if (event.flasher)
      data.runs.push_back(run_data(detector, event));
    else
      data.left_out.push_back(fmt::format("event {}: not a flasher run", event.id));
  }
  leave_out_runs(
      data, [](const RunData& run) { return run.charge > 0 ? "" : std::string("no light on any module"); });
  const double usual = usual_wavelength(data.runs);
  leave_out_runs(data, [&](const RunData& run) {
    return run.run.wavelength == usual
               ? ""
               : fmt::format(
                     "flashes at {:g} nm, most others at {:g} nm; fit them apart, since the ice's numbers "
                     "are fitted for one colour",
                     run.run.wavelength, usual);
  });
  if (data.runs.empty()) throw NoResult("not enough light: no flasher run with light on any module");
  return data;
}

namespace {

std::vector<double> charges_of(const RunData& run) {  // by module
  std::vector<double> charges(run.used.size(), 0.0);
  for (const RunData::Pulse& pulse : run.pulses) charges[pulse.module] += pulse.charge;
  return charges;
}

void drop_unused_pulses(RunData& run) {
  std::erase_if(run.pulses, [&](const RunData::Pulse& pulse) { return !run.used[pulse.module]; });
  run.charge = 0;
  for (const RunData::Pulse& pulse : run.pulses) run.charge += pulse.charge;
}

std::string name_of_module(const Detector& detector, std::size_t module) {
  return module_name(detector.modules()[module].id);
}

// `light`: of each module, of all flashes together.
void leave_out_saturated(const Detector& detector, const std::vector<double>& light, const char* seen,
                         double saturation, RunData& run, std::vector<std::string>& left_out) {
  if (run.run.oversize > 1) return;  // photons that no electronics have seen do not saturate
  for (std::size_t module = 0; module < light.size(); ++module) {
    const double flash = light[module] / run.repeats;
    if (!run.used[module] || flash <= saturation) continue;
    run.used[module] = 0;
    left_out.push_back(
        fmt::format("{} in run {}: {:.3g} photoelectrons a flash {}, above the limit of {:.3g}: saturated",
                    name_of_module(detector, module), run.name, flash, seen, saturation));
  }
  drop_unused_pulses(run);
}

}  // namespace

void leave_out_bright_receivers(const Detector& detector, double saturation, FlasherData& data) {
  for (RunData& run : data.runs)
    leave_out_saturated(detector, charges_of(run), "seen", saturation, run, data.left_out);
}

void leave_out_bad_receivers(const Detector& detector, const std::vector<std::vector<double>>& expected,
                             double saturation, FlasherData& data) {
  std::vector<double> should(detector.size(), 0.0), saw(detector.size(), 0.0);
  for (std::size_t r = 0; r < data.runs.size(); ++r) {
    RunData& run = data.runs[r];
    leave_out_saturated(detector, expected[r], "expected", saturation, run, data.left_out);
    const std::vector<double> charges = charges_of(run);
    for (std::size_t module = 0; module < detector.size(); ++module) {
      if (!run.used[module]) continue;
      should[module] += expected[r][module];
      saw[module] += charges[module];
    }
  }
  for (std::size_t module = 0; module < detector.size(); ++module) {
    if (should[module] < plenty || saw[module] > hardly_any * should[module]) continue;
    data.left_out.push_back(
        fmt::format("{}: {:.3g} photoelectrons where about {:.3g} are expected: dead, or off",
                    name_of_module(detector, module), saw[module], should[module]));
    for (RunData& run : data.runs) run.used[module] = 0;
  }
  for (RunData& run : data.runs) drop_unused_pulses(run);
}

}  // namespace floe
