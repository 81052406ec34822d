#include "reco/diagnose/measured_gaps.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "data/base/error.h"
#include "reco/diagnose/goodness.h"
#include "reco/diagnose/held_out_gaps.h"
#include "reco/diagnose/light_by_runs.h"

namespace floe {

namespace {

constexpr std::uint64_t gap_stream = (std::uint64_t{1} << 45) + (std::uint64_t{1} << 40);
// Light of the measurement, in units of what the settings ask for, see light_by_runs.h: twice ln L of two
// simulations differs by tens where they have hardly more light than the data.
constexpr double light_of_gap = 1.2, most_light_of_gap = 2;

// A base to which nothing was added is only said to have a gap or none.
RunSettings settings_of(const GapsToMeasure& asked, bool anything_added) {
  RunSettings settings = asked.options;
  if (anything_added)
    settings.light *= light_by_runs(asked.data.runs.size(), light_of_gap, most_light_of_gap);
  return settings;
}

class GapMeasurement {
 public:
  GapMeasurement(const GapsToMeasure& asked, Additions& additions, Diagnosis& result)
      : asked_(asked),
        additions_(additions),
        result_(result),
        folds_(std::min(asked.options.folds, flasher_count(asked.data))),
        gaps_(asked.base, asked.data, asked.look, settings_of(asked, additions.count() > 0), gap_stream,
              folds_, asked.fits) {}

  void run() {
    measure_base();
    if (additions_.count() == 0) return;
    for (bool asks = true; asks && !accepted().empty();) asks = give_up_last();
    std::ranges::copy(remarks_, std::back_inserter(result_.remarks));
    if (result_.gap_unknown > gaps_.noise_of_differences())
      result_.remarks.push_back(fmt::format(
          "What runs do not tell of others makes the gap after larger by {:.0f}", result_.gap_unknown));
    const double of_floor = result_.gap_of_floor / 2;  // in -ln L
    result_.p_of_rest =
        accepted().empty() ? gaps_.p_of_base(of_floor) : gaps_.p_of(accepted().model(), of_floor);
  }

 private:
  const AcceptedEffects& accepted() const { return additions_.accepted(); }

  void measure_base() {
    result_.folds = folds_;
    for (std::size_t r = 0; r < asked_.data.runs.size(); ++r)
      result_.gaps.push_back({asked_.data.runs[r].name, gaps_.of_base().of_runs[r], 0});
    result_.gap_before = gaps_.of_base().total();
    result_.gap_scatter = gaps_.scatter_of_base();
    result_.gap_of_floor = 2 * neg_llh_of_floor(asked_.data, asked_.options.floor);
    take(gaps_.of_base());
  }

  // The last effect, or all, where held-out runs do not want it. Whether the one before may go, too.
  bool give_up_last() {
    constexpr double too_much = 2;
    const Gaps with = gaps_.of(accepted(), asked_.stages, 0.9, 0.95);
    take(with);
    if (asked_.gap_stays && is_patchwork()) {
      additions_.give_up_all(fmt::format("{} effects together leave a gap, and none of them names it",
                                         accepted().effects().size()));
      take(gaps_.of_base());
      return false;
    }
    if (is_past_asking()) return false;
    const Gaps without = without_last();
    if (with.known() <= without.known() + too_much * gaps_.noise_of_differences()) return false;
    const std::size_t effects = accepted().effects().size();
    additions_.give_up(effects - 1, fmt::format("runs that were held out fit worse with it (a gap of {:.1f}, "
                                                "{:.1f} of which the others cannot know) than {} ({:.1f}, "
                                                "{:.1f})",
                                                with.total(), with.unknown,
                                                effects == 1 ? "without" : "without it or any of them",
                                                without.total(), without.unknown));
    take(gaps_.of_base());
    additions_.refit();
    return true;
  }

  // Where all that may be added leave a gap, each has taken a part of what none of them is, unless they close
  // nearly all of it.
  bool is_patchwork() const {
    constexpr double nearly_all = 0.8;
    return additions_.count() == asked_.options.most_effects && accepted().effects().size() > 1 &&
           result_.closed() < nearly_all;
  }

  // With several effects the question costs a fit and a measurement. The answer is known where the last one
  // gains so much in the fit that a small part of it is more than the noise of measured gaps.
  bool is_past_asking() const {
    constexpr double small_part = 1.0 / 3;
    const std::size_t effects = accepted().effects().size();
    if (effects == 1 || result_.gap_after > result_.gap_before) return false;
    double gained = 0;
    for (const DiagnosisStep& step : result_.steps)
      if (step.added == effects - 1) gained = step.trials.front().chi_square;
    return small_part * gained > gaps_.noise_of_differences();
  }

  // Of what was found before the last effect, or of the base where that is better.
  Gaps without_last() const {
    if (accepted().effects().size() == 1) return gaps_.of_base();
    AcceptedEffects fewer = accepted();
    fewer.drop(fewer.effects().size() - 1);
    try {
      if (folds_ == 1) fewer.take(asked_.fits.fit(fewer.parameters()));  // otherwise folds are fitted
      return std::min(gaps_.of_base(), gaps_.of(fewer, asked_.stages, 0.95, 1),
                      [](const Gaps& a, const Gaps& b) { return a.known() < b.known(); });
    } catch (const InputError&) {
      return gaps_.of_base();  // no physical ice without the last one
    }
  }

  void take(const Gaps& gaps) {
    for (std::size_t r = 0; r < gaps.of_runs.size(); ++r) result_.gaps[r].after = gaps.of_runs[r];
    result_.gap_after = gaps.total();
    result_.gap_unknown = gaps.unknown;
    remarks_ = gaps.remarks;
  }

  const GapsToMeasure& asked_;
  Additions& additions_;
  Diagnosis& result_;
  const int folds_;
  const HeldOutGaps gaps_;
  std::vector<std::string> remarks_;  // of the gaps that the result has
};

}  // namespace

void measure_gaps(const GapsToMeasure& asked, Additions& additions, Diagnosis& result) {
  GapMeasurement(asked, additions, result).run();
}

}  // namespace floe
