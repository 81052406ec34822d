// LED light from a module's flasher board, and light of the same kind from any point.
#pragma once

#include <optional>

#include "data/flasher_run.h"
#include "geometry/acceptance.h"
#include "geometry/detector.h"
#include "propagation/sources/measured_curve.h"
#include "propagation/sources/quantile_table.h"
#include "propagation/sources/source.h"
#include "propagation/sources/source_settings.h"

namespace floe {

// How wide a flasher's spectral line is simulated.
// The LED's line is a smooth step of +-10 nm about the nominal wavelength.
WavelengthSpectrum led_line(double nominal_wavelength);
// The middle of the 405 nm line, which came out as 399-409 nm, is what the reference simulations hold. It
// carries 0.680 of the photons; of these 0.992 are left on a nominal module there, because that program
// reads its efficiency against wavelength one nanometre beside the line.
WavelengthSpectrum reference_led_line();
inline constexpr double reference_led_share = 0.680 * 0.992;

struct FlasherSettings {
  double photons = 0;                // N, acceptance-weighted, before the detector's efficiencies
  double beam_width = 9.7 * degree;  // sigma of the beam; 0: a pencil
  double elevation = -0.2 * degree;  // above the horizontal
  std::optional<double> azimuth;     // of the beam; none: symmetric about the vertical
  int leds = 1;                      // with an azimuth: so many beams alike, evenly about the vertical
  bool isotropic = false;            // emits into all directions alike
  double time = 0;                   // [ns]
  double pulse_width = 0;            // photons leave evenly from `time` on for so long [ns]
  // Measured: each LED's beam, in place of the Gaussian of `beam_width`; the pulse, in place of the even one
  // of `pulse_width`, its times counted from `time`.
  std::optional<MeasuredCurve> beam = {}, pulse = {};
};

// The light of one flash of a run. Throws UsageError when its number of photons is unknown, or the module's
// orientation, where the LEDs' azimuths depend on it.
FlasherSettings flasher_settings(const FlasherRun& run);

// The light of a flasher of which these settings are nominal.
FlasherSettings adjusted(FlasherSettings nominal, const SourceSettings& sources);

// Photons start on the surface of the emitting module, module_radius from its centre in the photon's
// direction, with the time that takes in vacuum. The beam is von Mises-Fisher of concentration
// 1/beam_width^2 about the LED's direction; of several LEDs each gives the same share of the photons. The
// pulse is a box, the simplest shape; flasher boards make pulses of up to 70 ns.
class FlasherSource : public Source {
 public:
  FlasherSource(const Detector& detector, ModuleId module, const FlasherSettings& settings,
                const WavelengthSpectrum& spectrum);
  double photons() const override { return settings_.photons; }
  using Source::emit;
  void emit(RandomStreams& random, EmittedPhotons& photons) const override;
  std::optional<std::size_t> emitting_module() const override { return module_; }

 private:
  FlasherSettings settings_;
  QuantileTable wavelengths_;
  std::size_t module_;
  Vec3f centre_;
  Vec3f led_;  // the first LED's direction, at azimuth 0 when there are LEDs all around
  std::optional<QuantileTable> beam_angles_, pulse_times_;  // where they were measured
};

// All photons start at one place and time, into all directions alike, or along `direction`.
class PointSource : public Source {
 public:
  PointSource(const Vec3& position, double time, double photons, const WavelengthSpectrum& spectrum,
              std::optional<Vec3> direction = {});
  double photons() const override { return photons_; }
  using Source::emit;
  void emit(RandomStreams& random, EmittedPhotons& photons) const override;

 private:
  Vec3 position_;
  double time_, photons_;
  QuantileTable wavelengths_;
  std::optional<Vec3> direction_;
};

}  // namespace floe
