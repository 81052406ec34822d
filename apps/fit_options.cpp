#include "apps/fit_options.h"

#include <fmt/format.h>

#include "apps/option_values.h"
#include "data/base/error.h"

namespace floe {

namespace {

Json covariance_json(const CascadeFit& fit) {
  const Matrix7 covariance = fit.covariance_in_degrees();
  Json rows = Json::array();
  for (int i = 0; i < covariance.rows(); ++i) {
    Json row = Json::array();
    for (int j = 0; j < covariance.cols(); ++j) row.push_back(covariance(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

void add_fit_options(CLI::App& app, FitSettings& settings) {
  app.add_option("--hypothesis", settings.hypothesis,
                 "em or hadron: what the cascade is taken for; with em the energy is EM-equivalent")
      ->type_name("NAME")
      ->capture_default_str();
  add_number(app, "--model-error", "SIGMA", {0, 10}, "Relative error granted to every expectation",
             settings.model_error);
  add_number(app, "--noise-rate", "HZ", {0, 1e6}, "Of dark noise in every module", settings.noise_rate);
  add_number(app, "--effort", "X", {0, 1000, true}, "Multiplies the number of simulated photons",
             settings.effort);
  add_simulation_options(app, settings.simulation);
}

FitOptions to_fit_options(const FitSettings& settings) {
  FitOptions options;
  if (settings.hypothesis == "hadron")
    options.kind = CascadeKind::hadron;
  else if (settings.hypothesis != "em")
    throw UsageError(fmt::format("--hypothesis: found \"{}\"; expected em or hadron", settings.hypothesis));
  options.oversize = settings.simulation.oversize;
  options.seed = settings.simulation.seed;
  options.threads = settings.simulation.threads;
  options.model_error = settings.model_error;
  options.noise_rate = settings.noise_rate;
  options.effort = settings.effort;
  return options;
}

Json fit_json(const CascadeFit& fit) {
  Json json = {{"status", name_of(fit.status)}, {"reason", fit.reason}};
  if (fit.status == FitStatus::not_enough_light) {
    for (const char* key : {"x", "y", "z", "time_ns", "zenith_deg", "azimuth_deg", "energy_gev", "covariance",
                            "neg_llh", "ndof", "p_value"})
      json[key] = nullptr;
  } else {
    const CascadeParameters& cascade = fit.cascade;
    json["x"] = cascade.position.x();
    json["y"] = cascade.position.y();
    json["z"] = cascade.position.z();
    json["time_ns"] = cascade.time;
    json["zenith_deg"] = cascade.zenith / degree;
    json["azimuth_deg"] = cascade.azimuth / degree;
    json["energy_gev"] = cascade.energy;
    json["covariance"] = covariance_json(fit);
    json["neg_llh"] = fit.neg_llh;
    json["ndof"] = fit.ndof;
    json["p_value"] = fit.p_value;
  }
  json["hypothesis"] = fit.kind == CascadeKind::hadron ? "hadron" : "em";
  json["ice"] = {{"name", fit.ice_name}, {"hash", fit.ice_hash}};
  json["neg_llh_error"] = fit.neg_llh_error;
  json["bins"] = fit.bins;
  json["simulations"] = fit.simulations;
  json["photons_propagated"] = fit.photons;
  json["seconds"] = fit.seconds;
  return json;
}

}  // namespace floe
