#include "reco/direct_fit/design.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

#include "data/base/vec3.h"
#include "propagation/engine/random.h"

namespace floe {
namespace {

using Rotation = Eigen::Matrix<double, regression_coordinates, regression_coordinates>;

double gaussian(RandomStream& random) {
  const double radius = std::sqrt(2 * random.exponential());
  return radius * std::cos(2 * pi * random.uniform());
}

// Uniform over orthogonal matrices: the orthogonal factor of a Gaussian matrix.
Rotation draw_rotation(std::uint64_t seed, std::uint64_t draw) {
  RandomStream random(seed, 0x64657369676e, draw);
  Rotation gauss;
  for (int i = 0; i < gauss.size(); ++i) gauss(i) = gaussian(random);
  return Rotation(Eigen::HouseholderQR<Rotation>(gauss).householderQ());
}

}  // namespace

std::vector<Coordinates> simplex_design(std::uint64_t seed, std::uint64_t draw) {
  constexpr int n = regression_coordinates;
  constexpr double radius = 1.8;  // every coordinate then has a spread of about 0.8
  // Unit vectors with mutual products -1/n, built up coordinate by coordinate.
  Eigen::Matrix<double, n, n + 1> corners = Eigen::Matrix<double, n, n + 1>::Zero();
  for (int i = 0; i < n; ++i) {
    corners(i, i) = std::sqrt(1 - corners.col(i).head(i).squaredNorm());
    for (int j = i + 1; j <= n; ++j)
      corners(i, j) = (-1.0 / n - corners.col(i).head(i).dot(corners.col(j).head(i))) / corners(i, i);
  }
  const Rotation rotation = draw_rotation(seed, draw);
  std::vector<Coordinates> design{Coordinates::Zero()};
  for (int j = 0; j <= n; ++j) {
    const Coordinates corner = radius * rotation * corners.col(j);
    design.push_back(corner);
    design.push_back(-corner);
  }
  return design;
}

std::vector<LightRequest> design_requests(const LocalFrame& frame, const Stage& stage, CascadeKind kind,
                                          std::uint64_t seed, std::uint64_t draw,
                                          std::uint64_t first_stream) {
  std::vector<LightRequest> requests;
  const auto design = simplex_design(seed, draw);
  for (const Coordinates& point : design) {
    Vector7 local = Vector7::Zero();
    local.head<3>() = stage.position_step * point.head<3>();
    local.segment<2>(3) = stage.direction_step * point.tail<2>();
    requests.push_back({cascade_of(frame.at(local), kind), stage.photons / double(design.size()),
                        stage.oversize, first_stream++});
  }
  return requests;
}

double useful_photons(ExpectationModel& light, const CascadeParameters& cascade, const EventData& data,
                      double oversize, double effort, const PhotonNeed& need) {
  const double dimmest = data.charge() < worthwhile_charge ? 1 : 4;
  const double one = light.photons_per_cascade(cascade, oversize) * data.repeats();
  const double hits_of_one = std::max(1.0, data.charge());
  const double dim = std::clamp(need.hits / (need.events * hits_of_one), 1.0, dimmest);
  return effort * std::clamp(dim * need.events * one, need.least, dim * need.most);
}

double training_oversize(double oversize) {
  return std::max(oversize, std::clamp(5 * oversize, 12.0, 60.0));
}

std::vector<Vec3> even_directions(int count) {
  std::vector<Vec3> result;
  const double golden = pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count;
    result.push_back(unit_vector(std::acos(z), golden * i));
  }
  return result;
}

}  // namespace floe
