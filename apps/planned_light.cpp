#include "apps/planned_light.h"

#include <fmt/format.h>

#include <limits>
#include <map>

#include "data/base/error.h"
#include "data/event_files.h"
#include "propagation/sources/flasher.h"

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

CascadeKind kind_of_f2k(const Particle& particle, const std::string& file) {
  static const std::map<std::string, CascadeKind> kinds{
      {"e", CascadeKind::electron},     {"e-", CascadeKind::electron},    {"e+", CascadeKind::positron},
      {"gamma", CascadeKind::gamma},    {"delta", CascadeKind::electron}, {"brems", CascadeKind::electron},
      {"epair", CascadeKind::electron}, {"hadr", CascadeKind::hadron},    {"munu", CascadeKind::hadron}};
  const auto found = kinds.find(particle.name);
  if (found == kinds.end())
    throw InputError(
        {file}, fmt::format("a particle \"{}\"", particle.name),
        "e, e-, e+, gamma, delta, brems, epair, hadr, munu or ph",
        "Muon segments (amu, amu+, amu-) are not simulated: remove them, or keep only the losses");
  return found->second;
}

Cascade cascade_of(const Particle& particle, const std::string& file) {
  return {particle.position, particle.time,   particle.zenith,
          particle.azimuth,  particle.energy, kind_of_f2k(particle, file)};
}

PlannedSource cascade_source(const Cascade& cascade, const Model& model, std::uint64_t seed,
                             std::uint64_t stream) {
  RandomStream random(seed, stream, yield_draw);
  const double fluctuation = draw_yield_fluctuation(cascade.kind, cascade.energy, random);
  return {std::make_unique<CascadeSource>(cascade, model.acceptance.spectrum, fluctuation), false};
}

PlannedSource photon_source(const Particle& particle, const Model& model) {
  return {std::make_unique<PointSource>(particle.position, particle.time, particle.energy,
                                        model.acceptance.spectrum,
                                        travel_direction(particle.zenith, particle.azimuth)),
          true};
}

PlannedEvent plan_flasher(const FlasherRequest& request, const Model& model) {
  FlasherSettings settings;
  // N counts a whole line of light; without a wavelength only its middle is simulated.
  settings.photons = request.photons * (request.wavelength ? 1 : reference_led_share);
  settings.beam_width = request.width_deg * degree;
  settings.elevation = request.elevation_deg * degree;
  if (request.azimuth_deg) settings.azimuth = *request.azimuth_deg * degree;
  settings.isotropic = request.isotropic;
  PlannedEvent event{fmt::format("flasher-{}-{}", request.module.string, request.module.dom), {}, {}};
  event.sources.push_back({std::make_unique<FlasherSource>(
                               *model.detector, request.module, adjusted(settings, model.sources),
                               request.wavelength ? led_line(*request.wavelength) : reference_led_line()),
                           false});
  return event;
}

PlannedEvent plan_run(const RunToSimulate& planned, const std::string& id, const Model& model) {
  FlasherSettings settings = flasher_settings(planned.run);
  settings.photons *= planned.repeats * (planned.whole_line ? 1 : reference_led_share);
  PlannedEvent event{id, {}, {}, static_cast<double>(planned.repeats), planned.run};
  event.sources.push_back({std::make_unique<FlasherSource>(
                               *model.detector, planned.run.module, adjusted(settings, model.sources),
                               planned.whole_line ? led_line(planned.run.wavelength) : reference_led_line()),
                           false});
  return event;
}

std::vector<PlannedEvent> plan_runs(const std::vector<RunToSimulate>& runs, const Model& model) {
  FlasherRunNames names;
  std::vector<PlannedEvent> planned;
  for (const RunToSimulate& run : runs) planned.push_back(plan_run(run, names.next(run.run.module), model));
  return planned;
}

PlannedEvent plan_cascade(const Cascade& cascade, const Model& model, std::uint64_t seed) {
  PlannedEvent event{"cascade", {particle_of(cascade)}, {}};
  event.sources.push_back(cascade_source(cascade, model, seed, 0));
  return event;
}

std::vector<PlannedEvent> plan_f2k(const std::string& file, const Model& model, std::uint64_t seed) {
  std::vector<PlannedEvent> planned;
  std::uint64_t stream = 0;
  for (Event& event : read_f2k(file)) {
    planned.push_back({event.id, std::move(event.truth), {}});
    for (const Particle& particle : planned.back().truth) {
      planned.back().sources.push_back(particle.name == "ph"
                                           ? photon_source(particle, model)
                                           : cascade_source(cascade_of(particle, file), model, seed, stream));
      ++stream;
    }
  }
  return planned;
}

Json flasher_json(const FlasherRequest& request) {
  Json json = {{"string", request.module.string}, {"dom", request.module.dom}, {"photons", request.photons}};
  json["wavelength_nm"] = request.wavelength ? Json(*request.wavelength) : Json();
  json["isotropic"] = request.isotropic;
  if (request.isotropic) return json;
  json["width_deg"] = request.width_deg;
  json["elevation_deg"] = request.elevation_deg;
  json["azimuth_deg"] = request.azimuth_deg ? Json(*request.azimuth_deg) : Json();
  return json;
}

Json run_json(const RunToSimulate& planned) {
  const FlasherRun& run = planned.run;
  return {{"module", {run.module.string, run.module.dom}},
          {"leds", name_of(run.leds)},
          {"orientation_deg", run.orientation / degree},
          {"wavelength_nm", planned.whole_line ? Json(run.wavelength) : Json()},
          {"width_deg", run.beam_width / degree},
          {"pulse_width_ns", run.pulse_width},
          {"photons", run.photons},
          {"repeats", planned.repeats}};
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

Json to_json(const SourceRequest& request) {
  if (request.flasher) return {{"flasher", flasher_json(*request.flasher)}};
  if (request.flashers) return {{"flashers", runs_json(*request.flashers)}};
  if (request.cascade) return {{"cascade", cascade_json(*request.cascade)}};
  return {{"f2k", request.f2k.value()}};
}

std::vector<PlannedEvent> plan_light(const SourceRequest& request, const Model& model, std::uint64_t seed) {
  if (request.f2k) return plan_f2k(*request.f2k, model, seed);
  if (request.flashers) return plan_runs(*request.flashers, model);
  std::vector<PlannedEvent> planned;
  planned.push_back(request.flasher ? plan_flasher(*request.flasher, model)
                                    : plan_cascade(request.cascade.value(), model, seed));
  return planned;
}

}  // namespace floe
