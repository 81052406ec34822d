#include "apps/fit_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "apps/option_values.h"
#include "data/base/error.h"
#include "data/base/text.h"
#include "data/event_rules.h"

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

Json areas_json(const SkyMap& map) {
  return {{"area_50_deg2", map.area(0.5)},
          {"area_90_deg2", map.area(0.9)},
          {"cut_90", map.is_cut(0.9)},
          {"errors_are_wider", map.errors_are_wider}};
}

Json profile_json(const ProfileIntervals& intervals) {
  Json json = Json::object();
  for (std::size_t i = 0; i < 7; ++i) {
    const ShownParameter& shown = shown_parameters[i];
    json[shown.key] = Json::array({intervals[i].low / shown.unit_size, intervals[i].high / shown.unit_size});
  }
  return json;
}

Json cascade_json(const CascadeParameters& cascade) {
  const Vector7 value = to_vector(cascade);
  Json json = Json::object();
  for (std::size_t i = 0; i < 7; ++i)
    json[shown_parameters[i].key] = value(static_cast<int>(i)) / shown_parameters[i].unit_size;
  return json;
}

Json other_minimum_json(const OtherMinimum& other) {
  Json json = cascade_json(other.cascade);
  json["delta_neg_llh"] = other.delta_neg_llh;
  json["delta_neg_llh_error"] = other.delta_neg_llh_error;
  return json;
}

ModuleId module_of(const TextLine& line) {
  const long string = parse_integer(line, 0, "string"), dom = parse_integer(line, 1, "DOM");
  expect_range(line, static_cast<double>(string), 1, largest_string, "string");
  expect_range(line, static_cast<double>(dom), 1, largest_dom, "DOM");
  return {static_cast<int>(string), static_cast<int>(dom)};
}

std::map<ModuleId, double> read_noise(const std::string& file) {
  std::map<ModuleId, double> noise;
  for (const TextLine& line : read_text_lines(file)) {
    expect_fields(line, 3, 3, "string, DOM, noise rate [1/s]");
    const double rate = parse_number(line, 2, "noise rate [1/s]");
    expect_range(line, rate, 0, 1e6, "noise rate [1/s]");
    noise[module_of(line)] = rate;
  }
  return noise;
}

}  // namespace

