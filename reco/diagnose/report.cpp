#include "reco/diagnose/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "reco/diagnose/residual_pictures.h"
#include "reco/figures/svg.h"

namespace floe {

namespace {

std::string cells(const std::vector<std::string>& row, const char* tag) {
  std::string text = "<tr>";
  for (const std::string& cell : row) text += fmt::format("<{0}>{1}</{0}>", tag, markup_escaped(cell));
  return text + "</tr>\n";
}

std::string table(const std::vector<std::string>& heading,
                  const std::vector<std::vector<std::string>>& rows) {
  std::string text = "<table>\n" + cells(heading, "th");
  for (const auto& row : rows) text += cells(row, "td");
  return text + "</table>\n";
}

constexpr double sticks_out = 2;  // standard deviations

std::string value_text(double value, double error, const std::string& unit) {
  const int digits = error > 0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 6) : 3;
  return fmt::format("{:.{}f} ± {:.{}f}{}{}", value, digits, error, digits, unit.empty() ? "" : " ", unit);
}

std::string p_text(double p) {
  return p < 1e-4 ? fmt::format("{:.1e}", p) : fmt::format("{:.4f}", p);
}

const ResidualProfile* profile_of(const DiagnosisStep& step, const std::string& axis) {
  const auto found = std::find_if(step.where.profiles.begin(), step.where.profiles.end(),
                                  [&](const ResidualProfile& p) { return p.axis == axis; });
  return found == step.where.profiles.end() ? nullptr : &*found;
}

std::string inline_svg(const std::string& document) {
  const std::size_t start = document.find("<svg");
  return start == document.npos ? document : document.substr(start);
}

std::string pictures(const Diagnosis& diagnosis, double flow_deg) {
  std::string text = "<div class=plots>\n";
  const DiagnosisStep& first = diagnosis.steps.front();
  const bool improved = diagnosis.steps.size() > 1 && diagnosis.looked_at_improved;
  const DiagnosisStep* last = improved ? &diagnosis.steps.back() : nullptr;
  for (const char* axis : {"azimuth", "depth", "distance", "arrival angle", "time", "string"})
    if (const ResidualProfile* before = profile_of(first, axis)) {
      std::optional<std::pair<double, std::string>> flow;
      if (before->circular) flow.emplace(std::fmod(std::fmod(flow_deg, 180) + 180, 180), "flow");
      text += inline_svg(profile_picture(*before, last ? profile_of(*last, axis) : nullptr, flow)) + "\n";
    }
  text += fmt::format("</div>\n<p class=key><span style='color:#c0392b'>●</span> base model{}</p>\n",
                      last ? " &nbsp; <span style='color:#2166ac'>●</span> with what was added" : "");
  text += "<div class=plots>\n";
  const ResidualProfile* base = profile_of(first, "module");
  const ResidualProfile* rest = last ? profile_of(*last, "module") : nullptr;
  if (base) text += inline_svg(module_picture(*base, rest, "Module by module: base model")) + "\n";
  if (rest)
    text += inline_svg(module_picture(*rest, base, "With what was added: what stays unexplained")) + "\n";
  return text +
         "</div>\n<p class=key>Data <span style='color:#c80000'>■</span> above, <span "
         "style='color:#0000c8'>■</span> below the model, full colour at 4 standard deviations</p>\n";
}

std::string place_text(const NamedEffect& effect) {
  std::string text;
  for (const auto& [name, value] : effect.suspect.place)
    if (name == "string" || name == "dom") text += fmt::format("{} {:.0f} ", name, value);
  return text;
}

// What the data cannot tell from it, besides itself.
std::string alike_text(const NamedEffect& effect) {
  std::string text;
  for (const std::string& other : effect.group)
    if (other != effect.suspect.effect) text += (text.empty() ? "" : ", ") + other;
  return text.empty() ? "nothing else" : text;
}

std::string effects_table(const Diagnosis& diagnosis) {
  std::vector<std::vector<std::string>> rows;
  for (const NamedEffect& effect : diagnosis.effects) {
    const auto add = [&](bool first, const std::string& name, const std::string& value) {
      rows.push_back({first ? effect.suspect.effect : "", name, value,
                      first ? fmt::format("{:.1f}", effect.significance) : "",
                      first ? alike_text(effect) : ""});
    };
    if (effect.mean)
      add(true, effect.mean->name + ", mean", value_text(effect.mean->value, effect.mean->error, ""));
    for (std::size_t i = 0; i < effect.values.size(); ++i)
      add(i == 0 && !effect.mean, place_text(effect) + effect.parameters[i].name,
          value_text(effect.values[i], effect.errors[i], effect.parameters[i].unit));
  }
  return table({"effect", "parameter", "fitted", "standard deviations", "cannot be told from"}, rows);
}

std::string score_table(const DiagnosisStep& step) {
  std::vector<std::vector<std::string>> rows;
  for (const EffectScore& effect : step.scores.effects)
    rows.push_back({text_of(effect.best.suspect), fmt::format("{:.1f}", effect.best.gain),
                    fmt::format("{:.1f}", sigmas_of(effect.ln_p)),
                    fmt::format("{:.1f}%", 100 * effect.best.size), fmt::format("{:.2f}", effect.likeness)});
  return table(
      {"effect", "expected gain in ln L", "standard deviations", "changes light by", "likeness to the first"},
      rows);
}

// How much of a row's change of light the column's effect can imitate.
std::string confusion_table(const DiagnosisStep& step) {
  std::vector<std::string> heading{"change of light by"};
  std::vector<std::vector<std::string>> rows;
  const Eigen::MatrixXd& likeness = step.scores.likeness;
  for (Eigen::Index i = 0; i < likeness.rows(); ++i) {
    heading.push_back(step.scores.effects[static_cast<std::size_t>(i)].best.suspect.effect);
    rows.push_back({heading.back()});
    for (Eigen::Index j = 0; j < likeness.cols(); ++j)
      rows.back().push_back(fmt::format("{:.2f}", likeness(i, j)));
  }
  return table(heading, rows);
}

// "k1 0.597 ± 0.029"
std::string values_text(const Trial& trial) {
  std::string text;
  for (std::size_t i = 0; i < trial.values.size(); ++i) {
    const std::string& name = trial.parameters[i].name;
    text += (text.empty() ? "" : ", ") + name.substr(name.find('.') + 1) + " " +
            value_text(trial.values[i], trial.errors[i], trial.parameters[i].unit);
  }
  return text;
}

std::string trial_table(const DiagnosisStep& step) {
  std::vector<std::vector<std::string>> rows;
  for (const Trial& trial : step.trials)
    rows.push_back(
        {text_of(trial.suspect), values_text(trial), fmt::format("{:.1f}", trial.neg_llh),
         fmt::format("{:.0f}", trial.chi_square),
         trial.lost ? fmt::format("{:.0f}, the winner {:.0f}", trial.lost->loser, trial.lost->winner) : ""});
  return table({"suspect", "fitted", "−ln L", "χ² about the model without it", "χ² added beside its rival"},
               rows);
}

std::string region_table(const DiagnosisStep& step) {
  std::vector<std::vector<std::string>> rows;
  for (const Region& region : step.where.regions)
    rows.push_back({region.axis, fmt::format("{:.1f}", region.significance),
                    region.significance > sticks_out ? region.sentence : "Nothing sticks out."});
  return table({"axis", "standard deviations", "most significant region"}, rows);
}

std::string step_text(const Diagnosis& diagnosis, std::size_t i) {
  const DiagnosisStep& step = diagnosis.steps[i];
  std::string text = fmt::format(
      "<h2>Look {}: {}</h2>\n<p>−ln L {:.1f}; {:.1f} ± {:.1f} expected if the model were right. "
      "Probability of so bad a fit {}, of so large a score {}.</p>\n",
      i + 1, i == 0 ? "the base model" : "with what was added so far", step.neg_llh, step.expected,
      step.scatter, p_text(step.p_of_fit), p_text(step.scores.p_value));
  text += "<h3>Where</h3>\n" + region_table(step);
  text += "<h3>Which effect would explain it</h3>\n" + score_table(step);
  if (step.scores.likeness.rows() > 1)
    text +=
        "<h3>Confusion: what the column can imitate of what the row changes</h3>\n" + confusion_table(step);
  if (!step.trials.empty()) text += "<h3>Leading suspects, fitted</h3>\n" + trial_table(step);
  return text;
}

std::string closing_text(const Diagnosis& diagnosis) {
  if (diagnosis.has_clear_gap() && diagnosis.closed() >= 1)
    return fmt::format("all of the gap in {} closes", judged_runs(diagnosis));
  if (diagnosis.has_clear_gap() && diagnosis.closed() >= 0)
    return fmt::format("{:.0f}% of the gap in {} closes", 100 * diagnosis.closed(), judged_runs(diagnosis));
  return fmt::format("the gap in {} goes from {:.1f} to {:.1f}, where chance makes +- {:.1f}",
                     judged_runs(diagnosis), diagnosis.gap_before, diagnosis.gap_after,
                     diagnosis.gap_scatter);
}

std::string gap_text(const Diagnosis& diagnosis) {
  std::string text = fmt::format(
      "<p>Deviance of each run above what it would be on average if the model were true, which scatters by "
      "{:.1f} for all of them; after: ",
      diagnosis.gap_scatter);
  if (diagnosis.effects.empty())
    text += "the same, as nothing was added";
  else if (diagnosis.folds == 1)
    text += "of the model that was fitted to these runs, as none was held out";
  else
    text += fmt::format(
        "of models that were fitted to other runs. What these do not tell makes it larger by {:.1f}",
        diagnosis.gap_unknown);
  return text + ".</p>\n";
}

std::string gap_table(const Diagnosis& diagnosis) {
  std::vector<std::vector<std::string>> rows;
  for (const RunGap& run : diagnosis.gaps)
    rows.push_back({run.run, fmt::format("{:.1f}", run.before), fmt::format("{:.1f}", run.after)});
  rows.push_back(
      {"all", fmt::format("{:.1f}", diagnosis.gap_before), fmt::format("{:.1f}", diagnosis.gap_after)});
  return table({diagnosis.folds > 1 ? "run, held out" : "run", "gap before", "gap after"}, rows);
}

constexpr const char* style =
    "body{font:15px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#222}"
    "h1{font-size:1.5em}h2{font-size:1.2em;margin-top:2em;border-bottom:1px solid #ccc}h3{font-size:1em}"
    "table{border-collapse:collapse;margin:.5em 0}td,th{padding:.15em .8em;text-align:left;"
    "border-bottom:1px solid #e4e4e4;font-size:.92em}.verdict{font-size:1.15em;background:#f2f6fa;"
    "padding:.8em 1em;border-left:4px solid #2166ac}.plots{display:flex;flex-wrap:wrap;gap:.5em}"
    ".key{font-size:.9em}code{background:#f4f4f4;padding:.1em .3em;overflow-wrap:anywhere}";

}  // namespace

