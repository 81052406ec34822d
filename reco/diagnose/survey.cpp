#include "reco/diagnose/survey.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "data/base/error.h"
#include "reco/diagnose/displaced_strings.h"
#include "reco/diagnose/place_columns.h"
#include "reco/ice_fit/ice_point.h"
#include "reco/ice_fit/smooth_slopes.h"

namespace floe {

namespace {

constexpr std::uint64_t first_stream = std::uint64_t{1} << 42, streams_a_run = 1 << 10,
                        streams_a_survey = 1 << 20;

// Pairs of a survey have light enough; see IcePoint.
constexpr double turns_from = std::numeric_limits<double>::infinity();

using Kind = SurveyColumn::Kind;

// Slopes of ln(light) in a run's bins, of one fold.
struct RunSlopes {
  Eigen::MatrixXd parameters;  // bins x parameters
  Eigen::MatrixXd raw;         // the same, as simulated: right on average, but noisy
  PlaceSlopes places;
  PlaceSlopes raw_places;  // likewise; without the delay
};

// Slopes without what brightness and time zero could do.
Eigen::MatrixXd projected(const Eigen::MatrixXd& slopes, const Eigen::MatrixXd& nuisance,
                          const Eigen::ArrayXd& weight) {
  const Eigen::MatrixXd weighted = nuisance.array().colwise() * weight;
  const Eigen::MatrixXd normal = nuisance.transpose() * weighted;
  return slopes - nuisance * normal.ldlt().solve(weighted.transpose() * slopes);
}

class Surveyor {
 public:
  Surveyor(const Model& model, const FlasherData& data, const FirstLook& look, const SurveyPlan& plan,
           const RunSettings& settings, const Progress& progress)
      : data_(data),
        look_(look),
        plan_(plan),
        settings_(settings),
        progress_(progress),
        point_(model, plan.parameters, starts(plan.parameters), data.runs.front().run.wavelength,
               turns_from) {}

  Survey run() {
    for (std::size_t r = 0; r < data_.runs.size(); ++r) look_at(r);
    if (survey_.bins == 0)
      throw NoResult("not enough light: no receiver of any flasher run sees enough to be compared");
    for (std::size_t p = 0; p < plan_.parameters.size(); ++p)
      survey_.columns.push_back({Kind::parameter, p, 0, 0});
    if (plan_.places) {
      const std::vector<SurveyColumn> places = place_columns(survey_.runs, detector());
      survey_.columns.insert(survey_.columns.end(), places.begin(), places.end());
    }
    add_up();
    return std::move(survey_);
  }

 private:
  const Detector& detector() const { return *point_.model().detector; }

  static std::vector<double> starts(const std::vector<IceParameter>& parameters) {
    std::vector<double> numbers;
    for (const IceParameter& parameter : parameters) numbers.push_back(parameter.start);
    return numbers;
  }

  RunRequest request(std::size_t r, std::uint64_t purpose, double photons) const {
    return request_of(data_.runs[r], settings_, photons,
                      first_stream + plan_.stream * streams_a_survey + r * streams_a_run + purpose,
                      look_.brightness[r]);
  }

  void look_at(std::size_t r) {
    const RunData& run = data_.runs[r];
    if (progress_)
      progress_(static_cast<double>(r) / static_cast<double>(data_.runs.size()),
                fmt::format("light of {} and all that could change it", run.name));
    const double photons = photons_wanted(run, look_.hits_per_photon[r], settings_.light);
    const double brightness = look_.brightness[r];
    const auto [bins, scouted_time, scouted] =
        view_run(point_.model(), request(r, 0, photons), run, brightness, settings_.model_error);

    SimulatedRun simulated = simulate_run(point_.model(), request(r, 1, photons));
    survey_.photons += scouted + simulated.propagated;
    const RunMeasurement measured =
        measure_run_finely(simulated, photons, run, bins, {brightness, scouted_time}, settings_.model_error);
    const double time_zero = measured.nuisances.time_zero;
    delay(simulated, time_zero);
    SurveyRun result;
    result.name = run.name;
    result.data = run;
    result.bins = bins;
    result.first = survey_.bins;
    result.nuisances = {measured.nuisances.brightness, time_zero};
    result.photons = photons;
    result.scale = measured.nuisances.brightness / photons;
    result.dispersion = dispersion(simulated);
    result.model_error = settings_.model_error;
    result.draws = PhotonDraws(simulated, bins, result.scale, run.run.oversize > 1, run.charge_dispersion,
                               result.model_error);
    result.data_dispersion = (run.run.oversize > 1 ? result.dispersion : 1) * run.charge_dispersion;
    measure_slopes(request(r, 1, photons), simulated, result);
    survey_.bins += bins.size();
    survey_.runs.push_back(std::move(result));
  }

