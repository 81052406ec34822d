// Flasher light whose counts and slopes are known in closed form, for tests of what is made of them.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <ostream>
#include <random>
#include <vector>

#include "reco/ice_fit/ice_parameter.h"
#include "reco/ice_fit/run_light.h"

namespace floe {

// Light in closed form: counts of the data in bin b are expected to be base(b) (1 + sum_p theta_p slope(b,
// p)), brightness and time zero apart.
struct ClosedLight {
  Eigen::VectorXd base;    // counts of the data at theta = 0
  Eigen::MatrixXd slopes;  // of ln mu at theta = 0, the ice's columns only
  Eigen::VectorXd delay;   // of ln mu [1/ns]
  double scale;            // counts of the data for one simulated hit of a fold
};

inline ClosedLight some_light(int bins, double counts, double scale) {
  ClosedLight light{Eigen::VectorXd(bins), Eigen::MatrixXd(bins, 3), Eigen::VectorXd(bins), scale};
  for (int b = 0; b < bins; ++b) {
    const double x = static_cast<double>(b) / (bins - 1);
    light.base(b) = counts * (0.5 + std::exp(-3 * x) + 0.3 * (b % 3));
    light.slopes.row(b) << -0.5 - x, std::sin(5 * x), b % 4 == 1 ? 1.0 : 0.1;
    light.delay(b) = 0.02 * std::cos(9 * x + b % 3);
  }
  return light;
}

// Places that say nothing but where a bin is among the others.
inline Eigen::MatrixXd places_of(const ClosedLight& light) {
  const Eigen::Index bins = light.base.size();
  Eigen::MatrixXd places(bins, 4);
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(bins, -1, 1);
  places << Eigen::VectorXd::Ones(bins), x, x.square(), x.cube();
  return places;
}

// What a simulation of so much light that nothing is left of chance gives.
inline RunLight certain(const ClosedLight& light) {
  RunLight run;
  run.places = places_of(light);
  run.symmetric.assign(3, 1);
  for (LightFold& fold : run.folds) {
    fold.counts = light.base / light.scale;
    fold.slopes = fold.counts.asDiagonal() * light.slopes;
    fold.slope_squares = fold.counts.asDiagonal() * light.slopes.cwiseAbs2();
    fold.dwell = fold.counts.replicate(1, 3);
    fold.delay = fold.counts.cwiseProduct(light.delay);
  }
  return run;
}

struct Noise {
  double slopes;  // scatter of the score from hit to hit
  int seen;       // how often each photon is seen
  double away;    // 1: the step to the truth is some errors long; 0: it is the last one
};
inline void PrintTo(const Noise& noise, std::ostream* out) {
  *out << "scatter " << noise.slopes << ", seen " << noise.seen << ", away " << noise.away;
}

// Draws of `count` hits from photons that are seen several times each.
inline Eigen::VectorXd draw(const Eigen::VectorXd& mean, int seen, std::mt19937_64& random) {
  Eigen::VectorXd counts(mean.size());
  for (Eigen::Index b = 0; b < mean.size(); ++b)
    counts(b) = seen * static_cast<double>(std::poisson_distribution<long>(mean(b) / seen)(random));
  return counts;
}

inline RunLight simulated(const ClosedLight& light, const Noise& noise, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  RunLight run;
  run.places = places_of(light);
  run.symmetric.assign(3, 1);
  for (LightFold& fold : run.folds) {
    fold.counts = draw(light.base / light.scale, noise.seen, random);
    fold.slopes = fold.counts.asDiagonal() * light.slopes;
    for (Eigen::Index b = 0; b < fold.counts.size(); ++b)
      for (Eigen::Index p = 0; p < 3; ++p)
        fold.slopes(b, p) += noise.slopes * std::sqrt(fold.counts(b)) * normal(random);
    fold.slope_squares =
        fold.counts.asDiagonal() * (light.slopes.cwiseAbs2().array() + noise.slopes * noise.slopes).matrix();
    fold.dwell = fold.counts.replicate(1, 3);
    fold.delay = fold.counts.cwiseProduct(light.delay);
  }
  return run;
}

inline std::vector<IceParameter> free_parameters() {
  std::vector<IceParameter> parameters(3);
  for (IceParameter& parameter : parameters) parameter.low = -50, parameter.high = 50, parameter.scale = 1;
  return parameters;
}

}  // namespace floe
