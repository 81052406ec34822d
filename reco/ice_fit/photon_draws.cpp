#include "reco/ice_fit/photon_draws.h"

#include <algorithm>
#include <cmath>

namespace floe {

namespace {

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

// Poisson numbers of one small mean, by the inverse of their distribution.
class SmallPoisson {
 public:
  explicit SmallPoisson(double mean) {
    double term = std::exp(-mean), sum = term;
    for (int k = 1; sum < 1 - 1e-15 && k < 1000; ++k) {
      cumulative_.push_back(sum);
      term *= mean / k;
      sum += term;
    }
  }
  int operator()(std::mt19937_64& random) const {
    const double u = uniform(random);
    int k = 0;
    while (static_cast<std::size_t>(k) < cumulative_.size() && u > cumulative_[static_cast<std::size_t>(k)])
      ++k;
    return k;
  }

 private:
  std::vector<double> cumulative_;
};

}  // namespace

PhotonDraws::PhotonDraws(const SimulatedRun& simulated, const RunBins& bins, double scale, bool whole_photons,
                         double charge_dispersion, double model_error)
    : size_(bins.size()),
      scale_(scale),
      whole_photons_(whole_photons),
      charge_dispersion_(charge_dispersion),
      model_error_(model_error) {
  const auto& hits = simulated.hits;
  for (std::size_t i = 0; i < hits.size();) {
    const std::uint64_t photon = hits[i].photon;
    const auto first = static_cast<std::uint32_t>(bins_.size());
    for (; i < hits.size() && hits[i].photon == photon; ++i)
      if (const int bin = bins.bin(hits[i].module, hits[i].time); bin >= 0) bins_.push_back(bin);
    const auto end = static_cast<std::uint32_t>(bins_.size());
    if (end > first) photons_.push_back({first, end});
  }
}

FoldedCounts PhotonDraws::draw(std::mt19937_64& random) const {
  FoldedCounts counts;
  counts.data = Eigen::VectorXd::Zero(size_);
  Eigen::VectorXd expected = counts.data;
  counts.simulated = {counts.data, counts.data};
  const SmallPoisson of_data(scale_), of_simulation(1);
  for (const SeenPhoton& photon : photons_) {
    const int seen = whole_photons_ ? of_data(random) : 0, simulated = of_simulation(random);
    int even = 0;
    for (int copy = 0; copy < simulated; ++copy) even += static_cast<int>(random() >> 63);
    for (std::uint32_t i = photon.first; i < photon.end; ++i) {
      counts.data(bins_[i]) += seen;
      counts.simulated[0](bins_[i]) += even;
      counts.simulated[1](bins_[i]) += simulated - even;
      expected(bins_[i]) += scale_;
    }
  }
  if (!whole_photons_)
    for (Eigen::Index b = 0; b < size_; ++b)
      if (expected(b) > 0) counts.data(b) = std::poisson_distribution<int>(expected(b))(random);
  if (model_error_ > 0) add_model_error(counts.data, random);
  if (charge_dispersion_ > 1)
    for (Eigen::Index b = 0; b < size_; ++b) {
      const double width = std::sqrt((charge_dispersion_ - 1) * counts.data(b));
      counts.data(b) = std::max(0.0, counts.data(b) + std::normal_distribution<double>(0, 1)(random) * width);
    }
  return counts;
}

void PhotonDraws::add_model_error(Eigen::VectorXd& counts, std::mt19937_64& random) const {
  const double width = std::sqrt(std::log1p(model_error_ * model_error_));
  std::lognormal_distribution<double> factor(-0.5 * width * width, width);
  for (Eigen::Index b = 0; b < size_; ++b) counts(b) *= factor(random);
}

}  // namespace floe
