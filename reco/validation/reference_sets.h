// The photon hits that an independent program made with public ice models, and the same simulations by
// floe: what `floe validate` compares.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "data/base/progress.h"
#include "propagation/engine/simulator.h"
#include "reco/validation/sample_comparison.h"

namespace floe {

// A set: a file of hits, and how to make them again.
struct ReferenceSet {
  std::string name;  // of the file, without .hits.gz
  std::string ice;   // name of the public ice model
  std::vector<std::string> without;
  enum class Kind { flasher, isotropic_flash, cascade } kind;
  ModuleId module;  // of the flasher
  double photons;   // N of the flasher; unused for the cascade
};
std::vector<ReferenceSet> reference_sets();

// Enough light for a test of the whole chain in a minute; not for a verdict on details.
inline constexpr double quick_share = 0.05;

struct ValidationOptions {
  std::filesystem::path reference;   // folder of the .hits.gz files
  std::filesystem::path ice_models;  // folder of the public ice models
  double share = 1;                  // simulated light in units of the reference's
  EngineKind engine = EngineKind::vector;
  std::uint64_t seed = 1;
  int threads = 0;
};

struct ValidationResult {
  SampleComparison comparison;  // a: floe, b: reference
  double dispersion = 1;        // variance over mean of hits per module, measured in floe's own photons
  SimulationSummary simulation;
  bool total_passes = false, modules_pass = false, times_pass = false, directions_pass = false;
  bool passes() const { return total_passes && modules_pass && times_pass && directions_pass; }
};

// The set's file of hits.
std::filesystem::path reference_file(const ReferenceSet& set, const ValidationOptions& options);

// Totals must agree within 2% (or 3 standard errors where these are larger), hits per module with
// chi-square p > 0.001, times and directions of arrival with KS p > 0.001 over the number of modules tried.
ValidationResult validate_set(const ReferenceSet& set, const ValidationOptions& options,
                              const Progress& progress = {});

}  // namespace floe
