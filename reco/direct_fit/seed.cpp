#include "reco/direct_fit/seed.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/base/constants.h"
#include "reco/direct_fit/design.h"
#include "reco/direct_fit/goodness_of_fit.h"
#include "reco/likelihood/limited_simulation.h"

namespace floe {
namespace {

constexpr std::size_t core_modules = 12;            // whose centre begins the search
constexpr double point_error = 0.7;                 // sigma of the point light's logarithm
constexpr double scan_step = 15;                    // of the times tried [ns]
constexpr double scan_back = 150, scan_ahead = 75;  // range of times around the point's [ns]
constexpr double first_energy = 1e4;                // of the pilot [GeV]

Vec3 core_of(const EventData& data) {
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  for (const std::size_t i : data.brightest(core_modules)) {
    const ModuleData& lit = data.lit()[i];
    sum += lit.charge * data.detector().modules()[lit.module].position;
    weight += lit.charge;
  }
  return sum / weight;
}

// Residuals of the point-light fit; parameters: x, y, z [m], ln(brightness).
class PointCost {
 public:
  PointCost(const EventData& data, const MeanIce& ice) : data_(data), ice_(ice) {}

  bool operator()(double const* const* parameters, double* residuals) const {
    const Vec3 place(parameters[0][0], parameters[0][1], parameters[0][2]);
    for (const ModuleData& lit : data_.lit())
      *residuals++ = residual(lit.charge, lit.module, place, parameters[0][3]);
    for (const std::uint32_t dark : data_.dark()) *residuals++ = residual(0, dark, place, parameters[0][3]);
    return true;
  }

 private:
  double residual(double charge, std::uint32_t index, const Vec3& place, double log_brightness) const {
    const Vec3& module = data_.detector().modules()[index].position;
    const double log_mean =
        log_brightness +
        point_light(soft_distance(place - module), ice_.between(place.z(), module.z())).log_light;
    constexpr double exact = 1e9;  // a formula has no simulation noise
    const BinLikelihood bin = limited_simulation({charge, 1, exact, exact / std::exp(log_mean)}, point_error);
    return std::copysign(std::sqrt(2 * bin.value), bin.slope);
  }

  const EventData& data_;
  const MeanIce& ice_;
};

double log_brightness(const EventData& data, const MeanIce& ice, const Vec3& place) {
  double expected = 0;
  for (const ModuleData& lit : data.lit()) {
    const Vec3& module = data.detector().modules()[lit.module].position;
    expected +=
        std::exp(point_light(soft_distance(place - module), ice.between(place.z(), module.z())).log_light);
  }
  return std::log(data.charge() / expected);
}

// Scattering only delays light, so the point's time is early among (first hit - time of flight); not
// the earliest, which noise and the cascade's length make too early. Near and bright modules are the
// least delayed.
double time_at(const EventData& data, const Vec3& place) {
  std::vector<double> times;
  for (const std::size_t i : data.brightest(40)) {
    const ModuleData& lit = data.lit()[i];
    const double distance = soft_distance(place - data.detector().modules()[lit.module].position);
    times.push_back(lit.times.front() - light_slowness() * distance);
  }
  const auto quantile = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 4);
  std::nth_element(times.begin(), quantile, times.end());
  return *quantile;
}

// One simulation against the data, with time and brightness free.
class CoarseComparison {
 public:
  CoarseComparison(const EventData& data, const LightSample& sample, double model_error)
      : data_(data), sample_(sample), model_error_(model_error) {}

  struct Best {
    double neg_llh, log_light;
  };
  // `time`: of the vertex. `log_light`: where the search for the brightness begins, relative to the sample.
  Best at(double time, double log_light) const {
    const std::vector<BinOfData> bins = count_bins(data_, sample_, time);
    Best best{0, log_light};
    for (int iteration = 0; iteration < 20; ++iteration) {
      double slope = 0, curvature = 0;
      best.neg_llh = 0;
      for (BinOfData bin : bins) {
        bin.simulation_events *= std::exp(-best.log_light);
        const BinLikelihood value = bin.likelihood(model_error_);
        best.neg_llh += value.value;
        slope += value.slope;
        curvature += value.curvature;
      }
      const double step = std::clamp(-slope / std::max(curvature, 1e-9), -1.0, 1.0);
      if (std::abs(step) < 1e-3) break;
      best.log_light += step;
    }
    return best;
  }

