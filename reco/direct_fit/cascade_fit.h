// The direct fit: a cascade's place, time, direction and energy from hits alone, by simulating the
// light of trial cascades (arXiv:1309.7010, 1311.4767). Theory: docs/theory/direct_fit.md.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "data/base/progress.h"
#include "data/event.h"
#include "propagation/model.h"
#include "reco/data_selection.h"
#include "reco/direct_fit/cascade_parameters.h"
#include "reco/direct_fit/other_minimum.h"
#include "reco/direct_fit/profile.h"
#include "reco/direct_fit/sky_map.h"

namespace floe {

class EventData;         // reco/event_data.h
class ExpectationModel;  // reco/direct_fit/expectation_model.h

// Goes up when results of the same event and options change, errors included: files that go on with earlier
// results compare it.
constexpr int cascade_fit_revision = 10;

struct FitOptions {
  // The hypothesis: electron (the energy is then EM-equivalent) or hadron.
  CascadeKind kind = CascadeKind::electron;
  double oversize = 5;       // of the modules in the last rounds, 1-100; that of the data if simulated
  double model_error = 0.1;  // sigma of the log-normal error of every bin's expectation; >= 0
  // Of data that were simulated with modules that wide, too: then one photon may be seen more than once, and
  // counts scatter more than Poisson's, by this share of what the simulations show. 0: data of real modules;
  // 1: every hit was kept; 1/k: one in k was.
  double data_widened = 0;
  DataSelection selection;  // modules and times left out, dark noise, saturation
  std::uint64_t seed = 1;
  int threads = 0;         // 0: all cores; the result does not depend on it
  double effort = 1;       // multiplies the number of photons; > 0
  bool goodness = true;    // simulate the result again: -ln L, p-value and arrival times
  int sky_map_pixels = 0;  // a side, odd; 0: no map
  bool profile = false;    // intervals from the profile likelihood
  // Where to begin; nothing: found from the data.
  std::optional<CascadeParameters> start;
};

enum class FitStatus {
  ok,
  track_like,        // fitted, but the hits look like those of a muon track
  outside,           // fitted, but the vertex is far outside the instrumented volume
  no_convergence,    // the best point reached is reported
  not_enough_light,  // nothing was fitted: the parameters mean nothing
};
// Whether the parameters are a result.
constexpr bool is_usable(FitStatus status) {
  return status == FitStatus::ok || status == FitStatus::track_like;
}
// "ok", "track_like", "outside", "no_convergence", "not_enough_light".
std::string name_of(FitStatus status);

// Expected light of one module against time, for pictures.
struct ArrivalTimes {
  ModuleId module;
  double begin = 0, step = 10;                      // of the first bin, and of every bin [ns]
  std::vector<double> measured;                     // charge in the bin [photoelectrons]
  std::vector<double> expected;                     // the fit's
  double measured_charge = 0, expected_charge = 0;  // of all times
};

// One step of the fit, for those who want to see it work.
struct FitRound {
  CascadeParameters reached;
  double neg_llh = 0;                            // of the emulated expectation
  double position_step = 0, direction_step = 0;  // size of the design [m], [rad]
  double oversize = 0;
  double pull = 0;  // length of the step in units of its error
};

struct CascadeFit {
  FitStatus status = FitStatus::not_enough_light;
  std::string reason;  // in words, for every status but ok
  CascadeKind kind = CascadeKind::electron;
  std::string ice_name, ice_hash;

  CascadeParameters cascade;
  // x, y, z [m], time [ns], zenith, azimuth [rad], energy [GeV]: statistical error of data and
  // simulation together with the model error; no less than the Cramer-Rao bound where the likelihood's own
  // curvature is mostly noise; where another minimum competes, or places about the only string with light
  // are as likely, with the way there.
  Matrix7 covariance = Matrix7::Constant(std::numeric_limits<double>::quiet_NaN());
  bool errors_beyond_likelihood = false;  // any of these: sky map and profile know nothing of it
  // Of each parameter's error, what the noise of the simulations made: streams are frozen while the score is
  // solved, and the fresh photons of the last calibration show what that cost. NaN where that is not known.
  Vector7 simulation_errors = Vector7::Constant(std::numeric_limits<double>::quiet_NaN());

  // When they were asked for, and the fit ended with the calibrated score.
  std::optional<SkyMap> sky_map;
  std::optional<ProfileIntervals> profile;

  std::optional<OtherMinimum> other_minimum;  // that the search could not tell from this one

  // Saturated negative log-likelihood (0: perfect match) of simulations of the fitted cascade, and its error
  // from their finite number (jackknife over independent simulations).
  double neg_llh = std::numeric_limits<double>::quiet_NaN();
  double neg_llh_error = 0;
  // Twice the mean of neg_llh over pseudo-data drawn from the fit, less 7: what the number of bins less
  // the number of parameters is when every bin is bright.
  double ndof = 0;
  double p_value = std::numeric_limits<double>::quiet_NaN();  // for a neg_llh at least as large
  std::size_t bins = 0;                                       // modules x bins of time that follow the light

  std::uint64_t simulations = 0, photons = 0;  // photons: propagated
  double seconds = 0;
  std::vector<FitRound> rounds;
  std::vector<ArrivalTimes> arrival_times;  // of the 12 brightest modules, brightest first

  bool usable() const { return is_usable(status); }
  // With the angles in degrees, as files have it.
  Matrix7 covariance_in_degrees() const;
  void count_simulation(std::uint64_t propagated) { ++simulations, photons += propagated; }
};

// Fits one event. Deterministic: the same seed gives the same result for any number of threads. What the
// data do not allow comes back as a status with a reason; throws InputError for a hit of a module that
// the detector does not have or a hit that is not finite, UsageError for options out of range.
CascadeFit fit_cascade(const Model& model, const Event& event, const FitOptions& options = {},
                       const Progress& progress = {});

// The same over any source of expected light; what the above calls with simulated light.
CascadeFit fit_cascade(ExpectationModel& light, const EventData& data, const FitOptions& options,
                       const Progress& progress = {});

// Whether the error of the energy, before what competing minima add to it, is smaller than the energy [GeV].
// Where it is not, the likelihood has no minimum that errors could describe, and a fit has not converged.
bool determines_energy(const Matrix7& covariance, double energy);

// "position x y z m, zenith ..." with errors: a few lines for people.
std::string describe(const CascadeFit& fit);

}  // namespace floe
