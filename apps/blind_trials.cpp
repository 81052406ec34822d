// floe blind-trials: would the diagnosis have found it?
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/flasher_runs_file.h"
#include "apps/model_json.h"
#include "apps/option_values.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "apps/text_table.h"
#include "data/base/error.h"
#include "reco/diagnose/blind_trials.h"

namespace floe {

namespace {

struct BlindTrialsCommand {
  std::string runs;
  ModelRequest model;
  BlindTrialOptions options;
  SimulationSettings run;
  OutputOptions output;
};

struct Tally {
  int trials = 0, right = 0, silent = 0;
  std::map<std::string, int> wrong;  // what was named instead
};

std::map<std::string, Tally> tallies_of(const BlindTrials& trials) {
  std::map<std::string, Tally> tallies;
  for (const BlindTrial& trial : trials.trials) {
    Tally& tally = tallies[trial.hidden.effect.empty() ? "nothing" : trial.hidden.effect];
    ++tally.trials;
    if (trial.right())
      ++tally.right;
    else if (trial.named.empty())
      ++tally.silent;
    else
      ++tally.wrong[trial.named];
  }
  return tallies;
}

std::string all_names(const std::vector<std::string>& names) {
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

std::string hidden_names(const FullTrial& trial) {
  std::vector<std::string> names;
  for (const HiddenEffect& hidden : trial.hidden)
    if (!hidden.text.empty()) names.push_back(hidden.text);
  return all_names(names);
}

std::string full_trials(const BlindTrials& trials) {
  if (trials.full.empty()) return "";
  TextTable table({"hidden for a whole diagnosis", "verdict", "gap closed", ""});
  int right = 0, values = 0, within = 0;
  for (const FullTrial& trial : trials.full) {
    table.add({hidden_names(trial), all_names(trial.verdict), fmt::format("{:.0f}%", 100 * trial.closed),
               trial.right() ? "right" : "wrong"});
    right += trial.right();
    for (const FullTrial::Value& value : trial.values) {
      ++values;
      within += std::abs(value.found - value.hidden) < 2 * value.error;
    }
  }
  std::string text = table.str() + fmt::format("Right: {} of {}.\n", right, trials.full.size());
  if (values > 0) text += fmt::format("Fitted values within two errors: {} of {}.\n", within, values);
  return text;
}

std::string confusion(const BlindTrials& trials) {
  TextTable table({"hidden", "trials", "right", "silent", "named instead"});
  int right = 0, hidden = 0;
  for (const auto& [effect, tally] : tallies_of(trials)) {
    std::string wrong;
    for (const auto& [name, count] : tally.wrong)
      wrong +=
          fmt::format("{}{}{}", wrong.empty() ? "" : ", ", name, count > 1 ? fmt::format(" {}x", count) : "");
    table.add({effect, fmt::format("{}", tally.trials), fmt::format("{}", tally.right),
               fmt::format("{}", tally.silent), wrong});
    if (effect == "nothing") continue;
    right += tally.right, hidden += tally.trials;
  }
  std::string text = table.str();
  if (hidden > 0)
    text += fmt::format("Right name or group: {} of {} ({:.0f}%).\n", right, hidden, 100.0 * right / hidden);
  for (const auto& [effect, why] : trials.not_tried) text += fmt::format("{}: {}\n", effect, why);
  return text;
}

// Strengths that would have been seen, and how well those that were are known.
std::string power(const BlindTrials& trials) {
  TextTable table({"would have been seen above", "change", "unit"});
  for (const SeenAbove& seen : trials.power)
    table.add({seen.parameter, fmt::format("{:.3g}", seen.change), seen.unit});
  int values = 0, within = 0;
  for (const BlindTrial& trial : trials.trials)
    for (std::size_t i = 0; i < trial.found.size(); ++i) {
      ++values;
      within += std::abs(trial.found[i] - trial.hidden.values[i].second) < 2 * trial.errors[i];
    }
  std::string text = trials.power.empty() ? "" : table.str();
  if (values > 0) text += fmt::format("Values within two errors: {} of {}.\n", within, values);
  return text;
}

Json power_json(const BlindTrials& trials) {
  Json json = Json::array();
  for (const SeenAbove& seen : trials.power)
    json.push_back({{"effect", seen.effect},
                    {"parameter", seen.parameter},
                    {"seen_above", seen.change},
                    {"unit", seen.unit}});
  return json;
}

Json trial_json(const BlindTrial& trial) {
  Json values = Json::object();
  for (const auto& [name, value] : trial.hidden.values) values[name] = value;
  return {{"hidden", trial.hidden.effect},
          {"hidden_text", trial.hidden.text},
          {"hidden_values", values},
          {"expected_significance", trial.hidden.significance},
          {"p_value", trial.p_value},
          {"named", trial.named},
          {"named_text", trial.named_text},
          {"group", trial.group},
          {"significance", trial.significance},
          {"found", trial.found},
          {"errors", trial.errors},
          {"right", trial.right()}};
}

Json full_json(const FullTrial& trial) {
  Json json = {{"hidden", Json::array()},  {"outside", trial.outside}, {"verdict", trial.verdict},
               {"groups", trial.groups},   {"values", Json::array()},  {"closed", trial.closed},
               {"seconds", trial.seconds}, {"right", trial.right()}};
  for (const HiddenEffect& hidden : trial.hidden)
    json["hidden"].push_back({{"effect", hidden.effect}, {"text", hidden.text}});
  for (const FullTrial::Value& value : trial.values)
    json["values"].push_back(
        {{"name", value.name}, {"hidden", value.hidden}, {"found", value.found}, {"error", value.error}});
  return json;
}

// A run of many flashes has their light together.
std::vector<FlasherRun> runs_of(const std::string& file) {
  std::vector<FlasherRun> runs;
  for (const RunToSimulate& run : read_flasher_runs(file)) {
    if (run.beam || run.pulse)
      throw InputError({file},
                       fmt::format("a measured {} of {},{}", run.beam ? "beam" : "pulse",
                                   run.run.module.string, run.run.module.dom),
                       "widths of beam and pulse, which are all that trials simulate");
    runs.push_back(run.run);
    runs.back().photons *= run.repeats;
  }
  return runs;
}

void run_trials(const BlindTrialsCommand& command) {
  BlindTrialOptions options = command.options;
  options.seed = command.run.seed;
  options.threads = command.run.threads;
  options.oversize = command.run.oversize;
  PlannedOutput json(command.output.json);
  const Model base = load_model(command.model);
  const std::vector<FlasherRun> runs = runs_of(command.runs);
  BlindTrials trials;
  {
    ProgressBar bar(command.output.quiet);
    trials = run_blind_trials(base, runs, options, bar.callback());
  }
  Json result = {
      {"version", FLOE_VERSION},   {"base", to_json(command.model)}, {"base_model", to_json(base)},
      {"runs", command.runs},      {"seed", options.seed},           {"alpha", options.alpha},
      {"seconds", trials.seconds}, {"trials", Json::array()},        {"power", power_json(trials)}};
  for (const BlindTrial& trial : trials.trials) result["trials"].push_back(trial_json(trial));
  result["full"] = Json::array();
  for (const FullTrial& trial : trials.full) result["full"].push_back(full_json(trial));
  json.write(json_text(result));
  json.commit();
  if (!command.output.quiet)
    fmt::print("{}{}{}{:.0f} s\n", confusion(trials), power(trials), full_trials(trials), trials.seconds);
}

}  // namespace

void add_blind_trials(CLI::App& floe) {
  CLI::App& app = *floe.add_subcommand(
      "blind-trials", "Hide effects at random in simulated light and see whether the diagnosis names them");
  const auto command = std::make_shared<BlindTrialsCommand>();
  command->options.light = {2, 1e3, 2e11};
  command->run.oversize = command->options.oversize;
  app.add_option("runs", command->runs,
                 "Flasher runs to simulate, as for floe simulate --flashers, without measured curves")
      ->type_name("RUNS.toml")
      ->required();
  add_model_options(app, command->model);
  const auto add_count = [&](const char* name, int most, const char* help, int& number) {
    add_integer(app, name, 0, most, help, [&number](std::int64_t given) {
      number = static_cast<int>(given);
    })->default_str(fmt::format("{}", number));
  };
  BlindTrialOptions& options = command->options;
  add_count("--trials", 1000, "Trials of each effect", options.trials);
  add_count("--nothing", 10000, "Trials with nothing missing", options.nothing);
  add_count("--full", 10000, "Whole diagnoses of effects that the trials hid, of as many kinds as possible",
            options.full);
  add_count("--full-nothing", 10000, "Whole diagnoses with nothing missing", options.full_nothing);
  add_count("--pairs", 10000, "Whole diagnoses of two effects hidden together", options.pairs);
  add_count("--outside", 10000, "Whole diagnoses of effects that the catalogue does not have",
            options.outside);
  add_number(app, "--least", "SIGMA", {0.1, 1000},
             "Expected significance of what is hidden, places counted, at least", command->options.least);
  add_number(app, "--most", "SIGMA", {0.1, 1000},
             "Expected significance of what is hidden, places counted, at most", command->options.most);
  add_number(app, "--alpha", "P", {1e-6, 0.5}, "Probability of naming anything when nothing is missing",
             command->options.alpha);
  add_number(app, "--light", "RATIO", {0.1, 1000}, "Simulated light, in units of the data's",
             command->options.light.light);
  add_simulation_options(app, command->run);
  add_output_options(app, command->output);
  app.footer(
      "Examples:\n"
      "  floe blind-trials runs.toml --trials 1 --nothing 5\n"
      "  floe blind-trials runs.toml --ice my-ice --least 3 --most 8 --json trials.json\n"
      "  floe blind-trials runs.toml --full 5 --pairs 2 --outside 4\n"
      "A whole diagnosis takes as long as floe diagnose does.");
  app.callback([command] { run_trials(*command); });
}

}  // namespace floe
