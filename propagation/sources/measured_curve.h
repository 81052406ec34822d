// What a laboratory measured of a light source: how bright it is against an angle, or against time.
#pragma once

#include <filesystem>
#include <vector>

#include "propagation/sources/quantile_table.h"

namespace floe {

// Relative intensity against an angle [rad] or a time [ns]: linear between its points, 0 outside; its
// normalisation does not matter.
class MeasuredCurve {
 public:
  struct Point {
    double at, intensity;
    bool operator==(const Point&) const = default;
  };
  // Throws InputError unless there are at least two points, rising strictly in `at`, finite and with
  // intensities not below 0, of which one is above.
  explicit MeasuredCurve(std::vector<Point> points);

  double operator()(double at) const;
  double low() const { return points_.front().at; }
  double high() const { return points_.back().at; }
  const std::vector<Point>& points() const { return points_; }
  MeasuredCurve stretched(double factor) const;  // every `at` times `factor`, above 0

  bool operator==(const MeasuredCurve&) const = default;

 private:
  std::vector<Point> points_;
};

// Two numbers a line, '#' begins a comment, rising in the first:
// of a beam, angle to its axis [deg], 0 to 180, and intensity per solid angle;
// of a pulse, time [ns], -1e6 to 1e6, and intensity. Throw InputError, with the line.
MeasuredCurve read_beam_profile(const std::filesystem::path& file);
MeasuredCurve read_pulse_shape(const std::filesystem::path& file);

// Angles to the beam's axis [rad] and times [ns] of photons, against uniform numbers. Of the beam's solid
// angle what lies beyond 180 degrees is left out.
QuantileTable beam_angles(const MeasuredCurve& beam);
QuantileTable pulse_times(const MeasuredCurve& pulse);

// The Gaussian beam [rad] with the same mean 1 - cos of the angle to its axis, at most 90 degrees; the pulse
// of even brightness [ns] with the same variance in time. They stand in tables that hold no curves.
double equivalent_beam_width(const MeasuredCurve& beam);
double equivalent_pulse_width(const MeasuredCurve& pulse);

}  // namespace floe
