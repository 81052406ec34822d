#include "reco/direct_fit/search.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <tuple>

#include "reco/direct_fit/arrival_bins.h"
#include "reco/direct_fit/calibration_stages.h"
#include "reco/direct_fit/one_string.h"
#include "reco/direct_fit/two_cascades.h"

namespace floe {
namespace {

constexpr double scan_share = 0.15;   // of the progress bar
constexpr double usual_rounds = 9;    // of a fit, for the progress bar
constexpr double charge_per_gev = 2;  // of a contained cascade, roughly [photoelectrons]
constexpr int most_coarse_rounds = 3, most_rough_rounds = 8, most_fine_rounds = 2;
constexpr double usual_pull = 1.5;               // of a step that noise makes: the largest of seven
constexpr double design_reach = 2.4;             // how far simulations are used, in steps from the origin
constexpr double other_direction = 50 * degree;  // apart: worth following both
constexpr std::size_t most_starts = 3;
// Two ends so close together are one minimum.
constexpr double same_place = 8, same_direction = 25 * degree;  // [m]
// A minimum so much worse in -ln L, by this many errors as well, is left behind.
constexpr double hopeless = 8, hopeless_errors = 3;
constexpr PhotonNeed first_contest{3, 2e5, 1e6}, second_contest{10, 2e5, 1e7},
    contest_about_string{3, 2e5, 2e6};
constexpr double slack_of_first_contest = 0.5;    // of the best -ln L: not all ends have settled
constexpr double slack_of_second_contest = 0.05;  // they nearly have
// What an end that has not settled is off in a bright module near by would drown all that the others say: it
// counts as a model error.
constexpr double unsettled_error = 0.2;
constexpr int contest_parts = 4;  // independent simulations of each minimum
constexpr std::uint64_t contest_stream = std::uint64_t{1} << 41;

std::string words(const CascadeParameters& c) {
  char text[160];
  std::snprintf(text, sizeof text, "x %.1f y %.1f z %.1f m, zenith %.1f azimuth %.1f deg, %.3g GeV",
                c.position.x(), c.position.y(), c.position.z(), c.zenith / degree, c.azimuth / degree,
                c.energy);
  return text;
}

}  // namespace

Search::Search(ExpectationModel& light, const EventData& data, const MeanIce& ice, const FitOptions& options,
               CascadeFit& result, const Progress& progress)
    : light_(light), data_(data), ice_(ice), options_(options), result_(result), progress_(progress) {}

double Search::photons_for(const CascadeParameters& cascade, double oversize, const PhotonNeed& need) {
  return useful_photons(light_, cascade, data_, oversize, options_.effort, need);
}

void Search::report(double within_round, const std::string& what) {
  if (!progress_) return;
  const double rounds = double(result_.rounds.size()) + within_round;
  progress_(std::min(0.9, scan_share + (0.9 - scan_share) * rounds / usual_rounds), what);
}

void Search::simulate(const LocalFrame& frame, const Stage& stage, Purpose purpose) {
  const auto requests = design_requests(frame, stage, options_.kind, options_.seed, ++draws_, stream_);
  stream_ += requests.size();
  for (std::size_t i = 0; i < requests.size(); ++i) {
    simulations_.push_back(std::make_unique<Simulation>(Simulation{light_.sample(requests[i]), purpose}));
    result_.count_simulation(simulations_.back()->sample.propagated);
    report(double(i + 1) / double(requests.size()), words(cascade_of(frame.origin(), options_.kind)));
  }
}

std::vector<const LightSample*> Search::near(const LocalFrame& frame, const Stage& stage,
                                             Purpose purpose) const {
  std::vector<const LightSample*> result;
  for (const auto& simulation : simulations_) {
    if (simulation->purpose != purpose) continue;
    const LightSample& sample = simulation->sample;
    const Vector7 local = frame.of(light_centre(sample.cascade, options_.kind));
    const double distance = std::hypot(local.head<3>().norm() / stage.position_step,
                                       local.segment<2>(3).norm() / stage.direction_step);
    if (sample.oversize == stage.oversize && distance < design_reach) result.push_back(&sample);
  }
  return result;
}

Emulator Search::emulate(const EventData& data, const LightCentre& origin, const Stage& stage,
                         std::span<const LightSample* const> samples) const {
  EmulatorSettings settings;
  settings.kind = options_.kind;
  settings.model_error = options_.model_error;
  settings.position_step = stage.position_step;
  settings.direction_step = stage.direction_step;
  settings.threads = options_.threads;
  return {data, ice_, origin, samples, settings};
}

Search::RoundEnd Search::round(const LightCentre& origin, const Stage& stage, bool follow_light) {
  const LocalFrame frame(origin);
  simulate(frame, stage, draws_ % 2 == 1 ? Purpose::second_emulator : Purpose::first_emulator);
  std::vector<const LightSample*> samples = near(frame, stage, Purpose::first_emulator);
  for (const LightSample* sample : near(frame, stage, Purpose::second_emulator)) samples.push_back(sample);
  const EventData data =
      follow_light ? data_.with_edges(arrival_edges(data_, frame, samples, options_.kind)) : data_;
  const Emulator emulator = emulate(data, origin, stage, samples);

  RoundEnd end;
  end.fit = fit_locally(emulator);
  end.light = frame.at(end.fit.step);
  end.errors = covariance_of(end.fit.information).diagonal().cwiseSqrt();
  end.pull = end.fit.step.cwiseAbs().cwiseQuotient(end.errors).maxCoeff();
  end.within = (end.fit.step.cwiseAbs().array() < 0.98 * trust_region(emulator.settings()).array()).all();
  result_.rounds.push_back({cascade_of(end.light, options_.kind), end.fit.neg_llh, stage.position_step,
                            stage.direction_step, stage.oversize, end.pull});
  return end;
}

// The step was much smaller than the design, or no more than the noise of simulations makes.
bool Search::has_settled(const RoundEnd& end, const Stage& stage) {
  return end.within && end.errors.allFinite() &&
         (end.pull < usual_pull || (end.fit.step.head<3>().norm() < 0.4 * stage.position_step &&
                                    end.fit.step.segment<2>(3).norm() < 0.4 * stage.direction_step));
}

// Rounds of one stage until the step is smaller than the design, at most `most`.
Search::RoundEnd Search::settle(LightCentre origin, Stage stage, int most, bool follow_light) {
  RoundEnd end;
  for (int i = 0; i < most; ++i) {
    end = round(origin, stage, follow_light);
    origin = end.light;
    if (has_settled(end, stage)) break;
  }
  return end;
}

bool Search::same_minimum(const LightCentre& a, const LightCentre& b) {
  return (a.position - b.position).norm() < same_place &&
         a.direction.dot(b.direction) > std::cos(same_direction);
}

// All of one contest have the same random numbers.
Evaluation Search::measure(const LightCentre& light, double oversize, double photons, double model_error) {
  Evaluation value = evaluate_cascade(light_, data_, cascade_of(light, options_.kind), photons, oversize,
                                      contest_parts, contest_stream + 100 * contests_, model_error);
  for (const LightSample& sample : value.samples) result_.count_simulation(sample.propagated);
  value.samples.clear();
  return value;
}

// Ends that came together count once.
std::vector<Search::Minimum> Search::distinct(std::span<const RoundEnd> ends) {
  std::vector<Minimum> minima;
  for (const RoundEnd& end : ends) {
    const bool known = std::any_of(minima.begin(), minima.end(), [&](const Minimum& other) {
      return same_minimum(other.end.light, end.light);
    });
    if (!known) minima.push_back({end, {}});
  }
  return minima;
}

std::vector<Search::RoundEnd> Search::ends_of(std::span<const Minimum> minima) {
  std::vector<RoundEnd> ends;
  for (const Minimum& minimum : minima) ends.push_back(minimum.end);
  return ends;
}

std::vector<Search::Minimum> Search::contest(std::span<const RoundEnd> ends, const PhotonNeed& need,
                                             double slack, std::size_t most) {
  std::vector<Minimum> minima = distinct(ends);
  if (minima.size() < 2) return minima;
  // Equal photons and random numbers for all.
  const LightCentre& first = minima.front().end.light;
  const double oversize = training_oversize(data_, first, options_.oversize);
  const double photons = photons_for(cascade_of(first, options_.kind), oversize, need);
  const double model_error = std::max(options_.model_error, unsettled_error);
  for (Minimum& minimum : minima) minimum.value = measure(minimum.end.light, oversize, photons, model_error);
  ++contests_;
  std::sort(minima.begin(), minima.end(),
            [](const Minimum& a, const Minimum& b) { return a.value.neg_llh < b.value.neg_llh; });
  const Evaluation best = minima.front().value;
  std::erase_if(minima, [&](const Minimum& minimum) {
    const Difference worse = difference(minimum.value, best);
    return worse.value > hopeless + hopeless_errors * worse.error + slack * best.neg_llh;
  });
  if (minima.size() > most) minima.resize(most);
  return minima;
}

Stage Search::rough_stage(const LightCentre& light) {
  const double coarse = rough_oversize(data_, light, options_.oversize);
  return {std::min(8.0, widest_step(data_, light)), 15 * degree, coarse,
          photons_for(cascade_of(light, options_.kind), coarse, {3, 6e5, 3e6})};
}

Search::RoundEnd Search::settle_roughly(const LightCentre& light) {
  return settle(light, rough_stage(light), most_rough_rounds, true);
}

// Rounds at the wanted oversize, with steps that follow the errors.
Search::RoundEnd Search::sharpen(const RoundEnd& rough) {
  RoundEnd end = rough;
  for (int i = 0; i < most_fine_rounds; ++i) {
    const double widest = widest_step(data_, end.light);
    const Stage stage{std::clamp(2 * end.errors.head<3>().norm(), std::min(3.0, widest), widest),
                      std::clamp(2 * end.errors.segment<2>(3).norm(), 4 * degree, 18 * degree),
                      options_.oversize,
                      photons_for(cascade_of(end.light, options_.kind), options_.oversize, {3, 1e6, 5e6})};
    const RoundEnd now = round(end.light, stage, true);
    if (!now.errors.allFinite()) break;  // too little light for narrow steps: the wider ones have to do
    end = now;
    if (has_settled(now, stage)) break;
  }
  return end;
}

// Where two minima compete, a noisy fine round must not carry one of them over to the other.
Search::RoundEnd Search::sharpen_within_minimum(const RoundEnd& rough) {
  const RoundEnd sharp = sharpen(rough);
  return same_minimum(sharp.light, rough.light) ? sharp : rough;
}

Search::End Search::from(const CascadeParameters& start) {
  return refined(finish(sharpen(settle_roughly(light_centre(start, options_.kind)))));
}

Search::End Search::from_scratch(const PointSeed& point) {
  ScanOptions scan;
  scan.kind = options_.kind;
  CascadeParameters rough;
  rough.energy = std::max(10.0, data_.charge() / data_.repeats() / charge_per_gev);
  scan.oversize = std::max(15.0, options_.oversize);
  scan.photons = photons_for(rough, scan.oversize, {0.2, 3e4, 2e5});
  scan.first_stream = stream_;
  stream_ += static_cast<std::uint64_t>(scan.directions);
  const auto candidates = scan_directions(light_, data_, ice_, point, scan, [&](double done) {
    if (progress_) progress_(scan_share * done, "trying directions");
  });
  result_.simulations += candidates.size();
  result_.photons += static_cast<std::uint64_t>(scan.photons * double(candidates.size()));
  std::vector<LightCentre> starts;
  for (const SeedCandidate& candidate : candidates) {
    const bool other = std::all_of(starts.begin(), starts.end(), [&](const LightCentre& start) {
      return start.direction.dot(candidate.light.direction) < std::cos(other_direction);
    });
    if (other && starts.size() < most_starts) starts.push_back(candidate.light);
  }
  return from_starts(starts);
}

std::vector<Search::Minimum> Search::other_way(std::vector<Minimum> minima) {
  const LightCentre& best = minima.front().end.light;
  RoundEnd turned = minima.front().end;
  turned.light = turned_round(best, light_ahead(ice_, best.position.z()));
  const bool known = std::any_of(minima.begin(), minima.end(), [&](const Minimum& minimum) {
    return minimum.end.light.direction.dot(turned.light.direction) > std::cos(other_direction);
  });
  if (known) return minima;
  const auto stays = [](const std::vector<Minimum>& all, const RoundEnd& end) {
    return std::any_of(all.begin(), all.end(), [&](const Minimum& minimum) {
      return minimum.end.light.position == end.light.position;
    });
  };
  const auto before = std::tuple(stream_, draws_, contests_);
  const std::size_t simulations = simulations_.size(), rounds = result_.rounds.size();
  const RoundEnd both[] = {minima.front().end, turned};
  if (stays(contest(both, first_contest, slack_of_first_contest), turned)) {
    const RoundEnd end = settle_roughly(turned.light);
    std::vector<RoundEnd> ends = ends_of(minima);
    ends.push_back(end);
    std::vector<Minimum> all = contest(ends, second_contest, slack_of_second_contest);
    if (stays(all, end)) return all;
  }
  std::tie(stream_, draws_, contests_) = before;
  simulations_.resize(simulations);
  result_.rounds.resize(rounds);
  return minima;
}

std::vector<Search::Minimum> Search::around_only_string(std::vector<Minimum> minima) {
  constexpr int turns = 6;
  constexpr std::size_t most_around_string = 3;
  const std::optional<Vec3> axis = axis_of_only_string(data_);
  if (!axis) return minima;
  const LightCentre best = minima.front().end.light;
  std::vector<RoundEnd> ends = ends_of(minima), alike;
  // The best is among them, so that what mirrors onto it is no start of its own.
  const auto add = [&](const LightCentre& light) { alike.emplace_back(minima.front().end).light = light; };
  for (int i = 0; i < turns; ++i) {
    const LightCentre turned = turned_about(*axis, 2 * pi * i / turns, best);
    add(turned), add(mirrored_about(*axis, turned));
  }
  for (const Minimum& minimum :
       contest(alike, contest_about_string, slack_of_first_contest, most_around_string))
    if (!same_minimum(minimum.end.light, best)) ends.push_back(settle_roughly(minimum.end.light));
  return contest(ends, second_contest, slack_of_second_contest, most_around_string);
}

// Large steps first. -ln L of ends that have not yet settled is large, and differences mean as little: the
// worse of them is only left behind when it is worse by a good part of all.
Search::End Search::from_starts(std::span<const LightCentre> starts) {
  const double oversize = training_oversize(options_.oversize);
  const Stage coarse{15, 25 * degree, oversize,
                     photons_for(cascade_of(starts.front(), options_.kind), oversize, {1, 4e5, 2e6})};
  std::vector<RoundEnd> ends;
  for (const LightCentre& start : starts) ends.push_back(settle(start, coarse, most_coarse_rounds, false));
  std::vector<Minimum> minima = contest(ends, first_contest, slack_of_first_contest);

  ends.clear();
  for (const Minimum& minimum : minima) ends.push_back(settle_roughly(minimum.end.light));
  minima = around_only_string(other_way(contest(ends, second_contest, slack_of_second_contest)));
  if (minima.size() < 2) return refined(finish(sharpen(minima.front().end)));
  return best_of(minima);
}

// All to their ends, since what is left of the way counts more than the differences.
Search::End Search::best_of(std::span<const Minimum> minima) {
  std::vector<End> ends;
  for (const Minimum& minimum : minima) {
    End end = finish(sharpen_within_minimum(minimum.end), ends);
    const auto same = std::find_if(ends.begin(), ends.end(),
                                   [&](const End& other) { return same_minimum(end.light, other.light); });
    if (same == ends.end())
      ends.push_back(std::move(end));
    else if (same->unsolved && end.converged)
      *same = std::move(end);
  }
  if (ends.size() < 2) return refined(ends.front());
  const auto [best, worse] = tell_apart(ends);
  std::vector<OtherEnd> others;
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (i != best)
      others.push_back({cascade_of(ends[i].light, options_.kind), worse[i].value, worse[i].error,
                        ends[i].unsolved && !ends[best].unsolved});
  result_.other_minimum = competing_minimum(others);
  return refined(ends[best]);
}

// Modules of the wanted size: minima that mirror each other about a string differ by what wide modules blur.
// More photons where the first do not decide.
Search::Ranking Search::tell_apart(std::span<const End> ends) {
  constexpr PhotonNeed first_look{10, 2e6, 1.5e7}, second_look{40, 8e6, 4e7};
  Ranking ranking = tell_apart(ends, first_look);
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (i != ranking.best && ranking.worse[i].value < competing_neg_llh) return tell_apart(ends, second_look);
  return ranking;
}

Search::Ranking Search::tell_apart(std::span<const End> ends, const PhotonNeed& need) {
  const double photons = photons_for(cascade_of(ends.front().light, options_.kind), options_.oversize, need);
  std::vector<Evaluation> values;
  for (const End& end : ends)
    values.push_back(measure(end.light, options_.oversize, photons, options_.model_error));
  ++contests_;
  const auto worse = [&](std::size_t one, std::size_t other) {
    return worse_by(values[one], values[other], options_.model_error, data_.charge_dispersion());
  };
  Ranking ranking;
  for (std::size_t i = 1; i < ends.size(); ++i)
    if (worse(i, ranking.best).value < 0) ranking.best = i;
  for (std::size_t i = 0; i < ends.size(); ++i)
    ranking.worse.push_back(i == ranking.best ? Difference{} : worse(i, ranking.best));
  return ranking;
}

}  // namespace floe