  void measure_slopes(const RunRequest& request, const SimulatedRun& simulated, SurveyRun& run) {
    const double time_zero = run.nuisances.time_zero;
    const PairPlan pairs{plan_.pair_reach, plan_.pair_light, plan_.least_pair_hits, plan_.one_sided, 1};
    const auto [light, propagated] = point_.light(request, simulated, run.bins, time_zero, pairs);
    survey_.photons += propagated;
    run.counts = {run.data.counts(run.bins), {light.folds[0].counts, light.folds[1].counts}};
    RunSlopes slopes[2];
    const SmoothSlopes smooth = smooth_slopes(light.folds, light.places, light.symmetric);
    for (std::size_t fold = 0; fold < 2; ++fold) {
      slopes[fold].parameters = smooth.fold[fold];
      slopes[fold].raw = light.folds[fold].slopes.array().colwise() / light.folds[fold].counts.array().max(1);
    }
    independent_ = light.independent;
    if (plan_.places) {
      RunRequest other = request;
      other.stream += 2;
      const DisplacedStrings displaced =
          displaced_strings(point_.model(), other, run.bins, time_zero, light,
                            pairs.share(run.counts.simulated[0].sum() + run.counts.simulated[1].sum()));
      survey_.photons += displaced.propagated;
      for (std::size_t fold = 0; fold < 2; ++fold) {
        slopes[fold].places.displacement = displaced.fold[fold];
        slopes[fold].raw_places.displacement = displaced.raw[fold];
      }
    }
    const Eigen::ArrayXd both = run.counts.simulated[0] + run.counts.simulated[1];
    run.expected = run.scale * both;
    run.trust = 1 / (1 + run.expected * (1 / both.max(1) + settings_.model_error * settings_.model_error));
    const Eigen::ArrayXd delay = (light.folds[0].delay + light.folds[1].delay).array() / both.max(1);
    run.nuisance.resize(run.bins.size(), 2);
    run.nuisance << Eigen::VectorXd::Ones(run.bins.size()), delay.matrix();
    for (RunSlopes& fold : slopes) {
      fold.places.delay = delay.matrix();
      slopes_.push_back(std::move(fold));
    }
  }

  void add_up() {
    const auto size = static_cast<Eigen::Index>(survey_.columns.size());
    const auto parameters = static_cast<Eigen::Index>(plan_.parameters.size());
    survey_.information = Eigen::MatrixXd::Zero(size, size);
    survey_.noise = survey_.information;
    of_slopes_ = Eigen::VectorXd::Zero(size);
    for (std::size_t r = 0; r < survey_.runs.size(); ++r) {
      SurveyRun& run = survey_.runs[r];
      for (std::size_t fold = 0; fold < 2; ++fold) {
        const RunSlopes& slopes = slopes_[2 * r + fold];
        Eigen::MatrixXd all(run.bins.size(), size);
        all.leftCols(parameters) = slopes.parameters;
        for (Eigen::Index c = parameters; c < size; ++c)
          all.col(c) =
              place_slope(survey_.columns[static_cast<std::size_t>(c)], run, slopes.places, detector());
        run.halves[fold] = projected(all, run.nuisance, run.trust * run.expected);
      }
      set_weights(run);
      add_run(run);
      of_slopes_ += own_information(run, slopes_[2 * r], slopes_[2 * r + 1]);
    }
    scale_to_slopes();
    survey_.information = (survey_.information + survey_.information.transpose()).eval() / 2;
  }

