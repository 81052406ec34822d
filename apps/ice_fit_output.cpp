#include "apps/ice_fit_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/improved_ice.h"
#include "apps/model_json.h"
#include "apps/text_table.h"
#include "data/base/atomic_file.h"
#include "reco/ice_fit/stratigraphy.h"

namespace floe {

namespace fs = std::filesystem;

namespace {

std::string with_error(double value, double error) {
  return fmt::format("{:.3f} +- {:.3f}", value, error);
}

// Factors stand for themselves.
std::string title_of_family(const IceParameter& p) {
  return p.unit.empty() ? p.family + " x" : fmt::format("{} [{}]", p.family, p.unit);
}

// One row a depth, one column a family.
std::string layer_table(const IceFit& fit) {
  std::vector<std::string> header{"depth [m]"};
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const IceParameter& p = fit.parameters[i];
    if (p.family.empty()) continue;
    if (header.back() != title_of_family(p)) header.push_back(title_of_family(p));
    const std::size_t column = header.size() - 1;
    if (column == 1) rows.push_back({fmt::format("{:.0f}", p.depth)});
    for (std::vector<std::string>& row : rows)
      if (row.size() == column && row[0] == fmt::format("{:.0f}", p.depth)) {
        row.push_back(with_error(fit.value(i), fit.error(i)));
        break;
      }
  }
  if (rows.empty()) return "";
  TextTable table(header);
  for (auto& row : rows) table.add(std::move(row));
  return table.str();
}

std::string other_parameters(const IceFit& fit) {
  TextTable table({"parameter", "fitted", "before", "unit"});
  bool any = false;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    const IceParameter& p = fit.parameters[i];
    if (!p.family.empty()) continue;
    table.add({p.name, with_error(fit.value(i), fit.error(i)), fmt::format("{:g}", p.start), p.unit});
    any = true;
  }
  return any ? table.str() : "";
}

std::string run_table(const IceFit& fit) {
  TextTable table({"run", "brightness [photons]", "time zero [ns]", "-ln L", "bins"});
  for (const RunResult& run : fit.runs)
    table.add({run.name, fmt::format("{:.4g}", run.brightness), fmt::format("{:.2f}", run.time_zero),
               fmt::format("{:.1f}", run.neg_llh), fmt::format("{}", run.bins)});
  return table.str();
}

// Few words for people; efficiencies.csv has them all.
std::string efficiency_line(const IceFit& fit) {
  if (fit.efficiencies.empty()) return "";
  const auto off = [](const ReceiverEfficiency& e) { return std::abs(e.factor - 1) / e.error; };
  const auto most = std::ranges::max_element(fit.efficiencies, {}, off);
  double squares = 0;
  for (const ReceiverEfficiency& e : fit.efficiencies) squares += (e.factor - 1) * (e.factor - 1);
  return fmt::format(
      "efficiencies of {} receivers: they scatter by {:.3f} (after the prior); furthest off is {},{} with "
      "{}\n",
      fit.efficiencies.size(), std::sqrt(squares / static_cast<double>(fit.efficiencies.size())),
      most->module.string, most->module.dom, with_error(most->factor, most->error));
}

std::string efficiencies_csv(const IceFit& fit) {
  std::string text = "string,dom,factor,error\n";
  for (const ReceiverEfficiency& e : fit.efficiencies)
    text += fmt::format("{},{},{:.4f},{:.4f}\n", e.module.string, e.module.dom, e.factor, e.error);
  return text;
}

Json parameter_json(const IceFit& fit, std::size_t i) {
  const IceParameter& p = fit.parameters[i];
  Json json = {{"name", p.name}, {"value", fit.value(i)}, {"error", fit.error(i)}, {"unit", p.unit}};
  json["before"] = p.logarithmic ? std::exp(p.start) : p.start;
  if (!p.family.empty()) {
    json["family"] = p.family;
    json["depth_m"] = p.depth;
  }
  // Without the priors; null where the light says nothing.
  const double light = fit.light_errors[i];
  json["error_of_light_alone"] = p.logarithmic ? light * fit.value(i) : light;
  return json;
}

