// Everything a simulation is made of besides the source: ice, modules, how modules accept light, and how
// sources differ from what is said of them.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/acceptance.h"
#include "geometry/detector.h"
#include "propagation/effects/effect.h"
#include "propagation/ice/ice_model.h"
#include "propagation/model_parts.h"

namespace floe {

struct Model {
  std::shared_ptr<const Detector> detector;
  std::shared_ptr<const IceModel> ice;
  ModuleAcceptance acceptance;
  SourceSettings sources = {};
  double noise_rate =
      0;  // of every module [Hz]; simulations add its hits where they are asked to (noise_hits.h)
};

// Which parts of two models differ.
struct ModelDifference {
  bool ice, detector, acceptance, sources, noise_rate;
  bool operator==(const ModelDifference&) const = default;
};
ModelDifference difference(const Model& a, const Model& b);

// Checks the parts and works out what follows. Throws InputError (see IceModel).
Model freeze(ModelParts parts);
// Whether these effects, applied to the model, change its ice.
bool changes_ice(const std::vector<EffectSetting>& effects, const Model& model);
// What freeze() makes the same model of.
ModelParts parts_of(const Model& model);

// How a user names a model on the command line.
struct ModelRequest {
  std::string ice = "south-pole";       // a directory, or "south-pole"
  std::optional<int> ice_version;       // overrides the directory's `version`
  std::optional<std::string> detector;  // a geo-f2k file, a directory, or "ic86"; default: of the ice
  std::vector<std::string> without;     // effects to switch off, see switch_off()
  std::vector<EffectSetting> with;      // effects to apply after that, see propagation/effects/effect.h
};

// Reads and validates. Built-in ice takes the built-in detector and acceptance unless named otherwise.
// as.dat, wv.dat and wv.rde are those of the ice directory, else of the detector directory; without any of
// them, the built-in acceptance serves when ice or detector are built in. The overall efficiency is the
// ice's. Effects in the ice directory's floe.toml (effects_file.h) are applied first. Throws InputError
// (missing or malformed files; modules of high quantum efficiency without wv.rde; neither acceptance; what
// the effects leave is not physical), UsageError (unknown effect, parameter or version, a parameter's value
// out of its range).
Model load_model(const ModelRequest& request);
// The same before any effect is applied or switched off: neither those of floe.toml nor --with nor --without.
Model load_without_effects(const ModelRequest& request);

// Names that switch_off() takes, in the order in which help lists them: birefringence (its scattering
// subtraction goes too), birefringence.diffusion, .deflection, .displacement, absorption-anisotropy,
// scattering-anisotropy, tilt, hole-ice, cable-shadow, bubbles.
std::vector<std::string> switchable_effects();

// Switches an effect off in the tables. Throws UsageError naming the known effects, most similar first,
// otherwise. Parts of birefringence leave its scattering subtraction as it is. The old anisotropy of
// absorption follows from k1 and k2 of scattering, so that it goes with either of the two anisotropies.
// "cable-shadow" belongs to the detector and leaves the ice as it is (see load_model).
void switch_off(IceTables& tables, std::string_view effect);

}  // namespace floe
