// A flasher run: LEDs of one module flash together, many times, and the other modules see their light.
//
// The board: arXiv:1612.05093. Elevations, beam width and the numbering of the LEDs are those of the field's
// photon propagation and flasher simulation.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "data/base/vec3.h"
#include "data/module_id.h"

namespace floe {

// Which LEDs of the module flash. A flasher board has twelve, six that look up (numbers 1 to 6) and six that
// look sideways (7 to 12), each six 60 degrees apart. A ring stands for the six sideways ones where their
// azimuths do not matter or are not known: their light, symmetric about the vertical.
struct LedPattern {
  enum class Kind { ring, horizontal, tilted, single };
  Kind kind = Kind::ring;
  int number = 0;  // of the single LED, 1 to 12; 0 otherwise

  bool valid() const { return kind == Kind::single ? number >= 1 && number <= 12 : number == 0; }
  double elevation() const;  // above the horizontal [rad]
  // Azimuth of the single LED, or of the first of the six, less that of LED 1 and LED 7 [rad]; LEDs of rising
  // number follow one another counter-clockwise, seen from above.
  double azimuth() const;
  int count() const;  // of LEDs: 6 or 1

  bool operator==(const LedPattern&) const = default;
};

inline constexpr double horizontal_led_elevation = -0.2 * degree;
inline constexpr double tilted_led_elevation = 48.1 * degree;

// "ring", "horizontal", "tilted", or the number of the LED, "1" to "12"; and the pattern of such a name, none
// for any other text.
std::string name_of(const LedPattern& leds);
std::optional<LedPattern> led_pattern_of(std::string_view name);
inline constexpr std::string_view known_led_patterns =
    "ring, horizontal, tilted, or the number of one LED, 1 to 12";

// What is known of a run before its hits are looked at. Over how many flashes the hits are an average says
// the event (Event::repeats). Valid ranges: data/event_rules.h.
struct FlasherRun {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  ModuleId module;  // that flashes
  LedPattern leds;
  double orientation = unknown;      // of the module: azimuth of its LED 1 and its LED 7 [rad]; or unknown
  double wavelength = 405;           // nominal, of the LED's line [nm]
  double beam_width = 9.7 * degree;  // sigma of each LED's beam, after the glass [rad]; 0: a pencil
  double pulse_width = 0;            // the light leaves evenly over this time [ns]; 0: all of it at t = 0
  // Nominal brightness: photons of one flash, as a nominal module would accept them (N of FlasherSettings);
  // or unknown. The true one is not known.
  double photons = unknown;
  double oversize = 1;  // with which the hits were simulated; 1 for measured ones
};

// Names for the events of a file of runs: "63,20", and for further runs of that module "63,20-2", "63,20-3",
// ...
class FlasherRunNames {
 public:
  std::string next(ModuleId module);

 private:
  std::map<ModuleId, int> runs_;  // so far
};

}  // namespace floe
