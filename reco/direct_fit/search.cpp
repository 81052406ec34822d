#include "reco/direct_fit/search.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "reco/direct_fit/design.h"

namespace floe {
namespace {

constexpr double scan_share = 0.15;  // of the progress bar
constexpr double usual_rounds = 9;   // of a fit, for the progress bar
constexpr double coarse_oversize = 12;
constexpr double largest_pull = 1.2;             // of the last step: what the noise of simulations makes
constexpr double design_reach = 2.4;             // how far simulations are used, in steps from the origin
constexpr double other_direction = 50 * degree;  // apart: worth following both

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

double Search::useful_photons(const CascadeParameters& cascade, double events, double least, double most) {
  const double one = light_.photons_per_cascade(cascade, options_.oversize) * data_.repeats();
  return options_.effort * std::clamp(events * one, least, most);
}

void Search::report(double within_round, const std::string& what) {
  if (!progress_) return;
  const double rounds = double(result_.rounds.size()) + within_round;
  progress_(std::min(0.9, scan_share + (0.9 - scan_share) * rounds / usual_rounds), what);
}

void Search::simulate(const LocalFrame& frame, const Stage& stage) {
  const auto design = simplex_design(options_.seed, ++draws_);
  for (std::size_t i = 0; i < design.size(); ++i) {
    Vector7 local = Vector7::Zero();
    local.head<3>() = stage.position_step * design[i].head<3>();
    local.segment<2>(3) = stage.direction_step * design[i].tail<2>();
    LightRequest request{cascade_of(frame.at(local), options_.kind), stage.photons / double(design.size()),
                         stage.oversize, stream_++};
    simulations_.push_back(std::make_unique<Simulation>(Simulation{light_.sample(request), draws_}));
    ++result_.simulations;
    result_.photons += simulations_.back()->sample.propagated;
    report(double(i + 1) / double(design.size()), words(cascade_of(frame.origin(), options_.kind)));
  }
}

std::vector<const Search::Simulation*> Search::near(const LocalFrame& frame, const Stage& stage) const {
  std::vector<const Simulation*> result;
  for (const auto& simulation : simulations_) {
    const Vector7 local = frame.of(light_centre(simulation->sample.cascade, options_.kind));
    const double distance = std::hypot(local.head<3>().norm() / stage.position_step,
                                       local.segment<2>(3).norm() / stage.direction_step);
    if (simulation->sample.oversize == stage.oversize && distance < design_reach)
      result.push_back(simulation.get());
  }
  return result;
}

Emulator Search::emulate(const LightCentre& origin, const Stage& stage,
                         std::span<const Simulation* const> simulations) {
  EmulatorSettings settings;
  settings.kind = options_.kind;
  settings.model_error = options_.model_error;
  settings.noise_rate = options_.noise_rate;
  settings.position_step = stage.position_step;
  settings.direction_step = stage.direction_step;
  settings.threads = options_.threads;
  std::vector<const LightSample*> samples;
  for (const Simulation* simulation : simulations) samples.push_back(&simulation->sample);
  return {data_, ice_, origin, samples, settings};
}

// With two emulators from every other draw of the design; from all at once where that says nothing.
Matrix7 Search::final_covariance(const LightCentre& light, const Stage& stage, const Matrix7& information) {
  std::vector<const Simulation*> halves[2];
  for (const Simulation* simulation : near(LocalFrame(light), stage))
    halves[simulation->draw % 2].push_back(simulation);
  if (!halves[0].empty() && !halves[1].empty()) {
    const Matrix7 cross =
        cross_information(emulate(light, stage, halves[0]), emulate(light, stage, halves[1]));
    const Matrix7 covariance = covariance_of(cross);
    if (covariance.allFinite()) return covariance;
  }
  return covariance_of(information);
}

Search::RoundEnd Search::round(const LightCentre& origin, const Stage& stage) {
  const LocalFrame frame(origin);
  simulate(frame, stage);
  const Emulator emulator = emulate(origin, stage, near(frame, stage));

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

// Rounds of one stage until the step is smaller than the design, at most `most`.
Search::RoundEnd Search::settle(LightCentre origin, Stage stage, int most) {
  RoundEnd end;
  for (int i = 0; i < most; ++i) {
    end = round(origin, stage);
    origin = end.light;
    if (end.fit.step.head<3>().norm() < stage.position_step &&
        end.fit.step.segment<2>(3).norm() < stage.direction_step)
      break;
  }
  return end;
}

LightCentre Search::best_of_two(const std::vector<SeedCandidate>& candidates) {
  const double oversize = std::max(coarse_oversize, options_.oversize);
  const Stage stage{15, 25 * degree, oversize, 2e6 * options_.effort};
  const RoundEnd first = settle(candidates.front().light, stage, 3);
  for (const SeedCandidate& other : candidates) {
    if (other.light.direction.dot(candidates.front().light.direction) > std::cos(other_direction)) continue;
    const RoundEnd second = settle(other.light, stage, 2);
    return (second.fit.neg_llh < first.fit.neg_llh ? second : first).light;
  }
  return first.light;
}

Search::End Search::refine(const LightCentre& start) {
  const double coarse = std::max(coarse_oversize, options_.oversize);
  const RoundEnd rough = settle(start, {8, 12 * degree, coarse, 4e6 * options_.effort}, 4);

  End end{rough.light, {}, false, {}};
  Stage stage;
  Matrix7 information = rough.fit.information;
  Vector7 errors = rough.errors;
  int fine_rounds = 0;
  while (static_cast<int>(result_.rounds.size()) < options_.max_rounds || fine_rounds < 2) {
    stage.position_step = std::clamp(2 * errors.head<3>().norm(), 3.0, 10.0);
    stage.direction_step = std::clamp(2 * errors.segment<2>(3).norm(), 4 * degree, 18 * degree);
    stage.oversize = options_.oversize;
    stage.photons = useful_photons(cascade_of(end.light, options_.kind), 6, 4e6, 2e7);
    const RoundEnd now = round(end.light, stage);
    ++fine_rounds;
    end.light = now.light;
    information = now.fit.information;
    errors = now.errors;
    end.trouble.clear();
    if (!errors.allFinite())
      end.trouble = "the data do not determine all seven numbers";
    else if (!now.within)
      end.trouble = "the fit was still moving away after the last round";
    else if (now.pull >= largest_pull)
      end.trouble = "the last step was still larger than its error";
    if (end.trouble.empty() && fine_rounds >= 2) break;
  }
  end.converged = end.trouble.empty();
  end.covariance = final_covariance(end.light, stage, information);
  return end;
}

Search::End Search::from(const CascadeParameters& start) {
  return refine(light_centre(start, options_.kind));
}

Search::End Search::from_scratch(const PointSeed& point) {
  ScanOptions scan;
  scan.kind = options_.kind;
  scan.photons *= options_.effort;
  scan.oversize = std::max(15.0, options_.oversize);
  scan.first_stream = stream_;
  stream_ += static_cast<std::uint64_t>(scan.directions);
  const auto candidates = scan_directions(light_, data_, ice_, point, scan, [&](double done) {
    if (progress_) progress_(scan_share * done, "trying directions");
  });
  result_.simulations += candidates.size();
  result_.photons += static_cast<std::uint64_t>(scan.photons * double(candidates.size()));
  return refine(best_of_two(candidates));
}

}  // namespace floe