// The log of what is different in the new directory.
std::string changes(const IceFitReport& report) {
  std::string text = fmt::format("Ice model made by floe {} from {} ({}), fitted to {}.\n{}\n\n{}{}",
                                 FLOE_VERSION, report.base_request.ice, report.base.ice->hash(), report.data,
                                 report.command, layer_table(report.fit), other_parameters(report.fit));
  text +=
      "\nA column \"x\" says by which factor the base model's values were multiplied in the layers around "
      "that depth.\n";
  return text;
}

}  // namespace

std::string ice_fit_table(const IceFitReport& report) {
  const IceFit& fit = report.fit;
  std::string text;
  for (const std::string& sentence : report.fit.left_out) text += "left out: " + sentence + "\n";
  text += layer_table(fit) + other_parameters(fit) + run_table(fit) + efficiency_line(fit);
  return text + fmt::format("-ln L {:.1f} in {} bins; {} rounds, {:.3g} photons, {:.0f} s{}\n", fit.neg_llh,
                            fit.bins, fit.rounds, static_cast<double>(fit.photons), fit.seconds,
                            fit.converged ? "" : "; the last step was not yet small");
}

Json to_json(const RunResult& run) {
  return {{"run", run.name},
          {"brightness_photons", run.brightness},
          {"time_zero_ns", run.time_zero},
          {"neg_llh", run.neg_llh},
          {"bins", run.bins}};
}

Json ice_fit_json(const IceFitReport& report) {
  const IceFit& fit = report.fit;
  Json json = {{"command", report.command},
               {"version", FLOE_VERSION},
               {"base", to_json(report.base_request)},
               {"base_model", to_json(report.base)},
               {"fitted_model", to_json(report.fitted)},
               {"data", report.data},
               {"left_out", report.fit.left_out},
               {"seed", report.options.seed},
               {"converged", fit.converged},
               {"rounds", fit.rounds},
               {"photons", fit.photons},
               {"seconds", fit.seconds},
               {"neg_llh", fit.neg_llh},
               {"bins", fit.bins},
               {"parameters", Json::array()},
               {"runs", Json::array()},
               {"correlation", Json::array()}};
  const Eigen::VectorXd errors = fit.covariance.diagonal().cwiseSqrt();
  for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
    json["parameters"].push_back(parameter_json(fit, i));
    Json row = Json::array();
    for (Eigen::Index k = 0; k < errors.size(); ++k) {
      const auto index = static_cast<Eigen::Index>(i);
      row.push_back(fit.covariance(index, k) / (errors(index) * errors(k)));
    }
    json["correlation"].push_back(row);
  }
  for (const RunResult& run : fit.runs) json["runs"].push_back(to_json(run));
  for (const ReceiverEfficiency& e : fit.efficiencies)
    json["efficiencies"].push_back(
        {{"string", e.module.string}, {"dom", e.module.dom}, {"factor", e.factor}, {"error", e.error}});
  return json;
}

void write_ice_fit(const IceFitReport& report, const fs::path& folder) {
  const auto rows = stratigraphy(report.base, report.fitted, report.fit);
  const std::string title =
      fmt::format("{} fitted to {}", report.base.ice->name(), fs::path(report.data).filename().string());
  write_whole_file(folder / "result.json", json_text(ice_fit_json(report)));
  write_whole_file(folder / "stratigraphy.csv", stratigraphy_csv(rows));
  write_whole_file(folder / "stratigraphy.svg", stratigraphy_picture(rows, title));
  if (!report.fit.efficiencies.empty())
    write_whole_file(folder / "efficiencies.csv", efficiencies_csv(report.fit));
  write_improved_ice(report.base_request, report.fitted, {}, changes(report), folder / improved_ice_folder);
}

}  // namespace floe
