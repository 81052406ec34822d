#include "data/event_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "data/base/text.h"

namespace floe {

namespace {

constexpr std::array<std::string_view, 19> particle_names = {
    "e",   "e-",  "e+", "gamma", "delta", "brems", "epair", "hadr", "munu", "pi+",
    "pi-", "K0L", "p",  "n",     "pbar",  "amu",   "amu+",  "amu-", "ph"};

Problem number_problem(std::string_view what, double value, std::string_view expected) {
  return {fmt::format("{} {}{}", what, value, std::isfinite(value) ? "" : " (not finite)"),
          std::string(expected)};
}

std::optional<Problem> direction_problem(std::string_view what, const Vec3f& direction) {
  constexpr float tolerance = 1e-3f;
  const bool unknown = std::isnan(direction.x()) && std::isnan(direction.y()) && std::isnan(direction.z());
  if (unknown || std::abs(direction.norm() - 1) <= tolerance) return {};
  return Problem{fmt::format("{} ({}, {}, {})", what, direction.x(), direction.y(), direction.z()),
                 "a unit vector, or NaN in all three components when unknown"};
}

std::optional<Problem> module_problem(ModuleId module) {
  if (module.string < 1 || module.string > largest_string)
    return Problem{fmt::format("string {}", module.string), fmt::format("1 to {}", largest_string)};
  if (module.dom < 1 || module.dom > largest_dom)
    return Problem{fmt::format("DOM {}", module.dom), fmt::format("1 to {}", largest_dom)};
  return {};
}

constexpr double degree_rounding = 1 + 1e-12;  // of a conversion from degrees

}  // namespace

std::optional<Problem> problem_of(const Hit& hit) {
  if (auto problem = module_problem(hit.module)) return problem;
  if (!std::isfinite(hit.time)) return number_problem("time", hit.time, "a finite time [ns]");
  if (!std::isfinite(hit.charge) || hit.charge <= 0)
    return number_problem("charge", hit.charge, "a finite charge above 0 [photoelectrons]");
  if (!std::isnan(hit.wavelength) && (!std::isfinite(hit.wavelength) || hit.wavelength <= 0))
    return number_problem("wavelength", hit.wavelength, "a wavelength above 0 [nm], or NaN when unknown");
  if (auto problem = direction_problem("photon direction", hit.direction)) return problem;
  if (!std::isnan(hit.width) && !(hit.width >= 0 && std::isfinite(hit.width)))
    return number_problem("width", hit.width, "a width of 0 or more [ns], or NaN when unknown");
  return direction_problem("direction to the module's centre", hit.inward);
}

std::optional<Problem> problem_of(const Particle& particle) {
  if (!is_particle_name(particle.name))
    return Problem{"particle " + in_quotes(particle.name), "one of " + known_particle_names()};
  if (!particle.position.allFinite())
    return Problem{fmt::format("position ({}, {}, {})", particle.position.x(), particle.position.y(),
                               particle.position.z()),
                   "finite coordinates [m]"};
  if (!(particle.zenith >= 0 && particle.zenith <= pi * degree_rounding))
    return number_problem("zenith", particle.zenith / degree, "0 to 180 [deg]");
  if (!(particle.azimuth >= 0 && particle.azimuth <= 2 * pi * degree_rounding))
    return number_problem("azimuth", particle.azimuth / degree, "0 to 360 [deg]");
  if (!std::isfinite(particle.length) || particle.length < 0)
    return number_problem("length", particle.length, "a finite length, not negative [m]");
  if (!std::isfinite(particle.energy) || particle.energy <= 0)
    return number_problem("energy", particle.energy, "a finite energy above 0 [GeV]");
  if (!std::isfinite(particle.time)) return number_problem("time", particle.time, "a finite time [ns]");
  return {};
}

std::optional<Problem> problem_of(const FlasherRun& run) {
  if (auto problem = module_problem(run.module)) return problem;
  if (!run.leds.valid()) return Problem{"LEDs " + name_of(run.leds), std::string(known_led_patterns)};
  if (!std::isnan(run.orientation) && !(std::abs(run.orientation) <= 2 * pi * degree_rounding))
    return number_problem("orientation", run.orientation / degree,
                          "-360 to 360 [deg], the azimuth of LED 1 and of LED 7");
  if (!(run.wavelength >= 300 && run.wavelength <= 600))
    return number_problem("wavelength", run.wavelength, "300 to 600 [nm]");
  if (!(run.beam_width >= 0 && run.beam_width <= pi / 2 * degree_rounding))
    return number_problem("beam width", run.beam_width / degree, "0 to 90 [deg]");
  if (!(run.pulse_width >= 0 && run.pulse_width <= 1000))
    return number_problem("pulse width", run.pulse_width, "0 to 1000 [ns]");
  if (!std::isnan(run.photons) && (!std::isfinite(run.photons) || run.photons <= 0))
    return number_problem("number of photons", run.photons, "a finite number above 0");
  if (!(run.oversize >= 1 && run.oversize <= 100))
    return number_problem("oversize", run.oversize, "1 to 100 (1: measured)");
  return {};
}

std::optional<Problem> problem_of_event(std::string_view id, double repeats) {
  const bool controls =
      std::any_of(id.begin(), id.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  if (id.empty() || id.size() > longest_event_id || controls)
    return Problem{"event name " + in_quotes(id),
                   fmt::format("1 to {} bytes without control characters", longest_event_id)};
  if (!std::isfinite(repeats) || repeats <= 0)
    return number_problem("number of repeats", repeats, "a finite number above 0");
  return {};
}

std::string event_name_of(const std::filesystem::path& file) {
  const std::filesystem::path plain = file.extension() == ".gz" ? file.stem() : file.filename();
  return plain.stem().string().substr(0, longest_event_id);
}

std::string text_suffix_of(const std::filesystem::path& file) {
  return (file.extension() == ".gz" ? file.stem() : file).extension().string();
}

bool is_particle_name(std::string_view name) {
  return std::find(particle_names.begin(), particle_names.end(), name) != particle_names.end();
}

std::string known_particle_names() {
  return fmt::format("{}", fmt::join(particle_names, ", "));
}

}  // namespace floe
