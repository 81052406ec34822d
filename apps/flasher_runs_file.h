// Flasher runs to simulate, as a user writes them down: a TOML file (docs/formats.md).
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "data/flasher_run.h"
#include "propagation/sources/flasher.h"
#include "propagation/sources/measured_curve.h"

namespace floe {

struct RunToSimulate {
  FlasherRun run;  // its photons and orientation are known
  int repeats = 1;
  // Whether the LED's line is simulated whole, because its wavelength was named. Otherwise the middle of the
  // line at 405 nm is (reference_led_line).
  bool whole_line = false;
  // Of the run's photons, which count a whole line.
  double simulated_share() const { return whole_line ? 1 : reference_led_share; }

  // Measured, in place of the widths of `run`, which are then equivalents.
  std::optional<MeasuredCurve> beam = {}, pulse = {};
};

// The runs of a file's [[run]] tables, in order; what its table [defaults] names holds for every run that
// does not name it. At least one run. Throws InputError, with the line: no such file, not TOML, an unknown
// key, a value of another kind or out of range, a run without module or photons.
std::vector<RunToSimulate> read_flasher_runs(const std::filesystem::path& file);

}  // namespace floe