 private:
  const EventData& data_;
  const LightSample& sample_;
  double model_error_;
};

SeedCandidate best_time(const EventData& data, const LightSample& sample, const PointSeed& point,
                        const ScanOptions& options) {
  const CoarseComparison comparison(data, sample, options.model_error);
  const LightCentre tried = light_centre(sample.cascade, options.kind);
  const double delay = tried.time - sample.cascade.time;
  SeedCandidate best{tried, std::numeric_limits<double>::infinity()};
  double log_light = 0;
  for (double shift = -scan_back; shift <= scan_ahead; shift += scan_step) {
    const auto value = comparison.at(point.time + shift - delay, log_light);
    log_light = value.log_light;
    if (value.neg_llh >= best.neg_llh) continue;
    best.neg_llh = value.neg_llh;
    best.light.time = point.time + shift;
    best.light.log_light = tried.log_light + value.log_light;
  }
  return best;
}

}  // namespace

double light_ahead(const MeanIce& ice, double z) {
  constexpr double near = 20, share = 0.35;  // [m], of the scattering length
  return share * ice.between(z - near, z + near).scattering;
}

LightCentre turned_round(const LightCentre& light, double ahead) {
  LightCentre other = light;
  other.direction.head<2>() *= -1;
  other.position += ahead * (light.direction - other.direction);
  return other;
}

PointSeed find_point(const EventData& data, const MeanIce& ice) {
  const Vec3 core = core_of(data);
  double parameters[4] = {core.x(), core.y(), core.z(), log_brightness(data, ice, core)};
  auto* cost = new ceres::DynamicNumericDiffCostFunction<PointCost, ceres::CENTRAL>(new PointCost(data, ice));
  cost->AddParameterBlock(4);
  cost->SetNumResiduals(static_cast<int>(data.lit().size() + data.dark().size()));
  ceres::Problem problem;
  problem.AddResidualBlock(cost, nullptr, parameters);
  // The brightest modules surround the cascade or lie beside it: it is not far from them.
  for (int i = 0; i < 3; ++i) {
    problem.SetParameterLowerBound(parameters, i, core(i) - 150);
    problem.SetParameterUpperBound(parameters, i, core(i) + 150);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 30;
  options.function_tolerance = 1e-4;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  PointSeed seed;
  seed.position = summary.IsSolutionUsable() ? Vec3(parameters[0], parameters[1], parameters[2]) : core;
  seed.time = time_at(data, seed.position);
  return seed;
}

std::vector<SeedCandidate> scan_directions(ExpectationModel& light, const EventData& data, const MeanIce& ice,
                                           const PointSeed& point, const ScanOptions& options,
                                           const std::function<void(double)>& progress) {
  const auto directions = even_directions(options.directions);
  const double ahead = light_ahead(ice, point.position.z());
  CascadeParameters pilot;
  pilot.energy = first_energy;
  double log_light = light_centre(pilot, options.kind).log_light;

  std::vector<SeedCandidate> candidates;
  std::uint64_t stream = options.first_stream;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const LightCentre centre{point.position - ahead * directions[i], point.time, directions[i], log_light};
    const LightSample sample =
        light.sample({cascade_of(centre, options.kind), options.photons, options.oversize, stream++});
    candidates.push_back(best_time(data, sample, point, options));
    // The first one tells how bright the event is; the shape of its light hardly depends on that.
    if (i == 0) log_light = candidates.front().light.log_light;
    if (progress) progress(double(i + 1) / double(directions.size()));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const SeedCandidate& a, const SeedCandidate& b) { return a.neg_llh < b.neg_llh; });
  return candidates;
}

}  // namespace floe
