// Light in closed form, drawn at random: fits can be tested on it in seconds and against a truth that
// knows no propagation.
#pragma once

#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "geometry/detector.h"
#include "propagation/ice/ice_tables.h"
#include "reco/direct_fit/expectation_model.h"
#include "reco/direct_fit/point_light.h"

namespace floe {

// A point light in even ice that is brighter ahead; arrival times of a gamma distribution whose mean delay
// grows with distance and backwards. Needs no photons; `photons` only set the number of repetitions.
class ToyLight : public ExpectationModel {
 public:
  explicit ToyLight(std::uint64_t seed, double brightness = 1) : seed_(seed), brightness_(brightness) {
    auto detector = std::make_shared<const Detector>(ic86_detector());
    auto ice = std::make_shared<const IceModel>(south_pole_ice(), *detector);
    model_ = {detector, ice, builtin_acceptance()};
  }

  const Model& model() const override { return model_; }
  double photons_per_cascade(const CascadeParameters& cascade, double oversize) override {
    return 300 * cascade.energy * 25 / (oversize * oversize);
  }

  double mean_charge(const LightCentre& light, const Vec3& module) const {
    const Vec3 way = module - light.position;
    const double distance = soft_distance(way), ahead = light.direction.dot(way) / distance;
    const double beam = std::exp(1.2 * (ahead - 1) * std::exp(-distance / 150));
    return brightness_ * 400 * beam * std::exp(light.log_light + point_light(distance, {30, 100}).log_light);
  }

  // Light arrives after its time of flight [ns], and then after a gamma distribution of this shape and scale
  // [ns].
  struct Delay {
    double flight, shape, scale;
  };
  static Delay delay(const LightCentre& light, const Vec3& module) {
    const Vec3 way = module - light.position;
    const double distance = soft_distance(way), ahead = light.direction.dot(way) / distance;
    return {light_slowness() * distance, 0.7 + distance / 60, 30 + 15 * (1 - ahead)};
  }

  LightSample sample(const LightRequest& request) override {
    std::mt19937_64 random(seed_ * 1000003 + request.stream);
    const LightCentre light = light_centre(request.cascade, CascadeKind::electron);
    LightSample result;
    result.cascade = request.cascade;
    result.oversize = request.oversize;
    result.repeats = request.photons / photons_per_cascade(request.cascade, request.oversize);
    result.propagated = static_cast<std::uint64_t>(request.photons);
    const auto& modules = model_.detector->modules();
    std::vector<std::pair<std::uint32_t, float>> hits;
    for (std::uint32_t m = 0; m < modules.size(); ++m) {
      const double mean = result.repeats * mean_charge(light, modules[m].position);
      if (mean < 1e-6) continue;
      const Delay law = delay(light, modules[m].position);
      std::gamma_distribution<double> later(law.shape, law.scale);
      const long n = std::poisson_distribution<long>(mean)(random);
      for (long i = 0; i < n; ++i)
        hits.emplace_back(m,
                          static_cast<float>(light.time - request.cascade.time + law.flight + later(random)));
    }
    fill(result, modules.size(), std::move(hits));
    return result;
  }

  // One event with this truth.
  Event draw(const CascadeParameters& truth, std::uint64_t stream) {
    const double photons = photons_per_cascade(truth, 5);
    const LightSample light = sample({truth, photons, 5, stream});
    Event event;
    event.id = "toy";
    for (std::uint32_t m = 0; m < model_.detector->size(); ++m)
      for (const float* time = light.begin(m); time != light.end(m); ++time) {
        Hit hit;
        hit.module = model_.detector->modules()[m].id;
        hit.time = truth.time + *time;
        event.hits.push_back(hit);
      }
    return event;
  }

 private:
  std::uint64_t seed_;
  double brightness_;
  Model model_;
};

}  // namespace floe