std::vector<ModuleId> parse_modules(const std::string& option, const std::string& text) {
  std::vector<ModuleId> modules;
  if (text.empty() || text.find_first_not_of("0123456789,; ") != std::string::npos) {
    for (const TextLine& line : read_text_lines(text)) {
      expect_fields(line, 2, 2, "string, DOM");
      modules.push_back(module_of(line));
    }
    return modules;
  }
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    modules.push_back(parse_module(option, text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return modules;
}

TimeWindow parse_window(const std::string& option, const std::string& text) {
  TimeWindow window;
  std::string times = text;
  if (const std::size_t colon = text.find(':'); colon != std::string::npos) {
    window.module = parse_module(option, text.substr(0, colon));
    times = text.substr(colon + 1);
  }
  const std::vector<std::string> parts = split_list(times);
  if (parts.size() != 2)
    throw UsageError(
        fmt::format("{}: found \"{}\"; expected BEGIN,END or STRING,DOM:BEGIN,END [ns]", option, text));
  window.begin = parse_option_number(option, parts[0], any_number);
  window.end = parse_option_number(option, parts[1], {window.begin, any_number.high, true});
  return window;
}

void add_fit_options(CLI::App& app, FitSettings& settings) {
  app.add_option("--hypothesis", settings.hypothesis,
                 "em or hadron: what the cascade is taken for; with em the energy is EM-equivalent")
      ->type_name("NAME")
      ->capture_default_str();
  add_number(app, "--model-error", "SIGMA", {0, 10}, "Relative error granted to every expectation",
             settings.model_error);
  app.add_option("--bad", settings.bad, "Modules to leave out, or a file with STRING DOM on a line")
      ->type_name("STRING,DOM[;...]|FILE")
      ->allow_extra_args(false);
  app.add_option("--leave-out", settings.left_out, "Times to leave out [ns], of all modules or of one")
      ->type_name("[STRING,DOM:]BEGIN,END")
      ->allow_extra_args(false);
  add_number(app, "--noise-rate", "HZ", {0, 1e6}, "Of dark noise in every module", settings.noise_rate);
  app.add_option("--noise", settings.noise_file,
                 "Dark noise of modules where it differs: STRING DOM HZ on a line")
      ->type_name("FILE");
  add_number(app, "--charge-cap", "PE", positive,
             "Charge at which a module saturates: of more, only is used that it is as much or more",
             [&settings](double cap) { settings.charge_cap = cap; });
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
  options.effort = settings.effort;
  DataSelection& selection = options.selection;
  for (const std::string& text : settings.bad)
    for (const ModuleId module : parse_modules("--bad", text)) selection.bad.push_back(module);
  for (const std::string& text : settings.left_out)
    selection.left_out.push_back(parse_window("--leave-out", text));
  selection.noise_rate = settings.noise_rate;
  if (settings.noise_file) selection.noise_of = read_noise(*settings.noise_file);
  if (settings.charge_cap) selection.charge_cap = *settings.charge_cap;
  return options;
}

Json to_json(const FitOptions& options) {
  const auto name = [](ModuleId id) { return fmt::format("{},{}", id.string, id.dom); };
  Json bad = Json::array(), left_out = Json::array(), noise = Json::object();
  for (const ModuleId id : options.selection.bad) bad.push_back(name(id));
  for (const TimeWindow& window : options.selection.left_out)
    left_out.push_back({{"module", window.module ? Json(name(*window.module)) : Json()},
                        {"begin_ns", window.begin},
                        {"end_ns", window.end}});
  for (const auto& [id, rate] : options.selection.noise_of) noise[name(id)] = rate;
  return {{"hypothesis", options.kind == CascadeKind::hadron ? "hadron" : "em"},
          {"oversize", options.oversize},
          {"model_error", options.model_error},
          {"seed", options.seed},
          {"effort", options.effort},
          {"bad", bad},
          {"left_out", left_out},
          {"noise_rate", options.selection.noise_rate},
          {"noise_of", noise},
          {"charge_cap", options.selection.charge_cap}};
}

Json fit_json(const CascadeFit& fit) {
  Json json = {{"status", name_of(fit.status)}, {"reason", fit.reason}};
  if (fit.status == FitStatus::not_enough_light) {
    for (const ShownParameter& shown : shown_parameters) json[shown.key] = nullptr;
    for (const char* key : {"covariance", "neg_llh", "ndof", "p_value"}) json[key] = nullptr;
  } else {
    json.update(cascade_json(fit.cascade));
    json["covariance"] = covariance_json(fit);
    json["neg_llh"] = fit.neg_llh;
    json["ndof"] = fit.ndof;
    json["p_value"] = fit.p_value;
  }
  if (fit.sky_map) json["sky_map"] = areas_json(*fit.sky_map);
  if (fit.profile) json["profile"] = profile_json(*fit.profile);
  if (fit.other_minimum) json["other_minimum"] = other_minimum_json(*fit.other_minimum);
  json["hypothesis"] = fit.kind == CascadeKind::hadron ? "hadron" : "em";
  json["ice"] = {{"name", fit.ice_name}, {"hash", fit.ice_hash}};
  json["errors_beyond_likelihood"] = fit.errors_beyond_likelihood;
  Json& simulation = json["simulation_errors"] = Json::object();
  for (std::size_t i = 0; i < 7; ++i) {
    const ShownParameter& shown = shown_parameters[i];
    simulation[shown.key] = fit.simulation_errors(static_cast<Eigen::Index>(i)) / shown.unit_size;
  }
  json["neg_llh_error"] = fit.neg_llh_error;
  json["bins"] = fit.bins;
  json["simulations"] = fit.simulations;
  json["photons_propagated"] = fit.photons;
  json["seconds"] = fit.seconds;
  return json;
}

}  // namespace floe
