// floe figures: the paper's figures from floe's own runs.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/model_json.h"
#include "apps/option_values.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "apps/text_table.h"
#include "data/base/atomic_file.h"
#include "data/base/atomic_folder.h"
#include "data/base/error.h"
#include "reco/paper_figures/catalogue.h"

namespace floe {

namespace {

struct FiguresCommand {
  std::string folder, command;
  ModelRequest model;
  std::vector<const FigureMaker*> figures;
  std::optional<double> photons;
  SimulationSettings run;
  OutputOptions output;
};

std::vector<const FigureMaker*> all_figures() {
  std::vector<const FigureMaker*> all;
  for (const FigureMaker& figure : paper_figures()) all.push_back(&figure);
  return all;
}

// In the order of the catalogue, each once.
std::vector<const FigureMaker*> chosen_figures(const std::string& list) {
  std::vector<const FigureMaker*> chosen;
  for (const std::string& name : split_list(list)) try {
      chosen.push_back(&find_paper_figure(name));
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("--only: {}", error.what()));
    }
  std::sort(chosen.begin(), chosen.end());  // all are elements of one array
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

struct MadeFigure {
  const FigureMaker* maker;
  PaperFigure figure;
};

std::vector<MadeFigure> make_figures(const FiguresCommand& command, const Model& model) {
  const FigureSettings settings{model, command.photons, command.run.seed, command.run.threads};
  std::vector<MadeFigure> made;
  ProgressBar bar(command.output.quiet);
  const Progress whole = bar.callback();
  const auto count = static_cast<double>(command.figures.size());
  for (const FigureMaker* maker : command.figures) {
    const auto done = static_cast<double>(made.size());
    const Progress part = [&](double fraction, const std::string& stage) {
      if (whole) whole((done + fraction) / count, maker->name + ": " + stage);
    };
    made.push_back({maker, maker->make(settings, part)});
  }
  return made;
}

Json figure_json(const MadeFigure& made) {
  Json json = {{"name", made.maker->name},
               {"title", made.maker->title},
               {"files", {made.maker->name + ".svg", made.maker->name + ".csv"}},
               {"remarks", made.figure.remarks},
               {"numbers", Json::array()}};
  for (const FigureNumber& number : made.figure.numbers)
    json["numbers"].push_back({{"of", number.of},
                               {"name", number.name},
                               {"value", number.value},
                               {"error", number.error},
                               {"unit", number.unit}});
  return json;
}

Json figures_json(const FiguresCommand& command, const Model& model, const std::vector<MadeFigure>& all) {
  Json json = {
      {"command", command.command},     {"version", FLOE_VERSION},
      {"base", to_json(command.model)}, {"base_model", to_json(model)},
      {"seed", command.run.seed},       {"photons", command.photons ? Json(*command.photons) : Json()},
      {"figures", Json::array()}};
  for (const MadeFigure& made : all) json["figures"].push_back(figure_json(made));
  return json;
}

std::string number_text(const FigureNumber& number) {
  if (number.error == 0) return fmt::format("{:.3g}", number.value);
  return fmt::format("{:.4g} +- {:.2g}", number.value, number.error);
}

std::string figure_table(const MadeFigure& made) {
  TextTable table({made.maker->name, "number", "value", "unit"});
  for (const FigureNumber& number : made.figure.numbers)
    table.add({number.of, number.name, number_text(number), number.unit});
  std::string text = table.str();
  for (const std::string& remark : made.figure.remarks) text += "  " + remark + "\n";
  return text;
}

void run_figures(const FiguresCommand& command) {
  AtomicFolder folder(command.folder);
  PlannedOutput json(command.output.json);
  const Model model = load_model(command.model);
  const std::vector<MadeFigure> all = make_figures(command, model);
  for (const MadeFigure& made : all) {
    write_whole_file(folder.temporary() / (made.maker->name + ".svg"), made.figure.svg);
    write_whole_file(folder.temporary() / (made.maker->name + ".csv"), made.figure.csv);
  }
  const std::string text = json_text(figures_json(command, model, all));
  write_whole_file(folder.temporary() / "figures.json", text);
  json.write(text);
  json.commit();
  folder.commit();
  if (command.output.quiet) return;
  for (const MadeFigure& made : all) fmt::print("{}", figure_table(made));
  fmt::print("The figures are in {}\n", command.folder);
}

std::string list_of_figures() {
  std::string text = "Figures:\n";
  for (const FigureMaker& figure : paper_figures())
    text += fmt::format("  {:<14} {}\n", figure.name, figure.title);
  return text;
}

}  // namespace

void add_figures(CLI::App& floe, const std::string& command_line) {
  CLI::App& app = *floe.add_subcommand("figures", "Figures of what the ice does to light: SVG, CSV, numbers");
  const auto command = std::make_shared<FiguresCommand>();
  command->command = command_line;
  command->figures = all_figures();
  app.add_option("-o,--output", command->folder, "New folder for the figures")->type_name("DIR")->required();
  app.add_option_function<std::string>(
         "--only",
         [command = command.get()](const std::string& list) { command->figures = chosen_figures(list); },
         "These figures, instead of all")
      ->type_name("NAME[,NAME]");
  add_model_options(app, command->model);
  add_number(app, "--photons", "N", {1e6, 1e13},
             "Of each flasher, as floe simulate --flasher takes them; default: what is quick. Ten times as "
             "many make errors three times smaller",
             [command = command.get()](double photons) { command->photons = photons; });
  add_run_options(app, command->run);
  add_output_options(app, command->output);
  app.footer(list_of_figures() +
             "Examples:\n"
             "  floe figures -o figures\n"
             "  floe figures --only azimuth --photons 1e10 -o precise\n"
             "  floe figures --only azimuth,light-curves --ice my-ice --json numbers.json -o of-my-ice");
  app.callback([command] { say_why_no_result(command->output.json, [&] { run_figures(*command); }); });
}

}  // namespace floe
