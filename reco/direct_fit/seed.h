// Where a fit begins, from the data alone.
#pragma once

#include <functional>
#include <vector>

#include "reco/direct_fit/expectation_model.h"
#include "reco/direct_fit/point_light.h"
#include "reco/event_data.h"

namespace floe {

// Place and time of a point that shines into all directions.
struct PointSeed {
  Vec3 position = Vec3::Zero();  // [m]
  double time = 0;               // [ns]
};

// Place: from the charges of all modules, those without hits included, by the point light in ice of the
// mean lengths between point and module, begun at the centre of the brightest modules. Time: an early
// quantile of the first hits' times less the time of flight of direct light.
PointSeed find_point(const EventData& data, const MeanIce& ice);

// How far ahead of a cascade at height z [m] the light that is scattered seems to come from [m].
double light_ahead(const MeanIce& ice, double z);
// A cascade that went the opposite way horizontally, where light that is scattered so far `ahead` [m] seems
// to come from the same place.
LightCentre turned_round(const LightCentre& light, double ahead);

// A direction tried from the point, and how well it did with time and brightness at their best.
struct SeedCandidate {
  LightCentre light;
  double neg_llh = 0;
};

struct ScanOptions {
  CascadeKind kind = CascadeKind::electron;
  int directions = 24;
  double photons = 2e5;  // for each direction
  double oversize = 15;
  double model_error = 0.4;  // large: the place is not yet right
  std::uint64_t first_stream = 0;
};

// Simulates a cascade in every direction, with its light's centre where its point-like fit would have
// come out at `point` (light streams ahead before it is scattered), and sorts them, best first.
std::vector<SeedCandidate> scan_directions(ExpectationModel& light, const EventData& data, const MeanIce& ice,
                                           const PointSeed& point, const ScanOptions& options,
                                           const std::function<void(double)>& progress);

}  // namespace floe
