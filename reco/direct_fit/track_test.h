// Is it a cascade at all? A plain test for the light of a muon track.
#pragma once

#include <string>

#include "reco/direct_fit/seed.h"
#include "reco/event_data.h"

namespace floe {

// Line fit through the first hits (arXiv:astro-ph/0407044): r = r0 + v t, each module once.
struct TrackTest {
  double speed = 0;           // |v| of the line fit [m/ns]
  double length = 0;          // spread (rms) of the lit modules along v [m]
  double elongation = 1;      // length over the spread across v, per axis
  double track_spread = 0;    // rms of t - (r - r0).v/|v|^2 [ns]
  double cascade_spread = 0;  // rms of t - t0 - flight time from the best point [ns]
  // speed in 0.4 c to 1.3 c, length > 80 m, elongation > 1.5, track_spread < cascade_spread.
  bool track_like = false;
  std::string words() const;
};
TrackTest test_for_track(const EventData& data, const PointSeed& point);

}  // namespace floe