  // Where pairs have photons of their own, both halves of theirs may serve.
  void set_weights(SurveyRun& run) const {
    run.weights = run.halves;
    for (std::size_t c = 0; c < survey_.columns.size(); ++c) {
      const SurveyColumn& column = survey_.columns[c];
      const bool of_pairs = column.kind == Kind::parameter ? bool(independent_[column.parameter])
                                                           : is_displacement(column.kind);
      if (!of_pairs) continue;
      const auto i = static_cast<Eigen::Index>(c);
      run.weights[0].col(i) = run.weights[1].col(i) = (run.halves[0].col(i) + run.halves[1].col(i)) / 2;
    }
  }

  // Whether its slopes are simulated, and shrunk as their noise demands.
  bool is_shrunk(const SurveyColumn& column) const {
    return column.kind == Kind::parameter || is_displacement(column.kind);
  }
  Eigen::VectorXd raw_slope(const SurveyColumn& column, const SurveyRun& run, const RunSlopes& slopes) const {
    if (column.kind == Kind::parameter) return slopes.raw.col(static_cast<Eigen::Index>(column.parameter));
    return place_slope(column, run, slopes.raw_places, detector());
  }
  // By column: what the diagonal of the information would be with slopes as simulated, right on average, in
  // place of one of the two halves.
  Eigen::VectorXd own_information(const SurveyRun& run, const RunSlopes& even, const RunSlopes& odd) const {
    const Eigen::ArrayXd light = run.trust * run.expected;
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(run.halves[0].cols());
    for (Eigen::Index c = 0; c < sums.size(); ++c) {
      const SurveyColumn& column = survey_.columns[static_cast<std::size_t>(c)];
      if (!is_shrunk(column)) continue;
      sums(c) = (light * (run.halves[0].col(c).array() * raw_slope(column, run, odd).array() +
                          run.halves[1].col(c).array() * raw_slope(column, run, even).array()))
                    .sum() /
                2;
    }
    return sums;
  }

  // Whose slopes are shrunk alike: layers of a family, strings that flash and strings that do not.
  std::string group_of(const SurveyColumn& column) const {
    if (column.kind == Kind::parameter) {
      const IceParameter& parameter = plan_.parameters[column.parameter];
      return parameter.family.empty() ? parameter.name : parameter.family;
    }
    const bool flashes = std::any_of(survey_.runs.begin(), survey_.runs.end(), [&](const SurveyRun& run) {
      return run.data.run.module.string == column.string;
    });
    return fmt::format("{} of {}", static_cast<int>(column.kind), flashes ? "flashers" : "receivers");
  }

  // Weights are shrunk where slopes are noisy. Scaled back, they are what the slopes are on average, and
  // amplitudes come out right.
  void scale_to_slopes() {
    constexpr double least = 0.3, most = 3;  // weights further off are of no use
    // Columns of a group one by one would be too noisy.
    std::map<std::string, std::vector<Eigen::Index>> groups;
    for (std::size_t c = 0; c < survey_.columns.size(); ++c)
      if (is_shrunk(survey_.columns[c]))
        groups[group_of(survey_.columns[c])].push_back(static_cast<Eigen::Index>(c));
    Eigen::VectorXd factor = Eigen::VectorXd::Ones(survey_.information.cols());
    for (const auto& [name, columns] : groups) {
      const double information = survey_.information.diagonal()(columns).sum();
      if (information > 0)
        factor(columns).setConstant(std::clamp(of_slopes_(columns).sum() / information, least, most));
    }
    for (SurveyRun& run : survey_.runs)
      for (auto* both : {&run.halves, &run.weights})
        for (Eigen::MatrixXd& weights : *both) weights = weights * factor.asDiagonal();
    survey_.information = factor.asDiagonal() * survey_.information * factor.asDiagonal();
    survey_.noise = factor.asDiagonal() * survey_.noise * factor.asDiagonal();
  }

