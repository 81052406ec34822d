#include "reco/direct_fit/average_place.h"

#include "reco/direct_fit/local_frame.h"

namespace floe {

AveragePlace average_of(std::span<const LightCentre> places) {
  const auto count = static_cast<double>(places.size());
  const LocalFrame first(places.front());
  Vector7 mean = Vector7::Zero();
  for (const LightCentre& place : places) mean += first.of(place) / count;
  AveragePlace average{first.at(mean), Matrix7::Zero()};
  const LocalFrame frame(average.light);
  for (const LightCentre& place : places)
    average.scatter += frame.of(place) * frame.of(place).transpose() / (count - 1);
  return average;
}

}  // namespace floe
