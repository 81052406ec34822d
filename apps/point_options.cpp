#include "apps/point_options.h"

#include <fmt/format.h>

#include "apps/option_values.h"
#include "data/base/error.h"

namespace floe {

namespace {

Vec3 parse_place(const std::string& option, const std::string& text) {
  const auto parts = split_list(text);
  if (parts.size() != 3)
    throw UsageError(
        fmt::format("{}: found \"{}\"; expected 3 numbers without blanks: x,y,z [m]", option, text));
  Vec3 place;
  for (int i = 0; i < 3; ++i)
    place[i] = parse_option_number(option, parts[static_cast<std::size_t>(i)], {-1e5, 1e5});
  return place;
}

}  // namespace

Json to_json(const MeasuredCurve& curve, double unit) {
  Json points = Json::array();
  for (const auto& [at, intensity] : curve.points()) points.push_back({at / unit, intensity});
  return points;
}

Json to_json(const PointRequest& request) {
  const LaserSettings& light = request.light;
  Json json = {{"x", light.position.x()},
               {"y", light.position.y()},
               {"z", light.position.z()},
               {"time_ns", light.time},
               {"wavelength_nm", light.wavelength}};
  if (request.emitted)
    json["emitted"] = *request.emitted;
  else
    json["photons"] = light.photons;
  json["isotropic"] = light.isotropic;
  if (!light.isotropic) {
    json["axis"] = {light.axis.x(), light.axis.y(), light.axis.z()};
    json["opening_deg"] = light.opening / degree;
  }
  if (light.pulse) json["pulse"] = to_json(*light.pulse);
  return json;
}

void add_point_options(CLI::App& app, PointOptions& options) {
  auto* point = app.add_option("--point", options.point,
                               "Light from a place [m] into all directions alike; with --opening on a cone")
                    ->type_name("X,Y,Z");
  auto* candle =
      app.add_option("--standard-candle", options.candle,
                     "Light of a nitrogen laser, 337 nm, on a cone that opens upwards at the Cherenkov angle")
          ->type_name("X,Y,Z");
  point->excludes(candle);
  add_number(app, "--emitted", "N", positive,
             "Photons that leave the point or candle, in place of --photons, which counts those that "
             "a nominal module would accept",
             [&options](double n) { options.emitted = n; });
  add_number(app, "--opening", "DEG", {0, 180}, "Between axis and light of the cone of a point or candle",
             [&options](double angle) { options.opening_deg = angle; });
  app.add_option_function<std::string>(
         "--beam", [&options](const std::string& file) { options.beam = read_beam_profile(file); },
         "Measured beam of the flasher in place of --width: lines of angle to its axis [deg] and relative "
         "intensity")
      ->type_name("FILE");
  app.add_option_function<std::string>(
         "--pulse", [&options](const std::string& file) { options.pulse = read_pulse_shape(file); },
         "Measured pulse of the flasher, point or candle: lines of time [ns] and relative intensity")
      ->type_name("FILE");
}

PointRequest point_request(const PointOptions& options) {
  const bool candle = !options.candle.empty();
  const std::string name = candle ? "--standard-candle" : "--point";
  if (options.photons.has_value() == options.emitted.has_value())
    throw UsageError(fmt::format("{} needs one of --photons N and --emitted N, e.g. --emitted 1e12", name));
  PointRequest request;
  request.id = candle ? "standard-candle" : "point";
  request.emitted = options.emitted;
  LaserSettings& light = request.light;
  light.position = parse_place(name, candle ? options.candle : options.point);
  light.time = options.time.value_or(0);
  light.photons = options.photons.value_or(0);
  light.wavelength = options.wavelength.value_or(candle ? nitrogen_laser_wavelength : 405);
  light.isotropic = !candle && !options.opening_deg;
  light.opening = options.opening_deg ? *options.opening_deg * degree
                  : candle            ? cherenkov_angle(light.wavelength)
                                      : 0;
  if (light.isotropic && (options.elevation_deg || options.azimuth_deg))
    throw UsageError("--point shines into all directions: a direction needs --opening, 0 for a pencil");
  light.axis = unit_vector(pi / 2 - options.elevation_deg.value_or(90) * degree,
                           options.azimuth_deg.value_or(0) * degree);
  light.pulse = options.pulse;
  return request;
}

}  // namespace floe
