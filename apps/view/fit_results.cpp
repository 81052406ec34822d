#include "apps/view/fit_results.h"

#include <fmt/format.h>

#include <cmath>

#include "data/base/error.h"
#include "data/base/text.h"

namespace floe {

namespace {

constexpr const char* expected = "the JSON of floe reconstruct --json or floe compare --json";

Json parsed(const std::string& file) {
  try {
    return Json::parse(read_whole_file(file));
  } catch (const Json::exception& error) {
    throw InputError({file}, fmt::format("what is not JSON ({})", error.what()), expected);
  }
}

Json errors_of(const Json& fit) {
  Json errors = Json::array();
  if (!fit.contains("covariance") || !fit.at("covariance").is_array()) return errors;
  for (std::size_t i = 0; i < 7; ++i)
    errors.push_back(std::sqrt(fit.at("covariance").at(i).at(i).get<double>()));
  return errors;
}

FittedCascade fitted(const Json& fit, const std::string& label) {
  return {label,
          fit.at("x").get<double>(),
          fit.at("y").get<double>(),
          fit.at("z").get<double>(),
          fit.at("time_ns").get<double>(),
          fit.at("zenith_deg").get<double>(),
          fit.at("azimuth_deg").get<double>(),
          fit.at("energy_gev").get<double>(),
          errors_of(fit)};
}

FitResults results_of(const Json& event) {
  FitResults results{event.value("status", "ok"), {}};
  if (event.contains("fit") && event.at("fit").is_object())
    results.fits.push_back(fitted(event.at("fit"), "fit"));
  if (event.contains("fits")) {
    const char* const labels[] = {"fit A", "fit B"};
    for (std::size_t i = 0; i < 2; ++i)
      if (event.at("fits").at(i).is_object())
        results.fits.push_back(fitted(event.at("fits").at(i), labels[i]));
  }
  return results;
}

}  // namespace

FitResults read_fit_results(const std::string& file, const std::string& event) {
  const Json content = parsed(file);
  std::string known;
  try {
    for (const Json& entry : content.at("events")) {
      // Of several files, the event's name begins with its file's.
      const auto name = entry.at("event").get<std::string>();
      if (name == event || name.ends_with(":" + event)) return results_of(entry);
      known += (known.empty() ? "" : ", ") + name;
    }
  } catch (const Json::exception& error) {
    throw InputError({file}, fmt::format("other JSON ({})", error.what()), expected);
  }
  throw InputError({file}, fmt::format("no event '{}', but {}", event, known.empty() ? "none" : known),
                   "the event that is shown", "Fit it, or name another with --event");
}

}  // namespace floe
