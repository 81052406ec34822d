// From what a path says about the ice's layers to derivatives in a fit's parameters: the chain rule.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "propagation/engine/path_scores.h"
#include "propagation/model.h"

namespace floe {

class ScoreMap {
 public:
  // `model`: whose paths are scored. Coefficients of absorption and scattering are compared at `wavelength`
  // [nm].
  ScoreMap(const Model& model, double wavelength, int parameters);

  // `changed` is the model with parameter number `parameter` larger by `step`. False when weights cannot
  // express the difference, because something else than layers' absorption, scattering, birefringence
  // strength and the absorption's anisotropy changes: that needs a pair of simulations.
  bool add(int parameter, const Model& changed, double step);

  int parameters() const { return parameters_; }
  // d ln(density) / d parameters of a path, and its length [m] in the layers that each parameter changes.
  void scores(const PathScores& path, Eigen::VectorXd& scores, Eigen::VectorXd& dwell) const;

 private:
  struct Entry {
    int parameter;
    double absorption, scattering, diffusion, deflection;
  };
  struct AnisotropyEntry {
    int parameter;
    std::array<double, 3> slope;
  };
  Model model_;
  double wavelength_;
  int parameters_;
  std::vector<std::vector<Entry>> entries_;  // by layer
  std::vector<AnisotropyEntry> anisotropy_;
};

}  // namespace floe
