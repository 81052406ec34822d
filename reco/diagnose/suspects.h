// What may be missing in a model: each effect of the catalogue, at every place where it may act.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reco/diagnose/survey.h"
#include "reco/ice_fit/ice_parameter.h"

namespace floe {

// Depths that bands are looked for in.
struct BandGrid {
  double top = 0, step = 0;  // of the shallowest group, thickness of each [m]
  int groups = 0;
};

// Of an effect that needs one: string, dom; depth and width of a band [m].
using Place = std::map<std::string, double>;
// Whether places of one effect are the same string or module, or bands that overlap.
bool is_same_place(const Place& a, const Place& b);

// A hypothesis: an effect, at a place where it needs one, with amplitudes that the data choose.
struct Suspect {
  std::string effect;
  Place place;
  // By amplitude: columns of the survey and their weights in it.
  std::vector<std::vector<std::pair<int, double>>> amplitudes;
  double largest = std::numeric_limits<double>::infinity();  // amplitude that makes sense
  std::optional<DepthRange> layers = {};  // of effects that differ from layer to layer: an amplitude each
};

// The parameters of all effects of the ice, modules and flashers that need no place, and layer by layer those
// of tilt and of bands: what a survey asks for. The layers come last: tilt, absorption, scattering.
struct SuspectPlan {
  std::vector<IceParameter> parameters;
  DepthRange tilt;
  BandGrid bands;
  int first_tilt = 0, first_layer = 0;  // indices of the first slope, of the first group's absorption
};
// `flashers`: so many tell layers apart, in effects that differ from one to the next. `oversize`: of the
// simulations; modules that are widened do not see hole ice.
SuspectPlan plan_suspects(const Model& model, const FlasherDepths& depths, int flashers, double oversize);

// Layers that flashers tell apart.
DepthRange layers_of(const FlasherDepths& depths, int flashers);
// Likewise of the layers' slopes: half as many. A slope acts by its distance from the middle of the detector,
// so that one that a single flasher tells is not known well enough to say what is seen of it when it is held
// out.
DepthRange slopes_of(const FlasherDepths& depths, int flashers);

std::vector<Suspect> suspects_of(const Survey& survey, const SuspectPlan& plan);

// Of an effect of the catalogue that is none of the suspects, the reason.
std::string why_no_suspect(const std::string& effect, const Model& model, double oversize);

// Parameters for a fit of this suspect on a base model. They begin where the survey's amplitudes suggest, or,
// where that would be no physical ice, part of the way there. Throws InputError where no part of it is.
std::vector<IceParameter> fit_parameters(const Suspect& suspect, const Eigen::VectorXd& amplitudes,
                                         const Model& base);

// Those that change with the suspect's amplitudes, one for each: all but the place of a band.
std::vector<IceParameter> changing_parameters(const Suspect& suspect, const Model& base);

// The number of such a parameter at which the effect changes nothing: the base's own.
double null_number(const IceParameter& parameter, const Model& base);
// Depth and width of a band, at which no number changes nothing.
bool is_place_of_band(const IceParameter& parameter);

// Of what is wrong with one place: no step of a fit is longer [1, ns, m]. Not for parameters, which say it
// themselves.
double large_change(SurveyColumn::Kind kind);

// "geometry-offset of string 36", "absorption-layer at 1740-1810 m", "tilt"
std::string text_of(const Suspect& suspect);

}  // namespace floe
