#include "reco/validation/reference_sets.h"

#include <cmath>
#include <memory>

#include "data/event_files.h"
#include "propagation/sources/cascade.h"
#include "propagation/sources/flasher.h"

namespace floe {

namespace {

constexpr double reference_oversize = 5;
constexpr double level = 0.001;  // of every test, over the number of modules tried
constexpr double total_tolerance = 0.02;

std::unique_ptr<Source> make_source(const ReferenceSet& set, const Model& model) {
  if (set.kind == ReferenceSet::Kind::cascade) {
    Cascade cascade;
    cascade.position = {20, -40, -300};
    cascade.zenith = 70 * degree;
    cascade.azimuth = 130 * degree;
    cascade.energy = 50e3;
    return std::make_unique<CascadeSource>(cascade, model.acceptance.spectrum);
  }
  FlasherSettings settings;
  settings.photons = set.photons * reference_led_share;
  settings.isotropic = set.kind == ReferenceSet::Kind::isotropic_flash;
  return std::make_unique<FlasherSource>(*model.detector, set.module, settings, reference_led_line());
}

// Simulated hits, and how much counts scatter more than Poisson's because a photon is seen again.
class Collector {
 public:
  explicit Collector(const Detector& detector) : detector_(detector) {}

  void operator()(std::span<const SimulatedHit> portion) {
    for (const SimulatedHit& hit : portion) {
      hits_.push_back(to_hit(hit, detector_));
      if (hit.photon != photon_) seen_by_.clear();
      photon_ = hit.photon;
      // sum of squares of a photon's counts per module, built up hit by hit: (m+1)^2 - m^2 = 2m + 1
      squares_ += 2 * static_cast<double>(seen_by_[hit.module]++) + 1;
    }
  }
  const std::vector<Hit>& hits() const { return hits_; }
  double dispersion() const { return hits_.empty() ? 1 : squares_ / static_cast<double>(hits_.size()); }

 private:
  const Detector& detector_;
  std::vector<Hit> hits_;
  std::uint64_t photon_ = 0;
  std::map<std::uint32_t, int> seen_by_;
  double squares_ = 0;
};

}  // namespace

std::vector<ReferenceSet> reference_sets() {
  using Kind = ReferenceSet::Kind;
  const std::string bfr = "spice_bfr-v2", ftp = "spice_ftp-v3m";
  return {{"flasher-63_20_bfr", bfr, {}, Kind::flasher, {63, 20}, 2e9},
          {"flasher-63_20_nobfr", bfr, {"birefringence"}, Kind::flasher, {63, 20}, 2e9},
          {"flasher-63_20_ftp", ftp, {}, Kind::flasher, {63, 20}, 2e9},
          {"flasher-63_20_iso", bfr, {}, Kind::isotropic_flash, {63, 20}, 2e9},
          {"flasher-36_45_bfr", bfr, {}, Kind::flasher, {36, 45}, 1e9},
          {"cascade-50tev", bfr, {}, Kind::cascade, {}, 0}};
}

std::filesystem::path reference_file(const ReferenceSet& set, const ValidationOptions& options) {
  return options.reference / (set.name + ".hits.gz");
}

ValidationResult validate_set(const ReferenceSet& set, const ValidationOptions& options,
                              const Progress& progress) {
  const EventFile reference = read_event_file(reference_file(set, options));
  ModelRequest request;
  request.ice = (options.ice_models / set.ice).string();
  request.without = set.without;
  const Simulator simulator(load_model(request), reference_oversize, options.engine);

  Collector collector(*simulator.model().detector);
  SimulationOptions simulation;
  simulation.seed = options.seed;
  simulation.threads = options.threads;
  simulation.scale = options.share;
  ValidationResult result;
  result.simulation = simulator.run(
      *make_source(set, simulator.model()), simulation,
      [&](std::span<const SimulatedHit> portion) { collector(portion); }, progress);
  result.dispersion = collector.dispersion();

  const SampleComparison& c = result.comparison =
      compare_samples(collector.hits(), options.share, reference.events.at(0).hits, 1, result.dispersion);
  result.total_passes = std::abs(c.ratio - 1) < std::max(total_tolerance, 3 * c.ratio_error);
  result.modules_pass = c.modules > 0 && c.chi_square_p > level;
  result.times_pass = c.times.passes(level);
  result.directions_pass = c.zeniths.passes(level) && c.azimuths.passes(level) && c.impacts.passes(level);
  return result;
}

}  // namespace floe
