// Rows of a study whose fits are as good as their errors say.
#pragma once

#include <random>
#include <vector>

#include "reco/study/study.h"

namespace floe {

// Fits with Gaussian errors of the size that they say, at the bound.
inline std::vector<StudyRow> gaussian_rows(int count) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  Vector7 error;
  error << 2, 3, 1, 4, 0.02, 0.03, 100;
  std::vector<StudyRow> rows;
  for (int i = 0; i < count; ++i) {
    StudyRow row;
    row.energy = 1e4;
    row.index = i;
    row.truth = {{10, 20, -300}, 500, 1.2, 2, 1e4};
    Vector7 found = to_vector(row.truth);
    for (int k = 0; k < 7; ++k) found(k) += error(k) * normal(engine);
    row.fit.status = FitStatus::ok;
    row.fit.cascade = {found.head<3>(), found(3), found(4), found(5), found(6)};
    row.fit.covariance = error.cwiseAbs2().asDiagonal();
    row.bound = row.fit.covariance;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace floe
