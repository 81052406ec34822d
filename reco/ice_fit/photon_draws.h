// Counts that data and simulation might have had, had the simulation's model been true: whole photons are
// drawn from the simulation, again and again (a bootstrap), so that photons that are seen twice count twice.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "reco/ice_fit/run_bins.h"
#include "reco/ice_fit/run_light.h"

namespace floe {

// Of one run in its bins: data of all flashes, simulated hits of even and of odd photons.
struct FoldedCounts {
  Eigen::VectorXd data;
  std::array<Eigen::VectorXd, 2> simulated;
};

class PhotonDraws {
 public:
  PhotonDraws() = default;
  // `scale`: expected counts of the data for one simulated hit; `whole_photons`: the data are hits of photons
  // of as wide modules as the simulated ones; otherwise counts of the data are independent of each other.
  // `charge_dispersion`: by how much their variance is larger, at least 1, since charges differ.
  // `model_error`: the data differ from the simulation by so much in each bin, relative (the deviation of a
  // log-normal factor of mean 1), where likelihoods allow for that.
  PhotonDraws(const SimulatedRun& simulated, const RunBins& bins, double scale, bool whole_photons,
              double charge_dispersion = 1, double model_error = 0);

  // Either half is drawn from all photons: what the two happen to differ by in the simulation is no truth
  // that data could be drawn from.
  FoldedCounts draw(std::mt19937_64& random) const;

 private:
  void add_model_error(Eigen::VectorXd& counts, std::mt19937_64& random) const;

  struct SeenPhoton {
    std::uint32_t first, end;  // of bins_
  };
  int size_ = 0;
  double scale_ = 1;
  bool whole_photons_ = false;
  double charge_dispersion_ = 1, model_error_ = 0;
  std::vector<int> bins_;
  std::vector<SeenPhoton> photons_;
};

}  // namespace floe
