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
  // strength, their rise along 225 deg and the absorption's anisotropy changes: that needs a pair of
  // simulations. Of layers that rise, the path meets more or less absorption and scattering; how
  // birefringence differs between neighbouring layers is neglected.
  bool add(int parameter, const Model& changed, double step);

  int parameters() const { return parameters_; }
  // Whether what a parameter changes has the symmetry of the ice about a flasher: all but a rise of layers.
  bool is_symmetric(int parameter) const;
  // d ln(density) / d parameters of a path, and its length [m] in the layers that each parameter changes.
  void scores(const PathScores& path, Eigen::VectorXd& scores, Eigen::VectorXd& dwell) const;

 private:
  struct Entry {
    int parameter;
    double absorption = 0, scattering = 0, diffusion = 0, deflection = 0;
    double tilted_absorption = 0, tilted_scattering = 0;
  };
  struct AnisotropyEntry {
    int parameter;
    std::array<double, 3> slope;
  };
  bool add_rise(int parameter, const Model& changed, double step);
  void add_entry(std::size_t layer, const Entry& entry);

  Model model_;
  double wavelength_;
  int parameters_;
  std::vector<std::vector<Entry>> entries_;  // by layer
  std::vector<AnisotropyEntry> anisotropy_;
  std::vector<char> rises_;  // by parameter
};

}  // namespace floe
