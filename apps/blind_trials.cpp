// floe blind-trials: would the diagnosis have found it?
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "apps/blind_trial_rows.h"
#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/flasher_runs_file.h"
#include "apps/model_json.h"
#include "apps/option_values.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "apps/row_journal.h"
#include "apps/text_table.h"
#include "data/base/error.h"
#include "propagation/model_hash.h"
#include "reco/diagnose/blind_trials.h"

namespace floe {

namespace {

struct BlindTrialsCommand {
  std::string runs;
  ModelRequest model;
  BlindTrialOptions options;
  std::optional<std::string> rows, sealed;
  SimulationSettings run;
  OutputOptions output;
};

struct Tally {
  int trials = 0, right = 0, silent = 0;
  std::map<std::string, int> wrong;  // what was named instead
};

// How often fitted values are within two errors of what was hidden.
class Coverage {
 public:
  void add(double found, double error, double hidden) {
    ++values_;
    within_ += std::abs(found - hidden) < 2 * error;
  }
  std::string text(const char* values) const {
    return values_ == 0 ? "" : fmt::format("{} within two errors: {} of {}.\n", values, within_, values_);
  }

 private:
  int values_ = 0, within_ = 0;
};

std::map<std::string, Tally> tallies_of(const BlindTrials& trials) {
  std::map<std::string, Tally> tallies;
  for (const BlindTrial& trial : trials.trials) {
    Tally& tally = tallies[trial.hidden.effect.empty() ? "nothing" : trial.hidden.effect];
    ++tally.trials;
    if (trial.right())
      ++tally.right;
    else if (trial.named.effect.empty())
      ++tally.silent;
    else
      ++tally.wrong[trial.named.effect];
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

// Of what was named with its place, and "unexplained".
std::string verdict_of(const FullTrial& trial) {
  std::vector<std::string> names;
  for (const NamedInTrial& named : trial.named) names.push_back(named.text);
  if (!trial.verdict.empty() && trial.verdict.back() == "unexplained") names.push_back("unexplained");
  return all_names(names);
}

const char* outcome_of(const FullTrial& trial) {
  if (!trial.right()) return "wrong";
  if (trial.elsewhere()) return "right, elsewhere";
  return trial.named_as_well() ? "right, but named" : "right";
}

// What a whole trial is a trial of.
const char* class_of(const FullTrial& trial) {
  if (trial.outside) return "Outside of the catalogue";
  if (trial.hidden.size() > 1) return "Two effects";
  return trial.hidden.front().effect.empty() ? "Nothing missing" : "One effect";
}

// Zero is added for what rounds to minus zero.
std::string closed_of(const FullTrial& trial) {
  return trial.closed ? fmt::format("{:.0f}%", std::round(100 * *trial.closed) + 0.0) : "hardly any gap";
}

std::string full_trials(const BlindTrials& trials) {
  if (trials.full.empty()) return "";
  TextTable table({"hidden for a whole diagnosis", "verdict", "gap closed", ""});
  std::map<std::string, Tally> classes;
  Coverage coverage;
  int elsewhere = 0, named = 0;
  for (const FullTrial& trial : trials.full) {
    table.add({hidden_names(trial), verdict_of(trial), closed_of(trial), outcome_of(trial)});
    Tally& tally = classes[class_of(trial)];
    ++tally.trials, tally.right += trial.right();
    elsewhere += trial.right() && trial.elsewhere();
    named += trial.named_as_well();
    for (const FullTrial::Value& value : trial.values) coverage.add(value.found, value.error, value.hidden);
  }
  std::string text = table.str();
  for (const auto& [name, tally] : classes)
    text += fmt::format("{}: {} of {} right.\n", name, tally.right, tally.trials);
  text +=
      fmt::format("{} right ones at another place, {} unexplained but with a name, too.\n", elsewhere, named);
  return text + coverage.text("Fitted values");
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
  std::string text = trials.trials.empty() ? "" : table.str();
  if (hidden > 0)
    text += fmt::format("Right name or group: {} of {} ({:.0f}%).\n", right, hidden, 100.0 * right / hidden);
  for (const auto& [effect, why] : trials.not_tried) text += fmt::format("{}: {}\n", effect, why);
  for (const std::string& remark : trials.remarks) text += remark + ".\n";
  return text;
}

// Share of what was hidden that was named, by expected significance.
std::string named_by_strength(const BlindTrials& trials) {
  constexpr double edges[] = {0, 2, 3, 4, 5, 6, 8, 10, 15, 1e9};
  TextTable table({"hidden with [sigma]", "trials", "anything named", "right"});
  bool any = false;
  for (std::size_t i = 0; i + 1 < std::size(edges); ++i) {
    int count = 0, named = 0, right = 0;
    for (const BlindTrial& trial : trials.trials) {
      const double sigma = trial.hidden.significance;
      if (trial.hidden.effect.empty() || sigma < edges[i] || sigma >= edges[i + 1]) continue;
      ++count, named += !trial.named.effect.empty(), right += trial.right();
    }
    if (count == 0) continue;
    any = true;
    table.add({edges[i + 1] > 1e8 ? fmt::format("above {:g}", edges[i])
                                  : fmt::format("{:g}-{:g}", edges[i], edges[i + 1]),
               fmt::format("{}", count), fmt::format("{}", named), fmt::format("{}", right)});
  }
  return any ? table.str() : "";
}

// Strengths that would have been seen, and how well those that were are known.
std::string power(const BlindTrials& trials) {
  TextTable table({"would have been seen above", "change", "unit"});
  for (const SeenAbove& seen : trials.power)
    table.add({seen.parameter, fmt::format("{:.3g}", seen.change), seen.unit});
  Coverage coverage;
  for (const BlindTrial& trial : trials.trials)
    for (std::size_t i = 0; i < trial.found.size(); ++i)
      coverage.add(trial.found[i], trial.errors[i], trial.hidden.values[i].second);
  return (trials.power.empty() ? "" : table.str()) + coverage.text("Values");
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

std::vector<RunOfTrials> runs_of(const std::string& file) {
  std::vector<RunOfTrials> runs;
  for (const RunToSimulate& run : read_flasher_runs(file)) {
    if (run.beam || run.pulse)
      throw InputError({file},
                       fmt::format("a measured {} of {},{}", run.beam ? "beam" : "pulse",
                                   run.run.module.string, run.run.module.dom),
                       "widths of beam and pulse, which are all that trials simulate");
    RunOfTrials trial{run.run, static_cast<double>(run.repeats)};
    trial.run.photons *= run.simulated_share();
    runs.push_back(trial);
  }
  return runs;
}

// All that trials depend on.
Json heading_of(const Model& base, const std::vector<RunOfTrials>& runs, const BlindTrialOptions& options) {
  Json flashers = Json::array();
  for (const auto& [run, repeats] : runs)
    flashers.push_back({run.module.string, run.module.dom, name_of(run.leds), run.orientation, run.wavelength,
                        run.beam_width, run.pulse_width, run.photons, repeats});
  Json heading = {{"journal", "floe blind-trials"},
                  {"version", FLOE_VERSION},
                  {"diagnosis", diagnosis_revision},
                  {"seed", options.seed},
                  {"effects", options.effects},
                  {"trials", options.trials},
                  {"nothing", options.nothing},
                  {"full", {options.full, options.full_nothing, options.pairs, options.outside}},
                  {"least", options.significance.least},
                  {"most", options.significance.most},
                  {"alpha", options.alpha},
                  {"light", options.light.light},
                  {"oversize", options.oversize},
                  {"model", model_hash(base)},
                  {"runs", flashers}};
  if (options.full_least_hits) heading["full_least_hits"] = *options.full_least_hits;
  return heading;
}

BlindTrials run_resumable(const BlindTrialsCommand& command, const Model& base,
                          const std::vector<RunOfTrials>& runs, const BlindTrialOptions& options) {
  TrialRecord record;
  std::unique_ptr<RowJournal> journal;
  if (command.rows) {
    journal = std::make_unique<RowJournal>(*command.rows, heading_of(base, runs, options),
                                           RowJournal::Mismatch::error);
    for (const Json& row : journal->rows())
      if (row.contains("outside"))
        record.full.push_back(full_trial_of(row));
      else
        record.trials.push_back(blind_trial_of(row));
    record.keep_trial = [&](const BlindTrial& trial) { journal->append(to_json(trial)); };
    record.keep_full = [&](const FullTrial& trial) { journal->append(to_json(trial)); };
  }
  PlannedOutput sealed(command.sealed);
  record.seal = [&](std::span<const HiddenEffect> trials, std::span<const std::vector<HiddenEffect>> full) {
    sealed.write(json_text(sealed_json(trials, full)));
    sealed.commit();
  };
  ProgressBar bar(command.output.quiet);
  return run_blind_trials(base, runs, options, bar.callback(), record);
}

void run_trials(const BlindTrialsCommand& command) {
  BlindTrialOptions options = command.options;
  options.seed = command.run.seed;
  options.threads = command.run.threads;
  options.oversize = command.run.oversize;
  PlannedOutput json(command.output.json);
  const Model base = load_model(command.model);
  const std::vector<RunOfTrials> runs = runs_of(command.runs);
  const BlindTrials trials = run_resumable(command, base, runs, options);
  Json result = {
      {"version", FLOE_VERSION},   {"base", to_json(command.model)}, {"base_model", to_json(base)},
      {"runs", command.runs},      {"seed", options.seed},           {"alpha", options.alpha},
      {"seconds", trials.seconds}, {"trials", Json::array()},        {"power", power_json(trials)}};
  for (const BlindTrial& trial : trials.trials) result["trials"].push_back(to_json(trial));
  result["full"] = Json::array();
  for (const FullTrial& trial : trials.full) result["full"].push_back(to_json(trial));
  result["not_tried"] = trials.not_tried, result["remarks"] = trials.remarks;
  json.write(json_text(result));
  json.commit();
  if (!command.output.quiet)
    fmt::print("{}{}{}{}{:.0f} s\n", confusion(trials), named_by_strength(trials), power(trials),
               full_trials(trials), trials.seconds);
}

}  // namespace

void add_blind_trials(CLI::App& floe) {
  CLI::App& app = *floe.add_subcommand(
      "blind-trials", "Hide effects at random in simulated light and see whether the diagnosis names them");
  const auto command = std::make_shared<BlindTrialsCommand>();
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
  app.add_option("--effects", options.effects, "Effects to hide; all if none is named")
      ->type_name("EFFECT,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_count("--trials", 1000, "Trials of each effect", options.trials);
  add_count("--nothing", 10000, "Trials with nothing missing", options.nothing);
  add_count("--full", 10000, "Whole diagnoses of effects that the trials hid, of as many kinds as possible",
            options.full);
  add_count("--full-nothing", 10000, "Whole diagnoses with nothing missing", options.full_nothing);
  add_count("--pairs", 10000, "Whole diagnoses of two effects hidden together", options.pairs);
  add_count("--outside", 10000, "Whole diagnoses of effects that the catalogue does not have",
            options.outside);
  add_number(app, "--least", "SIGMA", {0.1, 1000},
             "Expected significance of what is hidden, places counted, at least",
             command->options.significance.least);
  add_number(app, "--most", "SIGMA", {0.1, 1000},
             "Expected significance of what is hidden, places counted, at most",
             command->options.significance.most);
  add_number(app, "--alpha", "P", {1e-6, 0.5}, "Probability of naming anything when nothing is missing",
             command->options.alpha);
  add_number(
      app, "--light", "RATIO", {0.1, 1000},
      "Simulated light of the survey, in units of the data's; whole diagnoses have that of floe diagnose",
      command->options.light.light);
  add_number(app, "--least-hits", "N", {100, 1e8},
             "Simulated hits of a run in whole diagnoses, at least; as floe diagnose if not named",
             [&options](double hits) { options.full_least_hits = hits; });
  app.add_option("--rows", command->rows, "Keeps every trial; the same command goes on where it was stopped")
      ->type_name("FILE.jsonl");
  app.add_option("--sealed", command->sealed, "What is hidden, written before anything is asked")
      ->type_name("FILE.json");
  add_simulation_options(app, command->run);
  add_output_options(app, command->output);
  app.footer(
      "Examples:\n"
      "  floe blind-trials runs.toml --trials 1 --nothing 5\n"
      "  floe blind-trials runs.toml --ice my-ice --least 3 --most 8 --json trials.json\n"
      "  floe blind-trials runs.toml --effects tilt,noise --trials 5 --nothing 0\n"
      "  floe blind-trials runs.toml --full 5 --pairs 2 --outside 4 --rows trials.jsonl\n"
      "A whole diagnosis takes as long as floe diagnose does.");
  app.callback([command] { say_why_no_result(command->output.json, [&] { run_trials(*command); }); });
}

}  // namespace floe
