// Light from a point, on the command line: --point, --standard-candle and what goes with them; and the curves
// that a laboratory measured of a flasher.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "apps/planned_output.h"
#include "propagation/sources/laser.h"

namespace floe {

// Light of one wavelength from a place in the ice.
struct PointRequest {
  std::string id;  // of its event
  LaserSettings light;
  std::optional<double> emitted;  // photons that leave the source, in place of those that count as N
};
Json to_json(const PointRequest& request);
// The curve's points, in degrees where it is a beam.
Json to_json(const MeasuredCurve& curve, double unit = 1);

// What was typed.
struct PointOptions {
  std::string point, candle;  // "X,Y,Z"; at most one of them
  std::optional<double> photons, emitted, wavelength, time, opening_deg, elevation_deg, azimuth_deg;
  std::optional<MeasuredCurve> beam, pulse;
  bool given() const { return !point.empty() || !candle.empty(); }
};

// --point, --standard-candle, --emitted, --opening, --beam, --pulse. --photons, --wavelength and others that
// flashers have, too, are added by who has flashers.
void add_point_options(CLI::App& app, PointOptions& options);

// Throws UsageError: brightness missing or given twice, a direction without a cone.
PointRequest point_request(const PointOptions& options);

}  // namespace floe
