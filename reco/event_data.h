// One event as the fit sees it: charge in bins of time, module by module.
#pragma once

#include <cstdint>
#include <vector>

#include "data/event.h"
#include "geometry/detector.h"

namespace floe {

// Hits of one module.
struct ModuleData {
  std::uint32_t module = 0;     // index in Detector::modules()
  std::vector<double> times;    // rising [ns]
  std::vector<double> charges;  // of the same length [photoelectrons, of all repetitions together]
  double charge = 0;            // sum
  std::vector<double> edges;    // inner edges of the time bins [ns], rising; see block_edges
  std::vector<double> counts;   // charge in each bin: edges.size() + 1 numbers
};

// The hits of one event sorted by module and cut into bins: Bayesian blocks over 25 ns cells where there
// are hits, one bin for a module without. Modules that are off are left out on both sides.
class EventData {
 public:
  // Throws InputError for a module that the detector does not have, for times that are not finite and
  // for charges that are negative or not finite. Hits of charge 0 and of switched-off modules are ignored.
  EventData(const Detector& detector, const Event& event);

  // How far the range in which blocks are sought goes beyond the event's hits [ns].
  static constexpr double margin = 200;
  // The least there must be to fit seven numbers.
  static constexpr std::size_t least_modules = 4;
  static constexpr double least_charge = 10;
  // Throws NoResult ("not enough light: ...") unless there are least_modules modules with hits and
  // least_charge photoelectrons.
  void require_enough_light() const;

  const Detector& detector() const { return *detector_; }  // must outlive this
  const std::string& id() const { return id_; }
  double repeats() const { return repeats_; }                  // n_d: charges are sums over so many events
  const std::vector<ModuleData>& lit() const { return lit_; }  // with hits, by module index
  const std::vector<std::uint32_t>& dark() const { return dark_; }  // on, without hits
  double charge() const { return charge_; }
  double first_time() const { return first_; }
  double last_time() const { return last_; }
  std::size_t bins() const;                                 // of all modules
  std::vector<std::size_t> brightest(std::size_t n) const;  // places in lit(), by falling charge

 private:
  const Detector* detector_;
  std::string id_;
  double repeats_ = 1, charge_ = 0, first_ = 0, last_ = 0;
  std::vector<ModuleData> lit_;
  std::vector<std::uint32_t> dark_;
};

}  // namespace floe
