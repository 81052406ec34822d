#include "propagation/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "data/base/error.h"
#include "propagation/effects/switches.h"
#include "propagation/effects_file.h"

namespace floe {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view builtin_ice = "south-pole", builtin_detector = "ic86";
constexpr std::string_view geometry_file = "geo-f2k", angular_file = "as.dat", spectrum_file = "wv.dat",
                           high_qe_file = "wv.rde";

IceTables load_tables(const ModelRequest& request) {
  if (request.ice != builtin_ice) return read_ice_tables(request.ice, request.ice_version);
  if (request.ice_version)
    throw UsageError(
        "an ice version belongs to an ice-model directory; the built-in ice 'south-pole' has none");
  return south_pole_ice();
}

Detector load_detector(const ModelRequest& request) {
  if (request.detector) {
    const fs::path named = *request.detector;
    if (*request.detector == builtin_detector) return ic86_detector();
    if (!fs::exists(named))
      throw InputError({named.string()}, "no such file or directory",
                       "a geo-f2k file, a directory that holds one, or ic86 (built-in)");
    return fs::is_directory(named) ? read_detector(named) : read_detector_geometry(named);
  }
  if (request.ice == builtin_ice) return ic86_detector();
  if (!fs::exists(fs::path(request.ice) / geometry_file))
    throw InputError({request.ice}, "no geo-f2k", "the detector's geometry in the ice-model directory",
                     "Name one with --detector FILE, or --detector ic86 for the built-in detector");
  return read_detector(request.ice);
}

// Where the modules' acceptance comes from: the first of the ice's and the detector's directory that
// says anything about it.
std::optional<fs::path> acceptance_directory(const ModelRequest& request) {
  std::vector<fs::path> candidates;
  if (request.ice != builtin_ice) candidates.emplace_back(request.ice);
  if (request.detector && fs::is_directory(*request.detector)) candidates.emplace_back(*request.detector);
  for (const auto& directory : candidates)
    for (auto file : {angular_file, spectrum_file, high_qe_file})
      if (fs::exists(directory / file)) return directory;
  return {};
}

ModuleAcceptance load_acceptance(const ModelRequest& request) {
  const auto directory = acceptance_directory(request);
  if (!directory) {
    if (request.ice == builtin_ice || request.detector == builtin_detector) return builtin_acceptance();
    throw InputError({request.ice}, "neither as.dat nor wv.dat",
                     "the modules' angular acceptance (as.dat) and acceptance-weighted spectrum (wv.dat)",
                     "Add the files, or use --detector ic86 for the built-in detector and its acceptance");
  }
  ModuleAcceptance acceptance;
  acceptance.angular = read_angular_acceptance(*directory / angular_file);
  acceptance.spectrum = read_wavelength_spectrum(*directory / spectrum_file);
  if (fs::exists(*directory / high_qe_file))
    acceptance.high_qe = read_high_qe_ratio(*directory / high_qe_file);
  return acceptance;
}

void expect_high_qe_ratio(const Detector& detector, const ModuleAcceptance& acceptance) {
  if (acceptance.high_qe) return;
  const auto& modules = detector.modules();
  const auto high =
      std::find_if(modules.begin(), modules.end(), [](const Module& m) { return m.high_qe_spectrum; });
  if (high == modules.end()) return;
  throw InputError({"detector " + detector.name()},
                   fmt::format("module {},{} of type 1 (high quantum efficiency) without wv.rde",
                               high->id.string, high->id.dom),
                   "wv.rde, the ratio of high-QE to nominal acceptance, beside wv.dat",
                   "Add the file, or remove the type from eff-f2k");
}

Detector without_cables(const Detector& detector) {
  std::vector<Module> modules = detector.modules();
  for (Module& module : modules) module.cable_azimuth.reset();
  return {detector.name(), std::move(modules), detector.strings()};
}

void switch_off(ModelParts& parts, const std::string& effect) {
  switch_off(parts.ice, effect);
  if (effect == "cable-shadow") parts.detector = without_cables(parts.detector);
}

ModelParts load_parts(const ModelRequest& request) {
  ModelParts parts{load_tables(request), load_detector(request), load_acceptance(request)};
  expect_high_qe_ratio(parts.detector, parts.acceptance);
  parts.acceptance.overall_efficiency = parts.ice.configuration.module_efficiency;
  return parts;
}

}  // namespace

Model freeze(ModelParts parts) {
  auto ice = std::make_shared<const IceModel>(std::move(parts.ice), parts.detector);
  return {std::make_shared<const Detector>(std::move(parts.detector)), std::move(ice),
          std::move(parts.acceptance), parts.sources, parts.noise_rate};
}

ModelDifference difference(const Model& a, const Model& b) {
  return {.ice = a.ice->hash() != b.ice->hash(),
          .detector = a.detector->hash() != b.detector->hash(),
          .acceptance = a.acceptance != b.acceptance,
          .sources = a.sources != b.sources,
          .noise_rate = a.noise_rate != b.noise_rate};
}

bool changes_ice(const std::vector<EffectSetting>& effects, const Model& model) {
  ModelParts parts = parts_of(model);
  apply_effects(effects, parts);
  return freeze(std::move(parts)).ice->hash() != model.ice->hash();
}

ModelParts parts_of(const Model& model) {
  return {model.ice->tables(), *model.detector, model.acceptance, model.sources, model.noise_rate};
}

Model load_without_effects(const ModelRequest& request) {
  return freeze(load_parts(request));
}

Model load_model(const ModelRequest& request) {
  // Names first, before any file is read.
  for (const auto& effect : request.without) expect_known_effect(effect);
  for (const auto& setting : request.with) find_effect(setting.effect);
  ModelParts parts = load_parts(request);
  if (request.ice != builtin_ice)
    for (const auto& group : read_effects_file(request.ice)) apply_effects(group, parts);
  for (const auto& effect : request.without) switch_off(parts, effect);
  apply_effects(request.with, parts);
  return freeze(std::move(parts));
}

}  // namespace floe
