// floe info: what an ice model and its detector consist of, in words and as a table against depth.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/model_summary.h"
#include "apps/option_values.h"
#include "apps/planned_output.h"
#include "apps/text_table.h"
#include "data/base/constants.h"
#include "propagation/model.h"

namespace floe {

namespace {

struct InfoOptions {
  ModelRequest model;
  OutputOptions output;
  double wavelength = 400;  // [nm]
  double step = 20;         // of the table [m]
};

// One row of the table of ice against depth.
struct DepthRow {
  double depth;                        // [m]
  double effective_scattering_length;  // of dust, bubbles and crystals together [m]
  double mie_scattering_length;        // without the crystals [m]
  double absorption_length;            // [m]
  double birefringence_strength, deflection_strength;
};

// What is built in is written from published facts, not fitted to data.
bool is_idealised_ice(const InfoOptions& options) {
  return options.model.ice == "south-pole";
}
bool is_idealised_detector(const InfoOptions& options) {
  return options.model.detector ? *options.model.detector == "ic86" : is_idealised_ice(options);
}

bool has_birefringence(const IceModel& ice) {
  return ice.birefringence().has_value();
}

DepthRow depth_row(const IceModel& ice, int layer, double wavelength) {
  const IceLayer& values = ice.layers()[layer];
  const double mie = ice.effective_scattering(layer, wavelength);
  const double crystals =
      has_birefringence(ice) ? values.diffusion_strength * ice.birefringent_scattering() : 0.0;
  return {layer_depth(ice, layer),
          1 / (mie + crystals),
          1 / mie,
          1 / ice.absorption(layer, wavelength),
          has_birefringence(ice) ? values.diffusion_strength : 0.0,
          has_birefringence(ice) ? values.deflection_strength : 0.0};
}

// Every layer that is the next one at least `step` deeper, from the top down.
std::vector<DepthRow> depth_rows(const IceModel& ice, double wavelength, double step) {
  std::vector<DepthRow> rows;
  for (int layer = static_cast<int>(ice.layers().size()) - 1; layer >= 0; --layer)
    if (rows.empty() || layer_depth(ice, layer) >= rows.back().depth + step - 1e-6)
      rows.push_back(depth_row(ice, layer, wavelength));
  return rows;
}

void print_lines(const std::string& title, const std::vector<SummaryLine>& lines) {
  fmt::print("{}\n", title);
  for (const SummaryLine& line : lines) fmt::print("  {:<22} {}\n", line.label, line.text);
  fmt::print("\n");
}

// A length with about three digits.
std::string length(double metres) {
  if (metres < 0.1) return fmt::format("{:.2g}", metres);
  return fmt::format("{:.{}f}", metres, metres < 10 ? 2 : metres < 100 ? 1 : 0);
}

void print_table(const IceModel& ice, const InfoOptions& options) {
  fmt::print(
      "Ice at {:g} nm, all in m but the strength of birefringence; scattering lengths are effective: of "
      "dust, bubbles\nand crystals together, and without the crystals\n",
      options.wavelength);
  TextTable table({"  depth", "z", "scattering", "without crystals", "absorption", "birefringence"});
  for (const DepthRow& row : depth_rows(ice, options.wavelength, options.step))
    table.add({fmt::format("{:7.1f}", row.depth), fmt::format("{:.1f}", origin_depth - row.depth),
               length(row.effective_scattering_length), length(row.mie_scattering_length),
               length(row.absorption_length), fmt::format("{:.2f}", row.birefringence_strength)});
  fmt::print("{}", table.str());
}

Json birefringence_json(const IceModel& ice) {
  if (!has_birefringence(ice)) return nullptr;
  const BirefringenceNumbers& numbers = *ice.birefringence();
  const auto function = [](const DiffusionFunction& f) { return Json{f.A, f.B, f.C, f.D}; };
  return {{"sigma_x", function(numbers.sigma_x)},
          {"sigma_y", function(numbers.sigma_y)},
          {"m_x", function(numbers.mean_x)},
          {"diffusion", numbers.diffusion},
          {"deflection", numbers.deflection},
          {"displacement", numbers.displacement},
          {"mean_scattering_per_m", ice.birefringent_scattering()}};
}

Json ice_json(const IceModel& ice, const InfoOptions& options) {
  const IceTables& tables = ice.tables();
  const auto& K = ice.absorption_anisotropy();
  Json json = {{"name", ice.name()},
               {"hash", ice.hash()},
               {"idealised", is_idealised_ice(options)},
               {"version", tables.version},
               {"layers", ice.layers().size()},
               {"layer_step_m", ice.layer_step()},
               {"z_bottom_m", ice.z_bottom()},
               {"mean_cosine", ice.mean_cosine()},
               {"simplified_liu_fraction", ice.simplified_liu_fraction()},
               {"flow_azimuth_deg", ice.flow_azimuth() / degree},
               {"birefringence", birefringence_json(ice)},
               {"absorption_anisotropy", {1 / K[0], 1 / K[1], 1 / K[2]}},
               {"tilt", tables.tilt_map     ? "2D"
                        : tables.tilt_lines ? "1D"
                                            : "none"},
               {"hole_ice_radius", tables.configuration.hole_ice.radius},
               {"wavelength_nm", options.wavelength}};
  Json& table = json["table"] = Json::array();
  for (const DepthRow& row : depth_rows(ice, options.wavelength, options.step))
    table.push_back({{"depth_m", row.depth},
                     {"effective_scattering_length_m", row.effective_scattering_length},
                     {"without_crystals_m", row.mie_scattering_length},
                     {"absorption_length_m", row.absorption_length},
                     {"birefringence_strength", row.birefringence_strength},
                     {"deflection_strength", row.deflection_strength}});
  return json;
}

Json detector_json(const Model& model, const InfoOptions& options) {
  const Detector& detector = *model.detector;
  const DetectorCounts counts = count_modules(detector);
  return {{"name", detector.name()},
          {"hash", detector.hash()},
          {"idealised", is_idealised_detector(options)},
          {"strings", detector.strings().size()},
          {"modules", detector.size()},
          {"modules_on", counts.on},
          {"modules_high_efficiency", counts.high_qe},
          {"modules_with_cable", counts.cables},
          {"modules_tilted", counts.tilted},
          {"largest_relative_efficiency", detector.largest_relative_efficiency()},
          {"overall_efficiency", model.acceptance.overall_efficiency},
          {"angular_maximum", model.acceptance.angular.maximum()}};
}

void run_info(const InfoOptions& options) {
  PlannedOutput json(options.output.json);
  const Model model = load_model(options.model);
  json.write(
      json_text({{"ice", ice_json(*model.ice, options)}, {"detector", detector_json(model, options)}}));
  json.commit();
  if (options.output.quiet) return;
  print_lines("Ice", ice_lines(*model.ice, is_idealised_ice(options)));
  print_lines("Detector", detector_lines(model, is_idealised_detector(options)));
  print_table(*model.ice, options);
}

}  // namespace

void add_info(CLI::App& floe) {
  CLI::App& app = *floe.add_subcommand("info", "Say what an ice model and its detector consist of");
  const auto options = std::make_shared<InfoOptions>();
  add_model_options(app, options->model);
  add_number(app, "--wavelength", "NM", {300, 600}, "Of the light that the table is for",
             options->wavelength);
  add_number(app, "--step", "M", positive,
             "Depth between the lines of the table; layers thinner than it are passed over", options->step);
  add_output_options(app, options->output);
  app.footer(
      "Examples:\n"
      "  floe info\n"
      "  floe info --ice my-ice --wavelength 405 --step 10\n"
      "  floe info --without birefringence --json info.json\n"
      "  floe info --with birefringence.strength=0.5,tilt.slope=10");
  app.callback([options] { run_info(*options); });
}

}  // namespace floe
