// floe validate: the same simulations as an independent program made, and how well they agree.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/common_options.h"
#include "apps/planned_output.h"
#include "apps/progress_bar.h"
#include "apps/text_table.h"
#include "data/base/error.h"
#include "data/base/text.h"
#include "reco/validation/reference_sets.h"

namespace floe {

namespace {

struct ValidateOptions {
  std::filesystem::path reference;
  std::optional<std::string> ice_models;
  std::vector<std::string> only;
  std::string engine = "vector";
  bool quick = false;
  SimulationSettings simulation;
  OutputOptions output;
};

std::string verdict(bool passes) {
  return passes ? "pass" : "fail";
}

// The worst of the tests of one family, as it is judged: corrected for the number of modules tried.
std::string probability(const ModuleTests& tests) {
  if (tests.tried == 0) return "-";
  return fmt::format("{:.2g} of {}", std::min(1.0, tests.smallest_probability * tests.tried), tests.tried);
}

std::vector<std::string> table_row(const ReferenceSet& set, const ValidationResult& result) {
  const SampleComparison& c = result.comparison;
  return {set.name,
          fmt::format("{:.0f}", c.hits_a),
          fmt::format("{:.0f}", c.hits_b),
          fmt::format("{:.4f} +- {:.4f}", c.ratio, c.ratio_error),
          fmt::format("{:.1f}/{}", c.chi_square, c.modules),
          fmt::format("{:.2g}", c.chi_square_p),
          probability(c.times),
          probability(c.zeniths),
          probability(c.azimuths),
          probability(c.impacts),
          verdict(result.passes())};
}

Json tests_json(const ModuleTests& tests) {
  return {{"modules", tests.tried},
          {"smallest_p", tests.smallest_probability},
          {"worst_module", {tests.worst.string, tests.worst.dom}}};
}

Json result_json(const ReferenceSet& set, const ValidationResult& result) {
  const SampleComparison& c = result.comparison;
  return {{"set", set.name},
          {"ice", set.ice},
          {"verdict", verdict(result.passes())},
          {"hits_floe", c.hits_a},
          {"hits_reference", c.hits_b},
          {"ratio", c.ratio},
          {"ratio_error", c.ratio_error},
          {"dispersion", result.dispersion},
          {"chi_square", c.chi_square},
          {"modules", c.modules},
          {"chi_square_p", c.chi_square_p},
          {"times", tests_json(c.times)},
          {"zeniths", tests_json(c.zeniths)},
          {"azimuths", tests_json(c.azimuths)},
          {"impacts", tests_json(c.impacts)},
          {"photons", result.simulation.propagated},
          {"seconds", result.simulation.seconds}};
}

EngineKind engine_kind_of(const std::string& name) {
  if (name == "vector") return EngineKind::vector;
  if (name == "plain") return EngineKind::plain;
  throw UsageError(fmt::format("--engine: found \"{}\"; expected vector or plain", name));
}

ValidationOptions validation_options(const ValidateOptions& options) {
  ValidationOptions result;
  result.reference = options.reference;
  result.ice_models =
      options.ice_models ? std::filesystem::path(*options.ice_models) : options.reference / ".." / "ice";
  result.share = options.quick ? quick_share : 1;
  result.engine = engine_kind_of(options.engine);
  result.seed = options.simulation.seed;
  result.threads = options.simulation.threads;
  return result;
}

// All sets, or those named; an unknown name is wrong usage.
std::vector<ReferenceSet> chosen_sets(const ValidateOptions& options) {
  std::vector<ReferenceSet> chosen;
  std::string known;
  for (const ReferenceSet& set : reference_sets()) {
    known += (known.empty() ? "" : ", ") + set.name;
    const bool named = std::find(options.only.begin(), options.only.end(), set.name) != options.only.end();
    if (options.only.empty() || named) chosen.push_back(set);
  }
  if (!options.only.empty() && chosen.size() != options.only.size())
    throw UsageError(fmt::format("unknown reference set in --only; known are {}", known));
  return chosen;
}

void run_validate(const ValidateOptions& options) {
  const ValidationOptions validation = validation_options(options);
  const std::vector<ReferenceSet> sets = chosen_sets(options);
  // Before the work on the first of them.
  for (const ReferenceSet& set : sets) expect_readable_file(reference_file(set, validation));
  PlannedOutput json(options.output.json);
  TextTable table({"set", "floe", "reference", "ratio of hits", "chi2/modules", "p", "p times", "p zenith",
                   "p azimuth", "p impact", "verdict"});
  Json results = Json::array();
  int failed = 0;
  for (const ReferenceSet& set : sets) {
    ProgressBar bar(options.output.quiet);
    const Progress progress = bar.callback();
    const Progress named = [&](double fraction, const std::string&) {
      if (progress) progress(fraction, set.name);
    };
    const ValidationResult result = validate_set(set, validation, named);
    table.add(table_row(set, result));
    results.push_back(result_json(set, result));
    failed += !result.passes();
  }
  json.write(json_text({{"engine", options.engine}, {"sets", results}, {"passed", failed == 0}}));
  json.commit();
  if (!options.output.quiet) {
    fmt::print("{}\nSimulated with the {} engine.\n", table.str(), options.engine);
    fmt::print(
        "A set passes when the total agrees within 2% (3 standard errors where these are larger), hits per "
        "module\nhave p > 0.001, and times and directions of arrival have p > 0.001 after correction for the "
        "modules tried.\n");
  }
  if (failed > 0) throw Disagreement(fmt::format("{} of the reference sets do not agree", failed));
}

}  // namespace

void add_validate(CLI::App& floe) {
  CLI::App& app = *floe.add_subcommand("validate", "Compare with the results of an independent program");
  const auto options = std::make_shared<ValidateOptions>();
  app.add_option("--reference", options->reference, "Folder with the reference results (.hits.gz)")
      ->type_name("DIR")
      ->required();
  app.add_option("--ice-models", options->ice_models,
                 "Folder with the public ice models; default: ice, beside the reference")
      ->type_name("DIR");
  app.add_option("--only", options->only, "Only these sets")->type_name("SET")->delimiter(',');
  app.add_option("--engine", options->engine,
                 "vector: the one that simulations use; plain: the slow reference that it is tested against")
      ->type_name("vector|plain")
      ->capture_default_str();
  app.add_flag("--quick", options->quick, "A twentieth of the light: a check of the whole chain in short");
  add_run_options(app, options->simulation);
  add_output_options(app, options->output);
  app.footer(
      "Examples:\n"
      "  floe validate --reference ../shared/reference --quick\n"
      "  floe validate --reference ../shared/reference --only cascade-50tev --json validation.json\n"
      "  floe validate --reference ../shared/reference --quick --engine plain\n"
      "Exit code 1 when a set does not agree.");
  app.callback([options] { run_validate(*options); });
}

}  // namespace floe
