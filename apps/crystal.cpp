// floe crystal: what grains of ice do to light, from first principles.
#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <memory>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/crystal_ice.h"
#include "apps/crystal_options.h"
#include "apps/crystal_output.h"
#include "apps/option_values.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "data/base/atomic_file.h"
#include "data/base/error.h"
#include "reco/crystal/pattern_file.h"
#include "reco/crystal/pattern_merge.h"
#include "reco/crystal/pattern_picture.h"

namespace floe {

namespace {

constexpr std::int64_t most_photons = 10'000'000, most_crossings = 1'000'000;

struct CrystalCommand {
  std::string command;
  std::string elongations = "1.4", grain = "1mm", estimator = "all";
  std::vector<std::string> fabrics{"0.1,4"};
  std::optional<std::string> axes, angles, output, picture;
  std::vector<std::string> merge;
  double wavelength = 405;
  bool scaling = false;
  PatternGrid grid;
  CrystalIceRequest ice;
  SimulationSettings run;
  OutputOptions printed;
};

// A shape of grains and how the user called it.
struct NamedShape {
  std::string name;
  GrainShape shape;
};

std::vector<NamedShape> shapes_of(const CrystalCommand& command) {
  constexpr double flattest = 0.05, longest = 20;
  if (command.axes) {
    const auto axes = parse_numbers("--axes", *command.axes, flattest, longest);
    if (axes.size() != 3)
      throw UsageError(fmt::format("--axes: found \"{}\"; expected FLOW,TILT,VERTICAL", *command.axes));
    return {{"axes " + *command.axes, {{axes[0], axes[1], axes[2]}}}};
  }
  std::vector<NamedShape> shapes;
  for (const double elongation : parse_numbers("--elongation", command.elongations, flattest, longest))
    shapes.push_back({fmt::format("elongation {:g}", elongation), spheroid(elongation)});
  return shapes;
}

PatternEstimator estimator_of(const CrystalCommand& command) {
  if (command.estimator == "core") return PatternEstimator::core;
  if (command.estimator == "all") return PatternEstimator::all;
  throw UsageError(fmt::format("--estimator: found \"{}\"; expected all or core", command.estimator));
}

// Everything of the grid but fabric and shape.
PatternGrid grid_of(const CrystalCommand& command) {
  PatternGrid grid = command.grid;
  grid.crystal.indices = crystal_indices(command.wavelength);
  grid.grain = parse_length("--grain", command.grain);
  grid.seed = command.run.seed;
  grid.threads = command.run.threads;
  if (command.angles)
    grid.angles = parse_angles("--angles", *command.angles);
  else
    for (int angle = 0; angle <= 90; angle += 5) grid.angles.push_back(angle * degree);
  return grid;
}

// Of all shares together, still without fits. The command's settings become those of the shares.
std::vector<CrystalStudy> merge_shares(CrystalCommand& command) {
  std::vector<PatternFile> shares;
  for (const std::string& file : command.merge) shares.push_back(read_patterns(file));
  command.wavelength = shares.front().provenance.wavelength;
  command.run.seed = shares.front().studies.front().grid.seed;
  return merged_patterns(std::move(shares));
}

// One study of each fabric with each shape, still without patterns.
std::vector<CrystalStudy> plan(const CrystalCommand& command) {
  std::vector<CrystalStudy> planned;
  PatternGrid grid = grid_of(command);
  for (const std::string& fabric : command.fabrics) {
    grid.crystal.fabric = parse_fabric("--fabric", fabric);
    for (const NamedShape& shape : shapes_of(command)) {
      grid.crystal.grains = shape.shape;
      planned.push_back({fmt::format("{}, fabric {}", shape.name, fabric), fabric, grid, {}, {}, {}, {}});
    }
  }
  return planned;
}

void check_usage(const CrystalCommand& command, const std::vector<CrystalStudy>& planned) {
  const char* of_one = command.picture ? "--picture" : command.ice.folder ? "--into" : nullptr;
  if (of_one && planned.size() > 1)
    throw UsageError(fmt::format("{} is of one kind of ice; found {} of them", of_one, planned.size()));
  if (command.ice.folder && planned.front().grid.angles.size() < 5)
    throw UsageError(fmt::format("--into needs 5 --angles or more to fit the 12 numbers to; found {}",
                                 planned.front().grid.angles.size()));
}

std::vector<CrystalStudy> study_all(const CrystalCommand& command, const std::vector<CrystalStudy>& planned) {
  ProgressBar bar(command.printed.quiet);
  const Progress progress = bar.callback();
  std::vector<CrystalStudy> studies;
  for (const CrystalStudy& plan : planned) {
    const auto share = [&](double fraction, const std::string&) {
      progress((static_cast<double>(studies.size()) + fraction) / static_cast<double>(planned.size()),
               plan.name);
    };
    studies.push_back(study_crystal(plan.name, plan.fabric, plan.grid, command.scaling,
                                    progress ? Progress(share) : Progress()));
  }
  return studies;
}

Json crystal_json(const CrystalCommand& command, const std::vector<CrystalStudy>& studies) {
  Json json = {{"command", command.command},
               {"version", FLOE_VERSION},
               {"seed", command.run.seed},
               {"wavelength_nm", command.wavelength},
               {"ice", Json::array()}};
  for (const CrystalStudy& study : studies) json["ice"].push_back(to_json(study));
  return json;
}

void print(const CrystalCommand& command, const std::vector<CrystalStudy>& studies) {
  if (studies.size() == 1)
    fmt::print("{}", crystal_tables(studies.front()));
  else
    fmt::print("{}", crystal_library(studies, estimator_of(command)));
  if (!command.ice.folder) return;
  const bool with_detector = std::filesystem::exists(std::filesystem::path(*command.ice.folder) / "geo-f2k");
  fmt::print("The new ice model is {}{}\n", *command.ice.folder,
             with_detector ? "" : "; it has no detector of its own: use it with --detector ic86, or another");
}

void run_crystal(CrystalCommand& command) {
  const PatternEstimator estimator = estimator_of(command);
  const bool merging = !command.merge.empty();
  std::vector<CrystalStudy> studies = merging ? merge_shares(command) : plan(command);
  check_usage(command, studies);
  std::optional<AtomicFile> patterns;
  if (command.output) patterns.emplace(*command.output);
  PlannedOutput json(command.printed.json), picture(command.picture);
  std::optional<CrystalIceWriter> ice;
  if (command.ice.folder) ice.emplace(command.ice);

  if (!merging) studies = study_all(command, studies);
  if (command.picture) picture.write(pattern_picture(studies.front(), estimator));
  json.write(json_text(crystal_json(command, studies)));
  if (ice) ice->write(studies.front(), estimator, command.command);
  if (patterns) write_patterns(*patterns, {FLOE_VERSION, command.command, command.wavelength}, studies);
  picture.commit();
  json.commit();
  if (ice) ice->commit();
  if (!command.printed.quiet) print(command, studies);
}

void add_ice_options(CLI::App& app, CrystalCommand& command) {
  app.add_option("--elongation", command.elongations,
                 "Long axis, along the flow, over short axis of the grains")
      ->type_name("E[,E]")
      ->capture_default_str();
  app.add_option("--axes", command.axes, "Semi-axes of the grains, for those that are no spheroids")
      ->type_name("FLOW,TILT,VERTICAL")
      ->excludes("--elongation");
  app.add_option(
         "--fabric", command.fabrics,
         "Where c-axes point: isotropic, girdle (across the flow), or ln(S1/S2),ln(S2/S3) of a Bingham "
         "distribution with S1 vertical and S3 along the flow; may be repeated")
      ->type_name("KIND|LN,LN")
      ->allow_extra_args(false)
      ->default_str("0.1,4");
  app.add_option("--grain", command.grain, "Mean distance between crossings of boundaries")
      ->type_name("SIZE")
      ->capture_default_str();
  app.add_flag(
      "--chords", command.grid.chords,
      "Distances between crossings follow the grains' chord in each direction; --grain is 4 V/surface");
  add_number(app, "--wavelength", "NM", {250, 700}, "Of the light, which the indices follow",
             command.wavelength);
}

void add_walk_options(CLI::App& app, CrystalCommand& command) {
  add_integer(app, "--crossings", 1, most_crossings, "Boundaries that each photon meets",
              [&command](std::int64_t n) { command.grid.crossings = static_cast<int>(n); })
      ->default_str("1000");
  app.add_option("--angles", command.angles, "To the flow [deg]. Default: 0 to 90 in steps of 5")
      ->type_name("A[,A]");
  add_integer(app, "--photons", 200, most_photons, "Of each angle", [&command](std::int64_t n) {
    command.grid.photons = static_cast<std::size_t>(n);
  })->default_str("10000");
  add_integer(app, "--first-photon", 0, std::numeric_limits<std::int64_t>::max() / 2,
              "Number of the first photon, to make shares of a pattern apart",
              [&command](std::int64_t n) { command.grid.first_photon = static_cast<std::uint64_t>(n); })
      ->default_str("0");
  add_run_options(app, command.run);
  app.add_flag("--scaling", command.scaling, "Check how patterns grow with the crossings, on shorter paths");
  app.add_option("--estimator", command.estimator,
                 "Of --picture, --into and libraries: widths and deflection of all photons, which scale with "
                 "the path "
                 "as propagation takes it, or of the core")
      ->type_name("all|core")
      ->capture_default_str();
}

// The photons of files are what they are.
void add_merge_option(CLI::App& app, CrystalCommand& command) {
  auto* merge =
      app.add_option("--merge", command.merge,
                     "Walk no photons: put those of patterns (-o) together that were made apart, with "
                     "--first-photon");
  merge->type_name("FILE.h5...");
  for (const char* walking :
       {"--elongation", "--axes", "--fabric", "--grain", "--chords", "--wavelength", "--crossings",
        "--angles", "--photons", "--first-photon", "--seed", "--scaling"})
    merge->excludes(walking);
}

}  // namespace

void add_crystal(CLI::App& floe, const std::string& command_line) {
  CLI::App& app =
      *floe.add_subcommand("crystal", "From grains of ice to diffusion patterns and their 12 numbers");
  const auto command = std::make_shared<CrystalCommand>();
  command->command = command_line;
  add_ice_options(app, *command);
  add_walk_options(app, *command);
  add_merge_option(app, *command);
  add_output_file(app, "-o,--output", ".h5", "File for patterns, their numbers and all photons",
                  command->output);
  add_picture(app, "--picture", "Patterns on the sphere; deflection and widths", command->picture);
  add_crystal_ice_options(app, command->ice);
  add_output_options(app, command->printed);
  app.footer(
      "Examples:\n"
      "  floe crystal --elongation 1.4 --fabric 0.1,4 --grain 1mm --crossings 1000\n"
      "  floe crystal --fabric girdle --angles 0,30,60,90 -o patterns.h5 --json patterns.json\n"
      "  floe crystal --photons 1000 --quiet -o first.h5\n"
      "  floe crystal --photons 1000 --first-photon 1000 --quiet -o second.h5\n"
      "  floe crystal --merge first.h5 second.h5 -o whole.h5\n"
      "  floe crystal --photons 2000 --scaling --picture patterns.svg\n"
      "  floe crystal --elongation 1,1.4,2 --fabric isotropic --fabric 0.1,4 --photons 1000\n"
      "  floe crystal --elongation 1.7 --grain 2mm --photons 2000 --ice south-pole --into coarse-ice");
  app.callback([command] { say_why_no_result(command->printed.json, [&] { run_crystal(*command); }); });
}

}  // namespace floe
