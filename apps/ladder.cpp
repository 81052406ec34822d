// floe ladder: which description of the ice's anisotropy do flasher data want?
#include <fmt/format.h>

#include <memory>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/flasher_input.h"
#include "apps/model_json.h"
#include "apps/option_values.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "apps/text_table.h"
#include "reco/ice_fit/ladder.h"

namespace floe {

namespace {

struct LadderCommand {
  std::string data;
  ModelRequest model;
  LadderOptions options;
  SimulationSettings run;
  OutputOptions output;
};

std::string parameters_text(const IceFit& fit) {
  std::string text;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    text += fmt::format("{}{} {:.3f} +- {:.3f}", text.empty() ? "" : ", ", fit.parameters[i].name,
                        fit.value(i), fit.error(i));
  return text;
}

std::string ladder_table(const Ladder& ladder) {
  TextTable table({"model", "-ln L", "held out", "worse by"});
  for (std::size_t i = 0; i < ladder.rungs.size(); ++i) {
    const LadderRung& rung = ladder.rungs[i];
    const Ladder::Gap gap = ladder.gap(i);
    table.add({rung.name, fmt::format("{:.1f}", rung.fit.neg_llh), fmt::format("{:.1f}", rung.total()),
               i == ladder.best() ? "best" : fmt::format("{:.1f} +- {:.1f}", gap.value, gap.error)});
  }
  std::string text = table.str();
  for (const LadderRung& rung : ladder.rungs)
    text += fmt::format("{}: {}\n", rung.name, parameters_text(rung.fit));
  return text;
}

Json rung_json(const Ladder& ladder, std::size_t i) {
  const LadderRung& rung = ladder.rungs[i];
  Json json = {{"model", rung.name},
               {"neg_llh", rung.fit.neg_llh},
               {"bins", rung.fit.bins},
               {"converged", rung.fit.converged},
               {"held_out_neg_llh", rung.total()},
               {"worse_by", ladder.gap(i).value},
               {"worse_by_error", ladder.gap(i).error},
               {"held_out_of_runs", rung.held_out},
               {"parameters", Json::array()}};
  for (std::size_t k = 0; k < rung.fit.parameters.size(); ++k)
    json["parameters"].push_back(
        {{"name", rung.fit.parameters[k].name}, {"value", rung.fit.value(k)}, {"error", rung.fit.error(k)}});
  return json;
}

void run_ladder(const LadderCommand& command) {
  LadderOptions options = command.options;
  options.fit.seed = command.run.seed;
  options.fit.threads = command.run.threads;
  PlannedOutput json(command.output.json);
  const std::vector<Event> events = read_flasher_file(command.data);
  options.fit.oversize = oversize_for(events, command.run);
  const Model base = load_model(command.model);
  const FlasherData data = flasher_data(*base.detector, events);
  Ladder ladder;
  {
    ProgressBar bar(command.output.quiet);
    ladder = climb_ladder(base, data, options, bar.callback());
  }
  Json result = {{"version", FLOE_VERSION},     {"base", to_json(command.model)},
                 {"base_model", to_json(base)}, {"data", command.data},
                 {"left_out", ladder.left_out}, {"seed", options.fit.seed},
                 {"runs", ladder.runs},         {"best", ladder.rungs[ladder.best()].name},
                 {"models", Json::array()}};
  for (std::size_t i = 0; i < ladder.rungs.size(); ++i) result["models"].push_back(rung_json(ladder, i));
  json.write(json_text(result));
  json.commit();
  if (command.output.quiet) return;
  for (const std::string& sentence : ladder.left_out) fmt::print("left out: {}\n", sentence);
  fmt::print("{}", ladder_table(ladder));
}

}  // namespace

void add_ladder(CLI::App& floe) {
  CLI::App& app = *floe.add_subcommand(
      "ladder",
      "Refit isotropic, anisotropic and birefringent ice to flasher data and compare them on runs held out");
  const auto command = std::make_shared<LadderCommand>();
  command->run.oversize = command->options.fit.oversize;
  app.add_option("data", command->data, flasher_data_description)->type_name("DATA")->required();
  add_model_options(app, command->model);
  add_integer(
      app, "--folds", 2, 1000, "Groups of runs, each of which is held out once",
      [command = command.get()](std::int64_t folds) { command->options.folds = static_cast<int>(folds); })
      ->default_str("2");
  add_number(app, "--light", "RATIO", {0.1, 1000}, "Simulated light, in units of the data's",
             command->options.fit.light.light);
  add_number(app, "--least-hits", "N", {100, 1e8}, "Simulated hits of a run, at least",
             command->options.fit.light.least_hits);
  add_number(app, "--model-error", "SIGMA", {0, 1},
             "Relative error of the simulation that likelihoods allow for", command->options.fit.model_error);
  add_simulation_options(app, command->run);
  add_output_options(app, command->output);
  app.footer(
      "Examples:\n"
      "  floe ladder runs.h5 --ice my-ice\n"
      "  floe ladder runs.h5 --ice my-ice --folds 3 --light 10 --json ladder.json");
  app.callback([command] { say_why_no_result(command->output.json, [&] { run_ladder(*command); }); });
}

}  // namespace floe
