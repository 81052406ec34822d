// floe diagnose: what is a model of the ice missing?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <system_error>

#include "apps/command_line.h"
#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/flasher_input.h"
#include "apps/improved_ice.h"
#include "apps/model_json.h"
#include "apps/option_values.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "apps/text_table.h"
#include "data/base/atomic_file.h"
#include "data/base/atomic_folder.h"
#include "reco/diagnose/diagnosis.h"
#include "reco/diagnose/report.h"

namespace floe {

namespace {

struct DiagnoseCommand {
  std::string data, folder, command;
  ModelRequest model;
  DiagnosisOptions options;
  SimulationSettings run;
  OutputOptions output;
};

// No light would separate: null.
Json separation_json(const Separation& separation) {
  return {{"effect", separation.effect},
          {"other", separation.other},
          {"light", std::isfinite(separation.light) ? Json(separation.light) : Json()},
          {"run", separation.run},
          {"sentence", separation.sentence}};
}

// "factor" of "absorption-scale.factor": value, error, unit.
Json values_json(const std::vector<IceParameter>& parameters, const std::vector<double>& values,
                 const std::vector<double>& errors) {
  Json json = Json::object();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& name = parameters[i].name;
    json[name.substr(name.find('.') + 1)] = {
        {"value", values[i]}, {"error", errors[i]}, {"unit", parameters[i].unit}};
  }
  return json;
}

Json effect_json(const NamedEffect& effect) {
  Json parameters = values_json(effect.parameters, effect.values, effect.errors);
  if (effect.mean)
    parameters[effect.mean->name] = {
        {"value", effect.mean->value}, {"error", effect.mean->error}, {"unit", ""}};
  for (const auto& [name, value] : effect.suspect.place)
    if (!parameters.contains(name)) parameters[name] = {{"value", value}, {"error", 0.0}, {"unit", ""}};
  Json separations = Json::array();
  for (const Separation& separation : effect.separations) separations.push_back(separation_json(separation));
  return {{"name", effect.suspect.effect},
          {"parameters", parameters},
          {"significance", effect.significance},
          {"group", effect.group},
          {"separations", separations}};
}

Json region_json(const Region& region) {
  Json json = {
      {"axis", region.axis},        {"from", region.from},         {"to", region.to},
      {"sign", region.sign},        {"relative", region.relative}, {"significance", region.significance},
      {"sentence", region.sentence}};
  if (!region.name.empty()) json["name"] = region.name;
  return json;
}

Json step_json(const DiagnosisStep& step) {
  Json json = {{"neg_llh", step.neg_llh},
               {"expected_neg_llh", step.expected},
               {"scatter", step.scatter},
               {"p_of_fit", step.p_of_fit},
               {"p_of_scores", step.scores.p_value},
               {"scores", Json::array()},
               {"fits", Json::array()},
               {"where", Json::array()}};
  for (const EffectScore& effect : step.scores.effects)
    json["scores"].push_back({{"effect", effect.best.suspect.effect},
                              {"place", effect.best.suspect.place},
                              {"gain", effect.best.gain},
                              {"significance", sigmas_of(effect.ln_p)},
                              {"changes_light_by", effect.best.size},
                              {"likeness_to_first", effect.likeness}});
  json["likeness"] = Json::array();  // of the first few scores, with each other
  for (Eigen::Index i = 0; i < step.scores.likeness.rows(); ++i) {
    const Eigen::VectorXd row = step.scores.likeness.row(i);
    json["likeness"].push_back(std::vector<double>(row.begin(), row.end()));
  }
  for (const Trial& trial : step.trials) {
    json["fits"].push_back({{"effect", trial.suspect.effect},
                            {"place", trial.suspect.place},
                            {"parameters", values_json(trial.parameters, trial.values, trial.errors)},
                            {"neg_llh", trial.neg_llh},
                            {"chi_square", trial.chi_square}});
    if (trial.lost)
      json["fits"].back()["lost"] = {{"winner_adds", trial.lost->winner}, {"adds", trial.lost->loser}};
  }
  for (const Region& region : step.where.regions) json["where"].push_back(region_json(region));
  return json;
}

Json diagnosis_json(const Diagnosis& diagnosis, const DiagnoseCommand& command, const Model& base) {
  Json json = {{"command", command.command},
               {"version", FLOE_VERSION},
               {"base", to_json(command.model)},
               {"base_model", to_json(base)},
               {"improved_model", to_json(diagnosis.improved)},
               {"data", command.data},
               {"seed", command.options.seed},
               {"oversize", command.options.oversize},
               {"left_out", diagnosis.left_out},
               {"not_tested", diagnosis.not_tested},
               {"remarks", diagnosis.remarks},
               {"verdict", diagnosis.verdict},
               {"why_unexplained", diagnosis.why_unexplained},
               {"groups", Json::object()},
               {"where", Json::array()},
               {"effects", Json::array()},
               {"p_value", diagnosis.p_value},
               {"alpha", command.options.alpha},
               {"floor", command.options.floor},
               {"p_of_rest", diagnosis.p_of_rest ? Json(*diagnosis.p_of_rest) : Json()},
               {"gap_before", diagnosis.gap_before},
               {"gap_after", diagnosis.gap_after},
               {"gap_scatter", diagnosis.gap_scatter},
               {"gap_unknown", diagnosis.gap_unknown},
               {"closed", diagnosis.closed()},
               {"folds", diagnosis.folds},
               {"gaps", Json::array()},
               {"steps", Json::array()},
               {"seconds", diagnosis.seconds}};
  for (const NamedEffect& effect : diagnosis.effects) {
    json["effects"].push_back(effect_json(effect));
    // Two strings may have the same effect: what either cannot be told from.
    Json& group = json["groups"][effect.suspect.effect];
    for (const std::string& other : effect.group)
      if (std::find(group.begin(), group.end(), other) == group.end()) group.push_back(other);
  }
  for (const Region& region : diagnosis.steps.front().where.regions)
    json["where"].push_back(region_json(region));
  for (const RunGap& run : diagnosis.gaps)
    json["gaps"].push_back({{"run", run.run}, {"before", run.before}, {"after", run.after}});
  for (const DiagnosisStep& step : diagnosis.steps) json["steps"].push_back(step_json(step));
  return json;
}

std::string summary(const Diagnosis& diagnosis, const DiagnoseCommand& command) {
  std::string text;
  for (const std::string& sentence : diagnosis.left_out) text += "left out: " + sentence + "\n";
  text += verdict_sentence(diagnosis, command.options.alpha) + "\n";
  const std::vector<Region>& regions = diagnosis.steps.front().where.regions;
  constexpr double clear = 3;  // standard deviations
  if (!diagnosis.verdict.empty() && !regions.empty() && regions.front().significance > clear)
    text += regions.front().sentence + "\n";
  TextTable table({"effect", "parameter", "fitted", "error", "unit"});
  for (const NamedEffect& effect : diagnosis.effects) {
    if (effect.mean)
      table.add({"", effect.mean->name + ", mean", fmt::format("{:.3f}", effect.mean->value),
                 fmt::format("{:.3f}", effect.mean->error), ""});
    for (std::size_t i = 0; i < effect.values.size(); ++i)
      table.add({i == 0 ? text_of(effect.suspect) : "", effect.parameters[i].name,
                 fmt::format("{:.3f}", effect.values[i]), fmt::format("{:.3f}", effect.errors[i]),
                 effect.parameters[i].unit});
  }
  if (!diagnosis.effects.empty()) text += table.str();
  for (const NamedEffect& effect : diagnosis.effects)
    for (const Separation& separation : effect.separations) text += separation.sentence + "\n";
  for (const std::string& remark : diagnosis.remarks) text += remark + "\n";
  return text + fmt::format("Gap in {}: {:.1f} before, {:.1f} after ({:.0f} s).\n", judged_runs(diagnosis),
                            diagnosis.gap_before, diagnosis.gap_after, diagnosis.seconds);
}

std::string changes_text(const Diagnosis& diagnosis, const DiagnoseCommand& command, const Model& base) {
  return fmt::format("Ice model made by floe {} from {} ({}), diagnosed with {}.\n{}\n\n{}", FLOE_VERSION,
                     command.model.ice, base.ice->hash(), command.data, command.command,
                     summary(diagnosis, command));
}

// What an ice directory does not hold has to be said again.
std::string command_to_look_again(const DiagnoseCommand& command) {
  std::vector<std::string> words = {"floe", "diagnose", command.data, "--ice",
                                    (std::filesystem::path(command.folder) / improved_ice_folder).string()};
  const auto add = [&](const std::string& option, const std::string& value) {
    words.push_back(option), words.push_back(value);
  };
  const bool is_built_in = !std::filesystem::is_directory(command.model.ice);
  if (command.model.detector || is_built_in) add("--detector", command.model.detector.value_or("ic86"));
  for (const std::string& effect : command.model.without)
    if (effect == "cable-shadow") add("--without", effect);
  if (command.run.oversize_given) add("--oversize", fmt::format("{:g}", command.run.oversize));
  add("-o", "again");
  return quoted_command(words);
}

void run_diagnose(const DiagnoseCommand& given) {
  DiagnoseCommand command = given;
  command.options.seed = command.run.seed;
  command.options.threads = command.run.threads;
  AtomicFolder folder(command.folder);
  PlannedOutput json(command.output.json);
  const std::vector<Event> events = read_flasher_file(command.data);
  command.options.oversize = oversize_for(events, command.run);
  const Model base = load_model(command.model);
  expect_writable(base.ice->tables());
  const std::filesystem::path improved = folder.temporary() / improved_ice_folder;
  copy_base_ice(command.model, improved);
  const FlasherData data = flasher_data(*base.detector, events);
  command.options.folds = std::min(command.options.folds, flasher_count(data));
  Diagnosis diagnosis;
  {
    ProgressBar bar(command.output.quiet);
    diagnosis = diagnose(base, data, command.options, bar.callback());
  }
  const std::string result = json_text(diagnosis_json(diagnosis, command, base));
  const std::filesystem::path ice = command.model.ice;
  const ReportFacts facts{command.data,
                          (ice.has_filename() ? ice : ice.parent_path()).filename().string(),
                          command.command,
                          FLOE_VERSION,
                          base.ice->hash(),
                          diagnosis.improved.ice->hash(),
                          command_to_look_again(command),
                          base.ice->flow_azimuth() / degree,
                          command.run.seed};
  write_whole_file(folder.temporary() / "result.json", result);
  write_whole_file(folder.temporary() / "report.html", report_html(diagnosis, command.options, facts));
  write_improved_ice(command.model, diagnosis.improved, diagnosis.beside_ice,
                     changes_text(diagnosis, command, base), improved);
  json.write(result);
  json.commit();
  folder.commit();
  if (!command.output.quiet)
    fmt::print("{}The report is {}/report.html, the improved ice model {}/improved-ice\n",
               summary(diagnosis, command), command.folder, command.folder);
}

}  // namespace

