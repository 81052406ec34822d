#include "apps/model_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "data/base/constants.h"

namespace floe {

namespace {

std::string on_parts(const BirefringenceNumbers& numbers) {
  std::string parts;
  const auto name = [&parts](bool on, const char* part) {
    if (on) parts += (parts.empty() ? "" : ", ") + std::string(part);
  };
  name(numbers.diffusion, "diffusion");
  name(numbers.deflection, "deflection");
  name(numbers.displacement, "displacement");
  return parts.empty() ? "none" : parts;
}

template <typename Get>
std::string range_over_layers(const IceModel& ice, Get get) {
  std::vector<double> values;
  for (const IceLayer& layer : ice.layers()) values.push_back(get(layer));
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *low == *high ? fmt::format("{:.4g}", *low) : fmt::format("{:.4g} to {:.4g}", *low, *high);
}

std::vector<SummaryLine> birefringence_lines(const IceModel& ice) {
  if (!ice.birefringence()) return {{"birefringence", "off"}};
  const BirefringenceNumbers& numbers = *ice.birefringence();
  std::vector<SummaryLine> lines{{"birefringence", on_parts(numbers)}};
  const auto function = [](const DiffusionFunction& f) {
    return fmt::format("A {:.6g}, B {:.10g}, C {:.7g}, D {:.7g}", f.A, f.B, f.C, f.D);
  };
  lines.push_back({"  sigma_x", function(numbers.sigma_x)});
  lines.push_back({"  sigma_y", function(numbers.sigma_y)});
  lines.push_back({"  m_x", function(numbers.mean_x)});
  lines.push_back(
      {"  strength",
       range_over_layers(ice, [](const IceLayer& l) { return l.diffusion_strength; }) + " (deflection " +
           range_over_layers(ice, [](const IceLayer& l) { return l.deflection_strength; }) + ")"});
  lines.push_back(
      {"  mean scattering", fmt::format("{:.4g} /m at strength 1", ice.birefringent_scattering())});
  return lines;
}

std::string scattering_anisotropy(const IceModel& ice) {
  const auto along = [](const IceLayer& l) { return l.k1; };
  const auto across = [](const IceLayer& l) { return l.k2; };
  const bool on = std::any_of(ice.layers().begin(), ice.layers().end(),
                              [](const IceLayer& l) { return l.k1 != 0 || l.k2 != 0; });
  if (!on) return "off";
  return fmt::format("k1 {}, k2 {}, absorption scaled by {:g}", range_over_layers(ice, along),
                     range_over_layers(ice, across), ice.old_absorption_scaling());
}

std::string absorption_anisotropy(const IceModel& ice) {
  const auto& K = ice.absorption_anisotropy();
  if (K == std::array<double, 3>{1, 1, 1}) return "off";
  return fmt::format("absorption x {:.3f} along the flow, {:.3f} across, {:.3f} vertical", 1 / K[0], 1 / K[1],
                     1 / K[2]);
}

std::string tilt(const IceTables& tables) {
  if (tables.tilt_map)
    return fmt::format("2D map, {} grid points x {} depths", tables.tilt_map->shifts.at(0).size(),
                       tables.tilt_map->depths.size());
  if (tables.tilt_lines)
    return fmt::format("1D, {} columns x {} depths", tables.tilt_lines->distances.size(),
                       tables.tilt_lines->depths.size());
  return "off";
}

std::string hole_ice(const HoleIce& hole) {
  if (hole.radius == 0) return "off";
  return fmt::format("radius {:g} module radii, effective scattering length {:g} m, absorption length {:g} m",
                     hole.radius, hole.effective_scattering_length, hole.absorption_length);
}

std::string version_words(int version) {
  if (version == 10) return "10: the crystals' share is not taken out of the scattering";
  if (version == 20) return "20: the table holds all scattering and absorption at 400 nm";
  return fmt::format("{}: the crystals' share is taken out of the table's scattering", version);
}

std::string angular_words(const AngularAcceptance& angular) {
  if (angular.is_surface())
    return fmt::format("by place of impact: -z above {:g} of the sphere", angular.cut());
  return fmt::format("polynomial of degree {}, maximum {:g}", angular.coefficients().size() - 1,
                     angular.maximum());
}

}  // namespace

double layer_depth(const IceModel& ice, int layer) {
  return origin_depth - (ice.z_bottom() + (layer + 0.5) * ice.layer_step());
}

std::vector<SummaryLine> ice_lines(const IceModel& ice, bool idealised) {
  const IceTables& tables = ice.tables();
  const int count = static_cast<int>(ice.layers().size());
  const double half = ice.layer_step() / 2;
  std::vector<SummaryLine> lines{
      {"name", ice.name() + (idealised ? " (built in, idealised: not a fit to data)" : "")},
      {"hash", ice.hash()},
      {"version", version_words(tables.version)},
      {"layers", fmt::format("{} of {:g} m, {:.2f} to {:.2f} m deep (z {:.2f} to {:.2f} m)", count,
                             ice.layer_step(), layer_depth(ice, count - 1) - half, layer_depth(ice, 0) + half,
                             origin_depth - layer_depth(ice, count - 1) + half, ice.z_bottom())},
      {"wavelength law", fmt::format("alpha {:g}, kappa {:g}, A {:g} /m, B {:g} nm", tables.wavelength.alpha,
                                     tables.wavelength.kappa, tables.wavelength.A, tables.wavelength.B)},
      {"scattering angle",
       fmt::format("mean cosine {:g}, simplified Liu {:g}, Henyey-Greenstein {:g}", ice.mean_cosine(),
                   ice.simplified_liu_fraction(), 1 - ice.simplified_liu_fraction())},
      {"flow azimuth", fmt::format("{:g} deg", ice.flow_azimuth() / degree)}};
  const auto birefringence = birefringence_lines(ice);
  lines.insert(lines.end(), birefringence.begin(), birefringence.end());
  lines.push_back({"absorption anisotropy", absorption_anisotropy(ice)});
  lines.push_back({"scattering anisotropy", scattering_anisotropy(ice)});
  lines.push_back({"tilt", tilt(tables)});
  lines.push_back(
      {"bubbles", tables.bubbles && tables.bubbles->b > 0
                      ? fmt::format("above {:g} m", std::min(tables.bubbles->d1, tables.bubbles->d2))
                      : "off"});
  lines.push_back({"hole ice", hole_ice(tables.configuration.hole_ice)});
  return lines;
}

DetectorCounts count_modules(const Detector& detector) {
  DetectorCounts counts;
  for (const Module& module : detector.modules()) {
    counts.on += module.on;
    counts.high_qe += module.high_qe_spectrum || module.relative_efficiency > 1.2;
    counts.cables += module.cable_azimuth.has_value();
    counts.tilted += module.up_axis != Vec3::UnitZ();
  }
  return counts;
}

std::vector<SummaryLine> detector_lines(const Model& model, bool idealised) {
  const Detector& detector = *model.detector;
  const DetectorCounts counts = count_modules(detector);
  const auto [low, high] = detector.extent();
  const auto& points = model.acceptance.spectrum.points();
  return {
      {"name", detector.name() + (idealised ? " (built in, idealised: not a survey)" : "")},
      {"hash", detector.hash()},
      {"strings", fmt::format("{}", detector.strings().size())},
      {"modules", fmt::format("{}, {} switched on", detector.size(), counts.on)},
      {"high efficiency", fmt::format("{} modules{}", counts.high_qe,
                                      model.acceptance.high_qe ? ", with a spectrum of their own" : "")},
      {"largest efficiency", fmt::format("{:g}", detector.largest_relative_efficiency())},
      {"cables", counts.cables ? fmt::format("{} modules", counts.cables) : "none"},
      {"tilted modules", counts.tilted ? fmt::format("{}", counts.tilted) : "none"},
      {"extent", fmt::format("x {:.0f} to {:.0f}, y {:.0f} to {:.0f}, z {:.0f} to {:.0f} m", low.x(),
                             high.x(), low.y(), high.y(), low.z(), high.z())},
      {"overall efficiency", fmt::format("{:g}", model.acceptance.overall_efficiency)},
      {"angular acceptance", angular_words(model.acceptance.angular)},
      {"wavelengths", fmt::format("{:g} to {:g} nm", points.front().wavelength, points.back().wavelength)}};
}

}  // namespace floe
