// floe study: can the fit's results and errors be believed?
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/model_json.h"
#include "apps/option_values.h"
#include "apps/parallel_events.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "apps/row_journal.h"
#include "apps/study_rows.h"
#include "data/base/error.h"
#include "data/base/hash.h"
#include "propagation/model_hash.h"
#include "reco/study/bias.h"
#include "reco/study/summary.h"
#include "response/response_file.h"

namespace floe {
namespace {

struct StudyCommand {
  ModelRequest model;
  std::vector<std::string> groups{"1e4,40,10", "1e5,40,20", "1e6,10,40"};
  std::optional<std::string> fit_ice;
  std::vector<std::string> fit_without;
  std::vector<EffectSetting> fit_with;
  double effort = 1;
  bool pulses = false;
  std::optional<std::string> response;  // settings of the electronics; pulses, too
  SimulationSettings run;
  std::optional<std::string> rows, picture;
  OutputOptions output;
};

StudyGroup group_of(const std::string& text) {
  const std::vector<std::string> parts = split_list(text);
  if (parts.size() != 3)
    throw UsageError(fmt::format("--group: found \"{}\"; expected ENERGY,EVENTS,OVERSIZE", text));
  return {parse_option_number("--group", parts[0], {1, 1e9}),
          static_cast<int>(parse_option_integer("--group", parts[1], 1, 100000)),
          parse_option_number("--group", parts[2], {1, 100})};
}

// The model that is fitted, too: what the data are made with, changed. A parameter that both set has the
// fit's value.
std::optional<ModelRequest> other_model(const StudyCommand& command) {
  if (!command.fit_ice && command.fit_without.empty() && command.fit_with.empty()) return {};
  ModelRequest other = command.model;
  if (command.fit_ice) other.ice = *command.fit_ice, other.ice_version.reset();
  other.without.insert(other.without.end(), command.fit_without.begin(), command.fit_without.end());
  for (const EffectSetting& setting : command.fit_with)
    std::erase_if(other.with, [&](const EffectSetting& of_data) {
      return of_data.effect == setting.effect && of_data.parameter == setting.parameter;
    });
  other.with.insert(other.with.end(), command.fit_with.begin(), command.fit_with.end());
  return other;
}

std::optional<ResponseSettings> electronics_of(const StudyCommand& command) {
  if (command.response) return read_response_file(*command.response);
  if (command.pulses) return ResponseSettings();
  return {};
}

StudySettings settings_of(const StudyCommand& command, const std::optional<ResponseSettings>& electronics) {
  StudySettings settings;
  for (const std::string& text : command.groups) settings.groups.push_back(group_of(text));
  for (std::size_t i = 0; i < settings.groups.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (std::abs(std::log10(settings.groups[i].energy / settings.groups[k].energy)) < 0.001)
        throw UsageError(fmt::format("--group: {:g} GeV is given twice, or nearly (within 0.2%)",
                                     settings.groups[i].energy));
  settings.truth = load_model(command.model);
  if (const auto other = other_model(command)) settings.other = load_model(*other);
  settings.seed = command.run.seed;
  settings.fit.model_error = 0;  // the simulated data have none
  settings.fit.effort = command.effort;
  if (electronics)
    settings.response =
        std::make_shared<DetectorResponse>(*settings.truth.detector, *electronics, settings.seed);
  return settings;
}

// All that rows depend on: rows of two fits are no study.
Json heading_of(const StudySettings& settings, const std::optional<ResponseSettings>& electronics) {
  Json oversize = Json::object();
  for (const StudyGroup& group : settings.groups)
    oversize[fmt::format("{:g}", group.energy)] = group.oversize;
  Json heading = {{"journal", "floe study"},
                  {"fit", cascade_fit_revision},
                  {"version", FLOE_VERSION},
                  {"seed", settings.seed},
                  {"effort", settings.fit.effort},
                  {"oversize", oversize},
                  {"model", model_hash(settings.truth)},
                  {"fit_model", settings.other ? Json(model_hash(*settings.other)) : Json()}};
  if (electronics)
    heading["response"] = Hasher().add(std::string_view(response_file_text(*electronics))).hex();
  return heading;
}

struct Task {
  StudyGroup group;
  int index;
};

std::vector<StudyRow> run_events(const StudyCommand& command, const StudySettings& settings,
                                 RowJournal* journal) {
  std::map<std::pair<double, int>, StudyRow> done;
  if (journal)
    for (const Json& json : journal->rows()) {
      const StudyRow row = study_row_of(json);
      done[{row.energy, row.index}] = row;
    }
  std::vector<Task> tasks;
  for (const StudyGroup& group : settings.groups)
    for (int index = 0; index < group.events; ++index)
      if (!done.contains({group.energy, index})) tasks.push_back({group, index});

  ProgressBar bar(command.output.quiet);
  const Progress progress = bar.callback();
  std::mutex mutex;
  std::size_t finished = 0;
  for_each_event(tasks.size(), command.run.threads, [&](std::size_t i, int threads) {
    const StudyRow row = study_event(settings, tasks[i].group, tasks[i].index, threads);
    if (journal) journal->append(to_json(row));
    const std::lock_guard lock(mutex);
    done[{row.energy, row.index}] = row;
    ++finished;
    if (progress)
      progress(double(finished) / double(tasks.size()),
               fmt::format("{} of {} events", finished, tasks.size()));
  });

  std::vector<StudyRow> rows;  // those that were asked for, in order
  for (const StudyGroup& group : settings.groups)
    for (int index = 0; index < group.events; ++index) rows.push_back(done.at({group.energy, index}));
  return rows;
}

Json table_json(const StudyTable& table) {
  Json lines = Json::array();
  for (const StudyLine& line : table.lines)
    lines.push_back({{"name", line.name},
                     {"unit", line.unit},
                     {"count", line.count},
                     {"bias", line.bias},
                     {"bias_error", line.bias_error},
                     {"median_error", line.median_error},
                     {"median_bound", line.median_bound},
                     {"median_scatter", line.median_scatter},
                     {"pull_mean", line.pull.mean},
                     {"pull_width", line.pull.width},
                     {"pull_width_error", line.pull.width_error},
                     {"pull_core", line.pull.core},
                     {"pull_core_error", line.pull.core_error},
                     {"coverage", line.pull.coverage},
                     {"coverage_error", line.pull.coverage_error}});
  return {{"title", table.title},         {"events", table.events}, {"fitted", table.fitted},
          {"contested", table.contested}, {"lines", lines},         {"failures", table.failures}};
}

Json chi_square_json(const StudyChiSquare& sum) {
  return {{"value", sum.value}, {"degrees", sum.degrees}, {"probability", sum.probability()}};
}

Json bias_json(const ModelBias& bias) {
  return {{"median_angle_deg", bias.median_angle / degree},
          {"mean_log_energy", bias.mean_log_energy},
          {"mean_log_energy_error", bias.mean_log_energy_error},
          {"chi_square",
           {{"direction", chi_square_json(bias.direction)},
            {"energy", chi_square_json(bias.energy)},
            {"all", chi_square_json(bias.all)}}}};
}

Json bias_json(const StudyBias& bias, const StudySettings& settings) {
  return {{"model", to_json(*settings.other)},
          {"events", bias.events},
          {"other", bias_json(bias.other)},
          {"truth", bias_json(bias.truth)},
          {"mean_delta_neg_llh", bias.mean_delta},
          {"mean_delta_neg_llh_error", bias.mean_delta_error},
          {"sum_delta_neg_llh", bias.sum_delta},
          {"sum_delta_neg_llh_error", bias.sum_delta_error},
          {"median_significance", bias.median_significance},
          {"least_significance", bias.least_significance}};
}

void run_study(const StudyCommand& command) {
  const std::optional<ResponseSettings> electronics = electronics_of(command);
  const StudySettings settings = settings_of(command, electronics);
  PlannedOutput json(command.output.json), picture(command.picture);
  std::unique_ptr<RowJournal> journal;
  if (command.rows)
    journal = std::make_unique<RowJournal>(*command.rows, heading_of(settings, electronics),
                                           RowJournal::Mismatch::error);
  const std::vector<StudyRow> rows = run_events(command, settings, journal.get());

  Json tables = Json::array();
  std::string text;
  const auto add_table = [&](std::span<const StudyRow> part, const std::string& title) {
    const StudyTable table = summarise(part, title);
    tables.push_back(table_json(table));
    text += text_of(table);
  };
  std::size_t first = 0;
  for (const StudyGroup& group : settings.groups) {
    const auto count = static_cast<std::size_t>(group.events);
    add_table(std::span(rows).subspan(first, count),
              fmt::format("{:g} GeV, oversize {:g}", group.energy, group.oversize));
    first += count;
  }
  if (settings.groups.size() > 1) add_table(rows, "all energies");
  Json results = {{"model", to_json(settings.truth)}, {"seed", settings.seed}, {"tables", tables}};
  if (settings.other) {
    const StudyBias bias = summarise_bias(rows);
    text += text_of(bias);
    results["other"] = bias_json(bias, settings);
  }
  json.write(json_text(results));
  if (command.picture)
    picture.write(
        figure_of_study(rows, fmt::format("{} cascades in {}", rows.size(), model_label(command.model))));
  json.commit();
  picture.commit();
  if (!command.output.quiet) fmt::print("{}", text);
}

}  // namespace

void add_study(CLI::App& floe) {
  CLI::App& app = *floe.add_subcommand("study", "Simulate and fit cascades: bias, errors, pulls, coverage");
  const auto command = std::make_shared<StudyCommand>();
  app.add_option("--group", command->groups,
                 "Contained cascades: energy [GeV], number, oversize of data and fit; may be repeated")
      ->type_name("ENERGY,EVENTS,OVERSIZE")
      ->allow_extra_args(false)
      ->capture_default_str();
  add_model_options(app, command->model);
  app.add_option("--fit-ice", command->fit_ice, "Fit with this ice, too")->type_name("DIR|south-pole");
  app.add_option("--fit-without", command->fit_without, "Fit without these effects, too; floe info --help")
      ->type_name("EFFECT,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_effect_settings(app, "--fit-with", "Fit with the ice changed like this, too; floe effects",
                      command->fit_with);
  add_number(app, "--effort", "X", {0, 1000, true}, "Multiplies the number of simulated photons",
             command->effort);
  app.add_flag("--pulses", command->pulses, "Fit what the electronics make of the photons (floe respond)");
  app.add_option("--response", command->response, "Likewise, with these settings; floe respond --help")
      ->type_name("FILE.toml");
  add_run_options(app, command->run);
  app.add_option("--rows", command->rows, "Keeps every event; the same command goes on where it was stopped")
      ->type_name("FILE.jsonl");
  add_picture(app, "-o,--picture", "Pulls and errors of all events", command->picture);
  add_output_options(app, command->output);
  app.footer(
      "Examples:\n"
      "  floe study --group 1000,4,20 --rows quick.jsonl --picture quick.svg\n"
      "  floe study --group 1e4,40,10 --group 1e5,40,20 --group 1e6,10,40 --rows study.jsonl\n"
      "  floe study --group 1e4,5,20 --fit-without birefringence --rows bias.jsonl\n"
      "  floe study --group 1000,4,20 --pulses --rows pulses.jsonl\n"
      "Positions and directions are drawn at random, at least 50 m inside the detector.\n"
      "Fits begin at the data, without the truth.");
  app.callback([command] { run_study(*command); });
}

}  // namespace floe
