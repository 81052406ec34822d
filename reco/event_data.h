// One event as the fit sees it: charge in bins of time, module by module.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "data/event.h"
#include "geometry/detector.h"
#include "reco/data_selection.h"

namespace floe {

// Hits of one module.
struct ModuleData {
  std::uint32_t module = 0;     // index in Detector::modules()
  std::vector<double> times;    // rising [ns]
  std::vector<double> charges;  // of the same length [photoelectrons, of all repetitions together]
  std::vector<double> widths;   // over which their light may be spread, centred; 0 for photons [ns]
  double charge = 0;            // sum
  // Its charge reached the cap: one bin, whose count is the cap and stands for "so much or more".
  bool saturated = false;
  std::vector<double> edges;   // inner edges of the time bins [ns], rising; see block_edges
  std::vector<double> counts;  // charge in each bin: edges.size() + 1 numbers
  std::vector<double> noise;   // expected dark counts and afterpulses of one event in each bin
  std::vector<bool> left_out;  // bins that are not used; their counts are 0
  // What afterpulses follow: all of its pulses, at times that are used or not; times [ns] and charges.
  std::vector<std::pair<double, double>> afterpulse_sources;
};

// The hits of one event sorted by module and cut into bins: Bayesian blocks over 25 ns cells where there
// are hits, one bin for a module without. Modules that are off or bad are left out on both sides.
class EventData {
 public:
  // Throws InputError for a module that the detector does not have, for times that are not finite and
  // for charges that are negative or not finite. Hits of charge 0 and of switched-off modules are ignored.
  // An event with a readout knows which modules were off, which times cannot be used, its dark noise (where
  // `selection` names none) and its afterpulses, which are taken to follow what was seen.
  // `selection`: see there; throws UsageError when it makes no sense.
  EventData(const Detector& detector, const Event& event, const DataSelection& selection = {});

  // The same hits in other bins: inner edges [ns], rising, for every module of lit().
  EventData with_edges(std::span<const std::vector<double>> edges) const;

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
  double repeats() const { return repeats_; }  // n_d: charges are sums over so many events
  // With hits, or with times left out; by module index.
  const std::vector<ModuleData>& lit() const { return lit_; }
  const std::vector<std::uint32_t>& dark() const { return dark_; }  // the others that are on: one bin each
  double dark_noise(std::uint32_t module) const;                    // expected dark counts of one event
  double charge() const { return charge_; }
  // Variance of charges in units of that of as many photoelectrons: 1 for photons; for pulses told by modules
  // with a single one, as n charges q have the variance n <q^2>.
  double charge_dispersion() const { return charge_dispersion_; }
  // Where the outermost bins end, for all that needs a finite width [ns].
  double begin() const { return first_ - margin; }
  double end() const { return last_ + margin; }
  std::size_t bins() const;  // of all modules
  std::vector<std::size_t> brightest(
      std::size_t n) const;  // places in lit(), by falling charge, without empty ones

 private:
  void learn_from(const Readout& readout);
  double afterpulses_between(const ModuleData& data, double low, double high) const;
  void cut_into_bins(ModuleData& data, std::vector<double> edges) const;

  const Detector* detector_;
  DataSelection selection_;  // with what the event's readout says
  ExpectedAfterpulses afterpulses_;
  std::string id_;
  double repeats_ = 1, charge_ = 0, charge_dispersion_ = 1, first_ = 0, last_ = 0;
  std::vector<ModuleData> lit_;
  std::vector<std::uint32_t> dark_;
};

}  // namespace floe
