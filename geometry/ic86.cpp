// The built-in detector: IceCube as its papers describe it, idealised. Every string is vertical and
// stands exactly on its grid point, every module hangs at its nominal depth, and the depths are the same
// on all strings; the real positions differ by metres to tens of metres. For measured data, read the
// surveyed geometry instead.
//
// Facts: 78 strings, 125 m apart on a triangular grid, 60 modules every 17 m between 1450 m and 2450 m
// (arXiv:1612.05093, section 1); 8 DeepCore strings around string 36, 6 of them 72 m apart and 2 inside,
// 42 m from their neighbours, 50 modules every 7 m below 2100 m and 10 modules every 10 m above the dust
// layer, high quantum efficiency tubes with 1.35 times the sensitivity (arXiv:1109.6096, section 2).
#include <array>

#include "data/base/constants.h"
#include "geometry/detector.h"

namespace floe {

namespace {

using Vec2 = Eigen::Vector2d;

constexpr double spacing = 125;  // between neighbouring strings [m]
constexpr double row_azimuth = 9.3 * degree;
constexpr int centre_of_deepcore = 36;

// Strings are numbered along rows; a row starts half a spacing before or after its neighbour. The last
// row ends early where two planned strings were given to DeepCore.
struct Row {
  int strings;
  double start;  // of its first string along the row [spacings]
};
constexpr std::array<Row, 10> rows{
    {{6, 2.0}, {7, 1.5}, {8, 1.0}, {9, 0.5}, {10, 0.0}, {10, 0.5}, {9, 1.0}, {8, 1.5}, {7, 2.0}, {4, 2.5}}};

Vec2 at_azimuth(double azimuth) {
  return {std::cos(azimuth), std::sin(azimuth)};
}

// Strings 1-78, their centre of gravity in the frame's origin.
std::map<int, Vec2> grid_strings() {
  const Vec2 along = spacing * at_azimuth(row_azimuth);
  const Vec2 across = spacing * std::sqrt(3.0) / 2 * at_azimuth(row_azimuth + pi / 2);
  std::map<int, Vec2> strings;
  Vec2 sum = Vec2::Zero();
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (int k = 0; k < rows[row].strings; ++k) {
      const Vec2 place = (rows[row].start + k) * along + static_cast<double>(row) * across;
      strings[static_cast<int>(strings.size()) + 1] = place;
      sum += place;
    }
  const Vec2 centre = sum / static_cast<double>(strings.size());
  for (auto& [number, place] : strings) place -= centre;
  return strings;
}

// Strings 79-86. Six stand in the middle of the six triangles of grid strings around the centre, two a
// third of the way to its neighbours on the lower row.
std::map<int, Vec2> deepcore_strings(const Vec2& centre) {
  const double sixth = pi / 3;
  std::map<int, Vec2> strings;
  for (int k = 0; k < 2; ++k)
    strings[79 + k] = centre + spacing / 3 * at_azimuth(row_azimuth + (4 + k) * sixth);
  for (int k = 0; k < 6; ++k)
    strings[81 + k] = centre + spacing / std::sqrt(3.0) * at_azimuth(row_azimuth + (1.5 - k) * sixth);
  return strings;
}

double grid_depth(int dom) {
  return 1450 + 0.5 * (1000 - 59 * 17.02) + 17.02 * (dom - 1);
}
double deepcore_depth(int dom) {
  return dom <= 10 ? 1760 + 10.0 * (dom - 1) : 2450 - 7.0 * (60 - dom);
}

Module nominal_module(int string, int dom, const Vec2& place, double depth) {
  Module module;
  module.id = {string, dom};
  module.position = {place.x(), place.y(), origin_depth - depth};
  return module;
}

}  // namespace

Detector ic86_detector() {
  std::vector<Module> modules;
  const auto grid = grid_strings();
  for (const auto& [string, place] : grid)
    for (int dom = 1; dom <= 60; ++dom)
      modules.push_back(nominal_module(string, dom, place, grid_depth(dom)));
  for (const auto& [string, place] : deepcore_strings(grid.at(centre_of_deepcore)))
    for (int dom = 1; dom <= 60; ++dom) {
      modules.push_back(nominal_module(string, dom, place, deepcore_depth(dom)));
      modules.back().relative_efficiency = 1.35;
    }
  return Detector("ic86", std::move(modules));
}

}  // namespace floe