void add_diagnose(CLI::App& floe, const std::string& command_line) {
  CLI::App& app = *floe.add_subcommand(
      "diagnose", "Find where an ice model and flasher data disagree, and which effect is missing");
  const auto command = std::make_shared<DiagnoseCommand>();
  command->command = command_line;
  command->run.oversize = command->options.oversize;
  app.add_option("data", command->data, flasher_data_description)->type_name("DATA")->required();
  app.add_option("-o,--output", command->folder, "New folder for the result")->type_name("DIR")->required();
  add_model_options(app, command->model);
  add_number(app, "--alpha", "P", {1e-6, 0.5}, "Probability of naming anything when nothing is missing",
             command->options.alpha);
  add_number(app, "--floor", "SHARE", {0, 0.5},
             "Changes of light that are not told from differences between programs", command->options.floor);
  add_integer(
      app, "--folds", 1, 1000, "Groups of runs, each of which is held out once; 1: none is",
      [command = command.get()](std::int64_t folds) { command->options.folds = static_cast<int>(folds); })
      ->default_str("3");
  add_number(app, "--light", "RATIO", {0.1, 1000}, "Simulated light, in units of the data's",
             command->options.light.light);
  add_number(app, "--least-hits", "N", {100, 1e8}, "Simulated hits of a run, at least",
             command->options.light.least_hits);
  add_number(app, "--model-error", "SIGMA", {0, 1},
             "Relative error of the simulation, bin by bin, that likelihoods allow for",
             command->options.model_error);
  add_simulation_options(app, command->run);
  add_output_options(app, command->output);
  app.footer(
      "Examples:\n"
      "  floe diagnose runs.h5 --ice my-ice -o diagnosis\n"
      "  floe diagnose runs.h5 --ice my-ice -o diagnosis --light 5 --floor 0.01 --json result.json");
  app.callback([command] { say_why_no_result(command->output.json, [&] { run_diagnose(*command); }); });
}

}  // namespace floe
