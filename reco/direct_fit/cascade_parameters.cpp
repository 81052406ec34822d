#include "reco/direct_fit/cascade_parameters.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "data/base/constants.h"

namespace floe {
namespace {

// Length from the vertex to the mean of the longitudinal profile [m].
double light_distance(CascadeKind kind, double energy) {
  const LongitudinalProfile profile = longitudinal_profile(kind, energy);
  return profile.shape * profile.scale;
}

// Energy whose mean light is exp(log_light): bisection in the logarithm, light rises with energy.
double energy_of(double log_light, CascadeKind kind) {
  double low = std::log(0.1), high = std::log(1e9);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (std::log(light_yield(kind, std::exp(middle)).mean) < log_light ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace

Vector7 to_vector(const CascadeParameters& c) {
  Vector7 v;
  v << c.position, c.time, c.zenith, c.azimuth, c.energy;
  return v;
}

Cascade to_cascade(const CascadeParameters& c, CascadeKind kind) {
  return {c.position, c.time, c.zenith, c.azimuth, c.energy, kind};
}

double distance_between(const CascadeParameters& a, const CascadeParameters& b) {
  return (a.position - b.position).norm();
}

double angle_between(const CascadeParameters& a, const CascadeParameters& b) {
  const Vec3 u = travel_direction(a.zenith, a.azimuth), v = travel_direction(b.zenith, b.azimuth);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

Vector7 displacement(const CascadeParameters& from, const CascadeParameters& to) {
  const Vec3 here = unit_vector(from.zenith, from.azimuth), there = unit_vector(to.zenith, to.azimuth);
  const Vec3 by_azimuth(-std::sin(from.azimuth), std::cos(from.azimuth), 0);
  const Vec3 by_zenith = by_azimuth.cross(here);
  const double across = here.cross(there).norm();
  const double stretch = across > 0 ? angle_between(from, to) / across : 1;
  const double sine = std::max(std::sin(from.zenith), 1e-9);
  Vector7 way;
  way << to.position - from.position, to.time - from.time, stretch * there.dot(by_zenith),
      stretch * there.dot(by_azimuth) / sine, to.energy - from.energy;
  return way;
}

LightCentre light_centre(const CascadeParameters& c, CascadeKind kind) {
  LightCentre light;
  const double length = light_distance(kind, c.energy);
  light.direction = travel_direction(c.zenith, c.azimuth);
  light.position = c.position + length * light.direction;
  light.time = c.time + length / speed_of_light;
  light.log_light = std::log(light_yield(kind, c.energy).mean);
  return light;
}

CascadeParameters cascade_of(const LightCentre& light, CascadeKind kind) {
  CascadeParameters c;
  c.energy = energy_of(light.log_light, kind);
  const double length = light_distance(kind, c.energy);
  c.position = light.position - length * light.direction;
  c.time = light.time - length / speed_of_light;
  const Origin origin = origin_of(light.direction);
  c.zenith = origin.zenith;
  c.azimuth = origin.azimuth;
  return c;
}

}  // namespace floe
