// Every number of the modules' electronics in one place, as one file can set them.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "response/dark_noise.h"
#include "response/digitisers.h"
#include "response/discriminator.h"
#include "response/launches.h"
#include "response/photoelectron_charge.h"
#include "response/pulse_extraction.h"
#include "response/transit_time.h"
#include "response/tube_saturation.h"

namespace floe {

struct ReadoutSettings {
  double before = 4000, after = 6000;  // the middle of the event's light: what is recorded [ns]
};

struct ResponseSettings {
  PhotoelectronChargeSettings charge;
  TransitTimeSettings time;
  ExpectedAfterpulses afterpulses{0.059, 300, 11000};
  DarkNoiseSettings noise;
  TubeSettings tube;
  DiscriminatorSettings discriminator;
  LaunchSettings launches;
  DigitiserSettings digitisers;
  ExtractionSettings pulses;
  ReadoutSettings readout;
};

// One number of the settings, or one word.
struct ResponseSetting {
  const char* section;
  const char* key;
  std::variant<double*, int*, CoincidenceMode*> value;
  double low, high;     // allowed, both included; of numbers
  const char* meaning;  // with unit
  const char* source;
};

// All settings, in the order in which files have them; each points into `settings`.
std::vector<ResponseSetting> list_of(ResponseSettings& settings);

std::string_view name_of(CoincidenceMode mode);  // "soft", "hard" or "none"

// Throws UsageError where numbers that are each in range do not fit together (shares above 1, ends before
// beginnings).
void check(const ResponseSettings& settings);

}  // namespace floe
