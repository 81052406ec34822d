// In which bins of module and time a flasher run's light is compared.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "propagation/engine/simulator.h"

namespace floe {

class RunBins {
 public:
  struct Receiver {
    std::uint32_t module;             // index into Detector::modules()
    int first;                        // number of its first bin
    std::vector<double> inner_edges;  // rising [ns]; the first and the last bin are open
    int bins() const { return static_cast<int>(inner_edges.size()) + 1; }
  };
  struct Rules {
    double least_counts = 5;   // expected of a receiver in the data
    double counts_a_bin = 30;  // expected of a bin in the data
    double hits_a_bin = 6;     // simulated; fits have ten times the light that bins are made from
    int most_bins = 8;         // of a receiver
  };
  RunBins() = default;
  // Bins that follow the light: quantiles of simulated times. `scale`: expected counts of the data for one
  // simulated hit. Modules with `used[module]` false are left out; the choice looks at the simulation alone,
  // so that it favours no data.
  RunBins(std::span<const SimulatedHit> hits, double scale, const std::vector<char>& used,
          const Rules& rules);

  int size() const { return size_; }
  const std::vector<Receiver>& receivers() const { return receivers_; }
  std::vector<int> receiver_of_bin() const;  // by bin: index into receivers()
  // The bin of a hit; -1 when its module is not a receiver.
  int bin(std::uint32_t module, double time) const;
  // Hits by bin, each as if it came `delay` later [ns].
  Eigen::VectorXd counts(std::span<const SimulatedHit> hits, double delay = 0) const;
  // Adds a pulse whose light is spread over `width` [ns] to counts by bin; nothing when its module is no
  // receiver.
  void add_spread(std::uint32_t module, double time, double width, double charge,
                  Eigen::VectorXd& counts) const;

 private:
  std::vector<Receiver> receivers_;  // by module, rising
  std::vector<int> receiver_of_;     // by module; -1: none
  int size_ = 0;
};

}  // namespace floe
