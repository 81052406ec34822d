#include "reco/ice_fit/run_data.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "data/base/error.h"

namespace floe {

namespace {

// A module that should have seen so much and saw nothing is dead: exp(-30).
constexpr double plenty = 30;
// Less than this share of the expected light, in every run where that is plenty, is no property of ice
// either.
constexpr double hardly_any = 0.02;

RunData run_data(const Detector& detector, const Event& event) {
  RunData data;
  data.name = event.id;
  data.run = *event.flasher;
  data.repeats = event.repeats;
  data.used.assign(detector.size(), 1);
  for (std::size_t i = 0; i < detector.size(); ++i)
    if (!detector.modules()[i].on) data.used[i] = 0;
  data.used[detector.index_of(data.run.module)] = 0;  // it does not see its own light
  for (const Hit& hit : event.hits) {
    const auto module = static_cast<std::uint32_t>(detector.index_of(hit.module));
    if (!data.used[module]) continue;
    data.pulses.push_back({module, hit.time, hit.charge * event.repeats});
    data.charge += data.pulses.back().charge;
  }
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

void leave_out_run(FlasherData& data, std::size_t i, const std::string& why) {
  data.left_out.push_back(fmt::format("run {}: {}", data.runs[i].name, why));
  data.runs.erase(data.runs.begin() + static_cast<std::ptrdiff_t>(i));
}

}  // namespace

Eigen::VectorXd RunData::counts(const RunBins& bins) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(bins.size());
  for (const Pulse& pulse : pulses)
    if (const int bin = bins.bin(pulse.module, pulse.time); bin >= 0) result(bin) += pulse.charge;
  return result;
}

FlasherData flasher_data(const Detector& detector, std::span<const Event> events) {
  FlasherData data;
  for (const Event& event : events) {
    if (event.flasher)
      data.runs.push_back(run_data(detector, event));
    else
      data.left_out.push_back(fmt::format("event {}: not a flasher run", event.id));
  }
  for (std::size_t i = data.runs.size(); i-- > 0;)
    if (!(data.runs[i].charge > 0)) leave_out_run(data, i, "no light on any module");
  const double usual = usual_wavelength(data.runs);
  for (std::size_t i = data.runs.size(); i-- > 0;)
    if (const double wavelength = data.runs[i].run.wavelength; wavelength != usual)
      leave_out_run(data, i,
                    fmt::format("flashes at {:g} nm, most others at {:g} nm; fit them apart, since the ice's "
                                "numbers are fitted for one colour",
                                wavelength, usual));
  if (data.runs.empty()) throw NoResult("not enough light: no flasher run with light on any module");
  return data;
}

namespace {

double charge_of(const RunData& run, std::size_t module) {
  double charge = 0;
  for (const RunData::Pulse& pulse : run.pulses)
    if (pulse.module == module) charge += pulse.charge;
  return charge;
}

void leave_out_receiver(RunData& run, std::size_t module) {
  run.used[module] = 0;
  run.charge -= charge_of(run, module);
  std::erase_if(run.pulses, [&](const RunData::Pulse& pulse) { return pulse.module == module; });
}

void leave_out_saturated(const std::string& name, std::size_t module, double expected, double saturation,
                         RunData& run, std::vector<std::string>& left_out) {
  // Photons that no electronics have seen do not saturate.
  if (!run.used[module] || run.run.oversize > 1) return;
  const double flash = std::max(charge_of(run, module), expected) / run.repeats;
  if (flash <= saturation) return;
  left_out.push_back(
      fmt::format("{} in run {}: {:.3g} photoelectrons a flash, above the limit of {:.3g}: saturated", name,
                  run.name, flash, saturation));
  leave_out_receiver(run, module);
}

}  // namespace

void leave_out_bad_receivers(const Detector& detector, const std::vector<std::vector<double>>& expected,
                             double saturation, FlasherData& data) {
  for (std::size_t module = 0; module < detector.size(); ++module) {
    const std::string name = module_name(detector.modules()[module].id);
    double should = 0, saw = 0;
    for (std::size_t r = 0; r < data.runs.size(); ++r) {
      RunData& run = data.runs[r];
      leave_out_saturated(name, module, expected[r][module], saturation, run, data.left_out);
      if (!run.used[module]) continue;
      should += expected[r][module];
      saw += charge_of(run, module);
    }
    if (should < plenty || saw > hardly_any * should) continue;
    data.left_out.push_back(fmt::format(
        "{}: {:.3g} photoelectrons where about {:.3g} are expected: dead, or off", name, saw, should));
    for (RunData& run : data.runs)
      if (run.used[module]) leave_out_receiver(run, module);
  }
}

}  // namespace floe
