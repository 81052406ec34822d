#include "apps/view/fit_results.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

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

// Standard deviations; none where they are not known.
Json errors_of(const Json& fit) {
  Json errors = Json::array();
  const auto covariance = fit.find("covariance");
  if (covariance == fit.end() || !covariance->is_array()) return errors;
  for (std::size_t i = 0; i < 7; ++i) {
    const Json& variance = covariance->at(i).at(i);
    if (!variance.is_number()) return Json::array();
    errors.push_back(std::sqrt(variance.get<double>()));
  }
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

// A fit that found nothing has nulls for its values.
void add_fit(const Json& fit, const std::string& label, FitResults& results) {
  if (fit.is_object() && fit.at("x").is_number()) results.fits.push_back(fitted(fit, label));
}

FitResults results_of(const Json& event) {
  FitResults results{event.at("status").get<std::string>(), {}};
  if (const std::string reason = event.value("reason", ""); !reason.empty()) results.status += ": " + reason;
  if (event.contains("fits")) {
    add_fit(event.at("fits").at(0), "fit A", results);
    add_fit(event.at("fits").at(1), "fit B", results);
  } else {
    add_fit(event.at("fit"), "fit", results);
  }
  return results;
}

// Whether this is the name of the event: alone, or after that of its file, which may have been given by
// another path.
bool is_name_of(const std::string& name, const std::string& events, const std::string& event) {
  if (name == event) return true;
  if (!name.ends_with(":" + event)) return false;
  const std::filesystem::path file = name.substr(0, name.size() - event.size() - 1);
  return file.filename() == std::filesystem::path(events).filename();
}

}  // namespace

FitResults read_fit_results(const std::string& file, const std::string& events, const std::string& event) {
  const Json content = parsed(file);
  std::string known;
  try {
    for (const Json& entry : content.at("events")) {
      const auto name = entry.at("event").get<std::string>();
      if (is_name_of(name, events, event)) return results_of(entry);
      known += (known.empty() ? "" : ", ") + name;
    }
  } catch (const Json::exception& error) {
    throw InputError({file}, fmt::format("other JSON ({})", error.what()), expected);
  }
  throw InputError({file}, fmt::format("no event '{}', but {}", event, known.empty() ? "none" : known),
                   "the event that is shown", "Fit it, or name another with --event");
}

}  // namespace floe
