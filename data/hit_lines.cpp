#include "data/hit_lines.h"

#include "data/event_rules.h"

namespace floe {

namespace {

constexpr long clipped(long value) {
  constexpr long beyond = 1'000'000;  // out of every range, and safe to narrow
  return value < -beyond ? -beyond : value > beyond ? beyond : value;
}

int parse_string(const TextLine& line, std::size_t field) {
  return static_cast<int>(clipped(parse_integer(line, field, "string")));
}

int parse_dom(const TextLine& line, std::size_t field) {
  const std::string& text = line.fields.at(field);
  const auto separator = text.find('_');
  if (separator == text.npos) return static_cast<int>(clipped(parse_integer(line, field, "DOM")));
  const TextLine parts{line.where, line.text, {text.substr(0, separator), text.substr(separator + 1)}};
  parse_integer(parts, 1, "PMT of DOM_PMT");
  return static_cast<int>(clipped(parse_integer(parts, 0, "DOM of DOM_PMT")));
}

Vec3f parse_direction(const TextLine& line, std::size_t field, std::string_view theta_name,
                      std::string_view phi_name) {
  // Angles rounded to 1 mrad may lie this much beyond their range; degrees lie far beyond.
  constexpr double rounding = 1e-3;
  const double theta = parse_number(line, field, theta_name);
  const double phi = parse_number(line, field + 1, phi_name);
  expect_range(line, theta, 0, pi + rounding, theta_name);
  expect_range(line, phi, -2 * pi - rounding, 2 * pi + rounding, phi_name);
  return unit_vector(theta, phi).cast<float>();
}

Hit checked(const Hit& hit, const TextLine& line) {
  if (const auto problem = problem_of(hit)) throw InputError(line.where, problem->found, problem->expected);
  return hit;
}

}  // namespace

ModuleId parse_module(const TextLine& line, std::size_t field) {
  return {parse_string(line, field), parse_dom(line, field + 1)};
}

Hit parse_hit_line(const TextLine& line) {
  expect_fields(line, 9, 9, hit_layout);
  Hit hit;
  hit.module = parse_module(line, 1);
  hit.time = parse_number(line, 3, "time [ns]");
  hit.wavelength = static_cast<float>(parse_number(line, 4, "wavelength [nm]"));
  hit.direction = parse_direction(line, 5, "p_theta [rad]", "p_phi [rad]");
  hit.inward = parse_direction(line, 7, "d_theta [rad]", "d_phi [rad]");
  return checked(hit, line);
}

Hit parse_charge_line(const TextLine& line) {
  expect_fields(line, 4, 4, charge_layout);
  Hit hit;
  hit.module = parse_module(line, 0);
  hit.time = parse_number(line, 2, "time [ns]");
  hit.charge = static_cast<float>(parse_number(line, 3, "charge [pe]"));
  return checked(hit, line);
}

}  // namespace floe
