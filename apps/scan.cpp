// floe scan: -ln L of flasher data over two numbers of the ice.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/flasher_input.h"
#include "apps/ice_fit_output.h"
#include "apps/model_json.h"
#include "apps/option_values.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "apps/text_table.h"
#include "data/base/error.h"
#include "reco/ice_fit/scan.h"

namespace floe {

namespace fs = std::filesystem;

namespace {

constexpr int most_values = 1000;  // of an axis

struct ScanCommand {
  std::string data, output, command, x, y;
  ModelRequest model;
  std::optional<std::string> depths, picture;
  bool all_runs = false, quiet = false;
  RunSettings options;
  SimulationSettings run;
};

// What "NAME=LOW:HIGH:COUNT" says, before NAME is looked up.
struct AxisText {
  std::string option, name;
  double low, high;
  int count;

  bool is_family() const { return layer_family_of(name).has_value(); }
};

AxisText parse_axis(const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('='), first = text.find(':', equals),
                    second = text.find(':', first + 1);
  if (equals == text.npos || first == text.npos || second == text.npos)
    throw UsageError(fmt::format("{}: found \"{}\"; expected NAME=LOW:HIGH:COUNT", option, text));
  const std::string low = text.substr(equals + 1, first - equals - 1),
                    high = text.substr(first + 1, second - first - 1), count = text.substr(second + 1);
  return {option, text.substr(0, equals), parse_option_number(option, low, any_number),
          parse_option_number(option, high, any_number),
          static_cast<int>(parse_option_integer(option, count, 3, most_values))};
}

// Where a factor applies: --depths, or all rows of the layer table.
std::pair<double, double> depths_of(const ScanCommand& command, const Model& base) {
  if (command.depths) return parse_depths(*command.depths);
  const auto& layers = base.ice->tables().layers;
  return {layers.front().depth, layers.back().depth};
}

ScanAxis axis_of(const AxisText& text, const ScanCommand& command, const Model& base) {
  try {
    const auto family = layer_family_of(text.name);
    const auto [top, bottom] = depths_of(command, base);
    return {family ? layer_factor(*family, top, bottom, base) : effect_parameter(text.name, base), text.low,
            text.high, text.count};
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{}: {}", text.option, error.what()));
  }
}

// Runs of flashers in other ice say little of this layer.
void leave_out_runs_beyond(const std::pair<double, double>& depths, const Detector& detector,
                           FlasherData& data) {
  const auto [top, bottom] = depths;
  const auto removed = std::erase_if(data.runs, [&, top = top, bottom = bottom](const RunData& run) {
    const double depth = flasher_depth(run, detector);
    return depth < top || depth > bottom;
  });
  if (data.runs.empty())
    throw NoResult(fmt::format(
        "no flasher of the data lies from {:g} to {:g} m deep; --all-runs takes runs of others, too", top,
        bottom));
  if (removed > 0)
    data.left_out.push_back(fmt::format("{} run{} of flashers beyond {:g} to {:g} m", removed,
                                        removed == 1 ? "" : "s", top, bottom));
}

Json axis_json(const ScanAxis& axis) {
  return {{"name", axis.parameter.name},
          {"unit", axis.parameter.unit},
          {"base", axis.base()},
          {"values", axis.values()}};
}

Json scan_json(const IceScan& scan, const ScanCommand& command, const Model& base) {
  const QuadraticMinimum& m = scan.minimum;
  Json json = {{"command", command.command},
               {"version", FLOE_VERSION},
               {"base", to_json(command.model)},
               {"base_model", to_json(base)},
               {"data", command.data},
               {"left_out", scan.left_out},
               {"seed", command.run.seed},
               {"oversize", command.run.oversize},
               {"light", command.options.light.light},
               {"model_error", command.options.model_error},
               {"x", axis_json(scan.x)},
               {"y", axis_json(scan.y)},
               {"neg_llh", Json::array()}};
  for (int row = 0; row < scan.neg_llh.rows; ++row) {
    Json line = Json::array();
    for (int column = 0; column < scan.neg_llh.columns; ++column)
      line.push_back(scan.neg_llh.at(row, column));
    json["neg_llh"].push_back(line);
  }
  json["minimum"] = {{"found", m.found},
                     {"at_edge", m.at_edge},
                     {"x", m.x},
                     {"x_error", m.x_error},
                     {"y", m.y},
                     {"y_error", m.y_error},
                     {"correlation", m.correlation},
                     {"neg_llh", m.value},
                     {"points", m.points.size()}};
  json["noise"] = scan.noise;
  json["bins"] = scan.bins;
  json["photons"] = scan.photons;
  json["seconds"] = scan.seconds;
  json["runs"] = Json::array();
  for (const RunResult& run : scan.runs) json["runs"].push_back(to_json(run));
  return json;
}

std::string minimum_words(const QuadraticMinimum& minimum) {
  std::string words;
  if (minimum.found)
    words = fmt::format("Errors and correlation ({:.2f}) are those of a parabola through {} points.\n",
                        minimum.correlation, minimum.points.size());
  else
    words = "The lowest point of the grid: a parabola has no minimum within it.\n";
  if (minimum.at_edge) words += "It is at the edge of the grid: the minimum may lie beyond.\n";
  return words;
}

std::string scan_table(const IceScan& scan) {
  const QuadraticMinimum& m = scan.minimum;
  std::string text;
  for (const std::string& sentence : scan.left_out) text += "left out: " + sentence + "\n";
  TextTable table({"parameter", "minimum", "base", "unit"}, 1);
  const auto add = [&](const ScanAxis& axis, double value, double error) {
    table.add({axis.parameter.name,
               m.found ? fmt::format("{:.4g} +- {:.2g}", value, error) : fmt::format("{:.4g}", value),
               fmt::format("{:.4g}", axis.base()), axis.parameter.unit});
  };
  add(scan.x, m.x, m.x_error);
  add(scan.y, m.y, m.y_error);
  text += table.str() + minimum_words(m);
  if (scan.noise > level_68)
    text += "The simulation's noise is larger than the 68% contour is high: more --light makes it less.\n";
  return text + fmt::format(
                    "-ln L {:.1f} in {} bins of {} run{}; noise of its differences {:.2g}; {} points, "
                    "{:.3g} photons, {:.0f} s\n",
                    m.value, scan.bins, scan.runs.size(), scan.runs.size() == 1 ? "" : "s", scan.noise,
                    scan.neg_llh.values.size(), static_cast<double>(scan.photons), scan.seconds);
}

void check_usage(const ScanCommand& command, const AxisText& x, const AxisText& y) {
  if (!command.depths) return;
  parse_depths(*command.depths);
  if (!x.is_family() && !y.is_family())
    throw UsageError(
        "--depths says where a factor on absorption, scattering or birefringence applies; neither --x nor "
        "--y is one");
}

void run_scan(const ScanCommand& command) {
  const AxisText x = parse_axis("--x", command.x), y = parse_axis("--y", command.y);
  check_usage(command, x, y);
  RunSettings options = command.options;
  options.seed = command.run.seed;
  options.threads = command.run.threads;
  PlannedOutput json(command.output), picture(command.picture);
  const std::vector<Event> events = read_flasher_file(command.data);
  options.oversize = oversize_for(events, command.run);
  const Model base = load_model(command.model);
  const ScanAxis x_axis = axis_of(x, command, base), y_axis = axis_of(y, command, base);
  FlasherData data = flasher_data(*base.detector, events);
  if (command.depths && !command.all_runs)
    leave_out_runs_beyond(depths_of(command, base), *base.detector, data);

  IceScan scan;
  {
    ProgressBar bar(command.quiet);
    scan = scan_ice(base, data, x_axis, y_axis, options, bar.callback());
  }
  json.write(json_text(scan_json(scan, command, base)));
  if (command.picture)
    picture.write(scan_picture(
        scan,
        fmt::format("-ln L of {} in {}", fs::path(command.data).filename().string(), base.ice->name())));
  json.commit();
  picture.commit();
  if (!command.quiet) fmt::print("{}", scan_table(scan));
}

void add_axis(CLI::App& app, const std::string& name, std::string& text) {
  app.add_option(
         name, text,
         "Values of a parameter of an effect (floe effects), or of a factor on absorption, scattering "
         "or birefringence")
      ->type_name("NAME=LOW:HIGH:COUNT")
      ->required();
}

}  // namespace

void add_scan(CLI::App& floe, const std::string& command_line) {
  CLI::App& app = *floe.add_subcommand("scan", "Likelihood of flasher data over two numbers of the ice");
  const auto command = std::make_shared<ScanCommand>();
  command->command = command_line;
  command->run.oversize = command->options.oversize;
  app.add_option("data", command->data, flasher_data_description)->type_name("DATA")->required();
  add_axis(app, "--x", command->x);
  add_axis(app, "--y", command->y);
  app.add_option("-o,--json", command->output, "File for the landscape, its minimum and errors")
      ->type_name("FILE")
      ->required();
  add_picture(app, "--picture", "Map with contours of 68% and 95%", command->picture);
  app.add_option(
         "--depths", command->depths,
         "Where factors on absorption, scattering, birefringence apply [m]; ice beyond stays as it is. "
         "Default: everywhere")
      ->type_name("TOP,BOTTOM");
  app.add_flag("--all-runs", command->all_runs, "Take runs of flashers beyond --depths, too")
      ->needs("--depths");
  add_model_options(app, command->model);
  add_number(app, "--light", "RATIO", {0.1, 1000}, "Simulated light, in units of the data's",
             command->options.light.light);
  add_number(app, "--model-error", "SIGMA", {0, 1}, "Relative error of the simulation that is allowed for",
             command->options.model_error);
  add_simulation_options(app, command->run);
  app.add_flag("--quiet", command->quiet, "Print nothing but warnings and errors");
  app.footer(
      "Examples:\n"
      "  floe scan runs.h5 --x absorption-scale=0.8:1.2:9 --y scattering-scale=0.8:1.2:9 -o map.json\n"
      "  floe scan runs.h5 --depths 2000,2100 --x scattering=0.7:1.3:9 --y absorption=0.7:1.3:9 -o map.json\n"
      "  floe scan runs.h5 --x birefringence.strength=0:2:9 --y flow-azimuth=110:150:9 -o map.json "
      "--picture map.svg");
  app.callback([command] { run_scan(*command); });
}

}  // namespace floe