const char* judged_runs(const Diagnosis& diagnosis) {
  return diagnosis.folds > 1 ? "held-out runs" : "the fitted runs (none was held out)";
}

std::string verdict_sentence(const Diagnosis& diagnosis, double alpha) {
  if (diagnosis.verdict.empty())
    return fmt::format("Nothing is missing: the data agree with the model (p = {}, alpha = {:g}).",
                       p_text(diagnosis.p_value), alpha);
  std::string text;
  for (const NamedEffect& effect : diagnosis.effects)
    text +=
        (text.empty() ? "" : ", and ") + text_of(effect.suspect) +
        (effect.group.size() > 1 ? fmt::format(" (or {}: these data cannot tell)", alike_text(effect)) : "");
  if (text.empty())
    return fmt::format("Something is missing (p = {}) that no effect of the catalogue explains.",
                       p_text(diagnosis.p_value));
  std::string rest;
  for (const std::string& why : diagnosis.why_unexplained) rest += "; " + why;
  return fmt::format("Missing: {} (p = {} for the base model); {}{}.", text, p_text(diagnosis.p_value),
                     closing_text(diagnosis), rest);
}

std::string report_html(const Diagnosis& diagnosis, const DiagnosisOptions& options,
                        const ReportFacts& facts) {
  std::string text = fmt::format(
      "<!doctype html>\n<html lang=en><head><meta charset=utf-8><title>Diagnosis of {0}</title>"
      "<style>{1}</style></head><body>\n<h1>What is {0} missing?</h1>\n",
      markup_escaped(facts.ice), style);
  text += fmt::format("<p>Flasher data: {}</p>\n<p class=verdict>{}</p>\n", markup_escaped(facts.data),
                      markup_escaped(verdict_sentence(diagnosis, options.alpha)));
  const auto& regions = diagnosis.steps.front().where.regions;
  if (!diagnosis.verdict.empty())
    for (std::size_t i = 0; i < std::min<std::size_t>(3, regions.size()); ++i)
      if (regions[i].significance > 3)
        text += fmt::format("<p>{}</p>\n", markup_escaped(regions[i].sentence));
  text += pictures(diagnosis, facts.flow_deg);
  if (!diagnosis.effects.empty()) text += "<h2>Added to the model</h2>\n" + effects_table(diagnosis);
  for (const NamedEffect& effect : diagnosis.effects)
    for (const Separation& separation : effect.separations)
      text += "<p>" + markup_escaped(separation.sentence) + "</p>\n";
  for (const std::string& remark : diagnosis.remarks) text += "<p>" + markup_escaped(remark) + ".</p>\n";
  text += "<h2>Gap before and after</h2>\n" + gap_text(diagnosis) + gap_table(diagnosis);
  for (std::size_t i = 0; i < diagnosis.steps.size(); ++i) text += step_text(diagnosis, i);
  if (!diagnosis.left_out.empty()) {
    text += "<h2>Left out</h2>\n<ul>\n";
    for (const std::string& sentence : diagnosis.left_out)
      text += "<li>" + markup_escaped(sentence) + "</li>\n";
    text += "</ul>\n";
  }
  if (!diagnosis.not_tested.empty()) {
    text += "<h2>Not tested</h2>\n<ul>\n";
    for (const auto& [effect, why] : diagnosis.not_tested)
      text += fmt::format("<li>{}: {}</li>\n", effect, markup_escaped(why));
    text += "</ul>\n";
  }
  text += fmt::format(
      "<h2>To repeat this</h2>\n<p><code>{}</code></p>\n<p>floe {}, seed {}, {:.0f} s. alpha {:g}: the "
      "probability of naming anything when nothing is missing. Floor {:g}%: smaller changes of light are not "
      "told from differences between programs.</p>\n<p>Base model {}, improved model {} (hashes of ice). To "
      "look at the improved model again: <code>{}</code></p>\n"
      "</body></html>\n",
      markup_escaped(facts.command), facts.version, facts.seed, diagnosis.seconds, options.alpha,
      100 * options.floor, facts.base_hash, facts.improved_hash, markup_escaped(facts.look_again));
  return text;
}

}  // namespace floe