  void add_run(const SurveyRun& run) {
    const auto weighted = [&](const Eigen::MatrixXd& w, const Eigen::ArrayXd& variance) {
      return Eigen::MatrixXd(w.array().colwise() * (variance * run.trust.square()).sqrt());
    };
    const auto add_noise = [&](const Eigen::MatrixXd& w, const Eigen::ArrayXd& variance) {
      const Eigen::MatrixXd root = weighted(w, variance);
      survey_.noise.noalias() += root.transpose() * root;
    };
    const Eigen::MatrixXd light = run.halves[1].array().colwise() * (run.trust * run.expected);
    survey_.information.noalias() += run.halves[0].transpose() * light;
    // The half that weights come from does not judge them: each half's expectation stands for all the light.
    for (std::size_t fold = 0; fold < 2; ++fold)
      add_noise(run.weights[fold],
                run.dispersion * run.scale * run.scale * run.counts.simulated[1 - fold].array());
    const double known = run.model_error * run.model_error;
    add_noise((run.weights[0] + run.weights[1]) / 2,
              run.data_dispersion * run.expected + known * run.expected.square());
  }

  const FlasherData& data_;
  const FirstLook& look_;
  const SurveyPlan& plan_;
  const RunSettings& settings_;
  const Progress& progress_;
  IcePoint point_;
  Survey survey_;
  std::vector<RunSlopes> slopes_;  // of each run, even and odd photons
  std::vector<char> independent_;  // by parameter: its pairs have photons of their own
  Eigen::VectorXd of_slopes_;      // by column; see own_information
};

}  // namespace

SurveyCounts measured_counts(const Survey& survey) {
  SurveyCounts counts;
  for (const SurveyRun& run : survey.runs) counts.push_back(run.counts);
  return counts;
}

SurveyCounts drawn_counts(const Survey& survey, std::uint64_t seed, std::uint64_t draw) {
  SurveyCounts counts;
  std::seed_seq sequence{seed, seed >> 32, draw, draw >> 32};  // which takes 32 bits of each
  std::mt19937_64 random(sequence);
  for (const SurveyRun& run : survey.runs) counts.push_back(run.draws.draw(random));
  return counts;
}

Eigen::VectorXd gap_of(const Survey& survey, const SurveyCounts& counts) {
  Eigen::VectorXd gap = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(survey.columns.size()));
  for (std::size_t r = 0; r < survey.runs.size(); ++r) {
    const SurveyRun& run = survey.runs[r];
    for (std::size_t fold = 0; fold < 2; ++fold) {
      const Eigen::ArrayXd expected = 2 * run.scale * counts[r].simulated[1 - fold].array();
      gap += run.weights[fold].transpose() * (run.trust * (counts[r].data.array() - expected)).matrix() / 2;
    }
  }
  return gap;
}

std::vector<double> neg_llh_of(const Survey& survey, const SurveyCounts& counts) {
  std::vector<double> sums;
  for (std::size_t r = 0; r < survey.runs.size(); ++r) {
    const SurveyRun& run = survey.runs[r];
    const Eigen::VectorXd simulated = counts[r].simulated[0] + counts[r].simulated[1];
    sums.push_back(measure_counts({counts[r].data, simulated / run.dispersion, run.photons / run.dispersion},
                                  run.nuisances.brightness, run.model_error)
                       .neg_llh);
  }
  return sums;
}

Eigen::VectorXd expected_of(const Survey& survey) {
  Eigen::VectorXd expected(survey.bins);
  for (const SurveyRun& run : survey.runs) expected.segment(run.first, run.bins.size()) = run.expected;
  return expected;
}

Eigen::VectorXd residual_of(const Survey& survey, const SurveyCounts& counts) {
  Eigen::VectorXd residual(survey.bins);
  for (std::size_t r = 0; r < survey.runs.size(); ++r) {
    const SurveyRun& run = survey.runs[r];
    const Eigen::ArrayXd off =
        counts[r].data.array() - run.scale * (counts[r].simulated[0] + counts[r].simulated[1]).array();
    const Eigen::ArrayXd relative = off / run.expected.max(1e-9);
    residual.segment(run.first, run.bins.size()) =
        projected(relative.matrix(), run.nuisance, run.trust * run.expected).array() * run.expected;
  }
  return residual;
}

Survey survey_data(const Model& model, const FlasherData& data, const FirstLook& look, const SurveyPlan& plan,
                   const RunSettings& settings, const Progress& progress) {
  return Surveyor(model, data, look, plan, settings, progress).run();
}

}  // namespace floe
