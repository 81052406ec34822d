#include "apps/planned_light.h"

#include <fmt/format.h>

#include <limits>

#include "data/base/error.h"
#include "data/event_files.h"
#include "propagation/sources/flasher.h"
#include "propagation/sources/muon.h"

namespace floe {

namespace {

// Drawn from a photon number that no photon has, so that it is independent of the photons.
constexpr std::uint64_t yield_draw = std::numeric_limits<std::uint64_t>::max();

const char* f2k_name(CascadeKind kind) {
  switch (kind) {
    case CascadeKind::electron:
      return "e-";
    case CascadeKind::positron:
      return "e+";
    case CascadeKind::gamma:
      return "gamma";
    case CascadeKind::hadron:
      return "hadr";
    case CascadeKind::pi_minus:
      return "pi-";
    case CascadeKind::kaon:
      return "K0L";
    case CascadeKind::proton:
      return "p";
    case CascadeKind::neutron:
      return "n";
    case CascadeKind::antiproton:
      return "pbar";
  }
  return "";
}

Particle particle_of(const Cascade& cascade) {
  Particle particle;
  particle.name = f2k_name(cascade.kind);
  particle.position = cascade.position;
  particle.zenith = cascade.zenith;
  particle.azimuth = cascade.azimuth;
  particle.energy = cascade.energy;
  particle.time = cascade.time;
  return particle;
}

// Of the particles that f2k names, those that are neither muons nor photons.
CascadeKind kind_of_f2k(const std::string& name) {
  if (name == "e" || name == "delta" || name == "brems" || name == "epair") return CascadeKind::electron;
  if (name == "hadr" || name == "munu") return CascadeKind::hadron;
  return cascade_kind_of(name);
}

Cascade cascade_of(const Particle& particle) {
  return {particle.position, particle.time,   particle.zenith,
          particle.azimuth,  particle.energy, kind_of_f2k(particle.name)};
}

// What cannot be made says so now.
PlannedSource planned_source(const Simulator& simulator, std::function<std::unique_ptr<Source>()> make,
                             bool fixed_number = false) {
  const double photons = simulator.photons_to_propagate(*make());
  return {std::move(make), photons, fixed_number};
}

PlannedSource cascade_source(const Cascade& cascade, const Simulator& simulator, std::uint64_t seed,
                             std::uint64_t stream) {
  RandomStream random(seed, stream, yield_draw);
  const double fluctuation = draw_yield_fluctuation(cascade.kind, cascade.energy, random);
  return planned_source(simulator, [cascade, fluctuation, &model = simulator.model()] {
    return std::make_unique<CascadeSource>(cascade, model.acceptance.spectrum, fluctuation);
  });
}

PlannedSource photon_source(const Particle& particle, const Simulator& simulator) {
  const auto make = [particle, &model = simulator.model()] {
    return std::make_unique<PointSource>(particle.position, particle.time, particle.energy,
                                         model.acceptance.spectrum,
                                         travel_direction(particle.zenith, particle.azimuth));
  };
  return planned_source(simulator, make, true);
}

PlannedSource muon_source(const Particle& particle, const Simulator& simulator) {
  const MuonSegment muon{particle.position, particle.time,   particle.zenith,
                         particle.azimuth,  particle.length, particle.energy};
  return planned_source(simulator, [muon, &model = simulator.model()] {
    return std::make_unique<MuonSource>(muon, model.acceptance.spectrum);
  });
}

PlannedSource source_of(const Particle& particle, const Simulator& simulator, std::uint64_t seed,
                        std::uint64_t stream) {
  if (particle.name == "ph") return photon_source(particle, simulator);
  if (particle.name.starts_with("amu")) return muon_source(particle, simulator);
  return cascade_source(cascade_of(particle), simulator, seed, stream);
}

PlannedEvent plan_point(const PointRequest& request, const Simulator& simulator) {
  LaserSettings light = request.light;
  if (request.emitted)
    light.photons =
        *request.emitted * accepted_share(light.wavelength, simulator.model().acceptance.spectrum);
  PlannedEvent event{request.id, {}, {}};
  event.sources.push_back(
      planned_source(simulator, [light] { return std::make_unique<LaserSource>(light); }));
  return event;
}

PlannedSource flasher_source(const FlasherSettings& settings, ModuleId module, const WavelengthSpectrum& line,
                             const Simulator& simulator) {
  return planned_source(simulator, [settings, module, line, &model = simulator.model()] {
    return std::make_unique<FlasherSource>(*model.detector, module, adjusted(settings, model.sources), line);
  });
}

PlannedEvent plan_flasher(const FlasherRequest& request, const Simulator& simulator) {
  FlasherSettings settings;
  // N counts a whole line of light; without a wavelength only its middle is simulated.
  settings.photons = request.photons * (request.wavelength ? 1 : reference_led_share);
  settings.beam_width = request.width_deg * degree;
  settings.elevation = request.elevation_deg * degree;
  if (request.azimuth_deg) settings.azimuth = *request.azimuth_deg * degree;
  settings.isotropic = request.isotropic;
  settings.beam = request.beam;
  settings.pulse = request.pulse;
  PlannedEvent event{fmt::format("flasher-{}-{}", request.module.string, request.module.dom), {}, {}};
  event.sources.push_back(
      flasher_source(settings, request.module,
                     request.wavelength ? led_line(*request.wavelength) : reference_led_line(), simulator));
  return event;
}

PlannedEvent plan_run(const RunToSimulate& planned, const std::string& id, const Simulator& simulator) {
  FlasherSettings settings = flasher_settings(planned.run);
  settings.photons *= planned.repeats * planned.simulated_share();
  settings.beam = planned.beam;
  settings.pulse = planned.pulse;
  PlannedEvent event{id, {}, {}, static_cast<double>(planned.repeats), planned.run};
  event.sources.push_back(flasher_source(
      settings, planned.run.module,
      planned.whole_line ? led_line(planned.run.wavelength) : reference_led_line(), simulator));
  return event;
}

std::vector<PlannedEvent> plan_runs(const std::vector<RunToSimulate>& runs, const Simulator& simulator) {
  FlasherRunNames names;
  std::vector<PlannedEvent> planned;
  for (const RunToSimulate& run : runs)
    planned.push_back(plan_run(run, names.next(run.run.module), simulator));
  return planned;
}

PlannedEvent plan_cascade(const Cascade& cascade, const Simulator& simulator, std::uint64_t seed) {
  PlannedEvent event{"cascade", {particle_of(cascade)}, {}};
  event.sources.push_back(cascade_source(cascade, simulator, seed, 0));
  return event;
}

std::vector<PlannedEvent> plan_f2k(const std::string& file, const Simulator& simulator, std::uint64_t seed) {
  std::vector<PlannedEvent> planned;
  std::uint64_t stream = 0;
  for (Event& event : read_f2k(file)) {
    planned.push_back({event.id, std::move(event.truth), {}});
    for (const Particle& particle : planned.back().truth) {
      planned.back().sources.push_back(source_of(particle, simulator, seed, stream));
      ++stream;
    }
  }
  return planned;
}

Json flasher_json(const FlasherRequest& request) {
  Json json = {{"string", request.module.string}, {"dom", request.module.dom}, {"photons", request.photons}};
  json["wavelength_nm"] = request.wavelength ? Json(*request.wavelength) : Json();
  json["isotropic"] = request.isotropic;
  if (request.pulse) json["pulse"] = to_json(*request.pulse);
  if (request.isotropic) return json;
  if (request.beam)
    json["beam"] = to_json(*request.beam, degree);
  else
    json["width_deg"] = request.width_deg;
  json["elevation_deg"] = request.elevation_deg;
  json["azimuth_deg"] = request.azimuth_deg ? Json(*request.azimuth_deg) : Json();
  return json;
}

Json run_json(const RunToSimulate& planned) {
  const FlasherRun& run = planned.run;
  Json json = {{"module", {run.module.string, run.module.dom}},
               {"leds", name_of(run.leds)},
               {"orientation_deg", run.orientation / degree},
               {"wavelength_nm", planned.whole_line ? Json(run.wavelength) : Json()},
               {"width_deg", run.beam_width / degree},
               {"pulse_width_ns", run.pulse_width},
               {"photons", run.photons},
               {"repeats", planned.repeats}};
  if (planned.beam) json["beam"] = to_json(*planned.beam, degree);
  if (planned.pulse) json["pulse"] = to_json(*planned.pulse);
  return json;
}

Json runs_json(const std::vector<RunToSimulate>& runs) {
  Json json = Json::array();
  for (const RunToSimulate& run : runs) json.push_back(run_json(run));
  return json;
}

Json cascade_json(const Cascade& cascade) {
  return {{"particle", f2k_name(cascade.kind)},
          {"x", cascade.position.x()},
          {"y", cascade.position.y()},
          {"z", cascade.position.z()},
          {"time_ns", cascade.time},
          {"zenith_deg", cascade.zenith / degree},
          {"azimuth_deg", cascade.azimuth / degree},
          {"energy_gev", cascade.energy}};
}

}  // namespace

double PlannedEvent::photons() const {
  double sum = 0;
  for (const PlannedSource& planned : sources) sum += planned.photons;
  return sum;
}

Json to_json(const SourceRequest& request) {
  if (request.flasher) return {{"flasher", flasher_json(*request.flasher)}};
  if (request.flashers) return {{"flashers", runs_json(*request.flashers)}};
  if (request.cascade) return {{"cascade", cascade_json(*request.cascade)}};
  if (request.point) return {{request.point->id, to_json(*request.point)}};
  return {{"f2k", request.f2k.value()}};
}

std::vector<PlannedEvent> plan_light(const SourceRequest& request, const Simulator& simulator,
                                     std::uint64_t seed) {
  if (request.f2k) return plan_f2k(*request.f2k, simulator, seed);
  if (request.flashers) return plan_runs(*request.flashers, simulator);
  std::vector<PlannedEvent> planned;
  planned.push_back(request.flasher ? plan_flasher(*request.flasher, simulator)
                    : request.point ? plan_point(*request.point, simulator)
                                    : plan_cascade(request.cascade.value(), simulator, seed));
  return planned;
}

}  // namespace floe
