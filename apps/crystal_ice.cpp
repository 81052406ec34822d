#include "apps/crystal_ice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/common_options.h"
#include "apps/improved_ice.h"
#include "data/base/text.h"

namespace floe {

namespace {

using DepthSizes = std::vector<std::pair<double, double>>;

DepthSizes read_layer_grains(const std::string& file) {
  constexpr double finest = 0.01, coarsest = 1000, deepest = 1e5;
  DepthSizes sizes;
  for (const TextLine& line : read_text_lines(file)) {
    expect_fields(line, 2, 2, "depth [m], grain size [mm]");
    const double depth = parse_number(line, 0, "depth [m]"), size = parse_number(line, 1, "grain size [mm]");
    expect_range(line, depth, sizes.empty() ? 0 : std::nextafter(sizes.back().first, deepest), deepest,
                 "depth [m], rising");
    expect_range(line, size, finest, coarsest, "grain size [mm]");
    sizes.push_back({depth, size * 1e-3});
  }
  if (sizes.empty()) throw InputError({file}, "no rows", "a row for each depth: depth [m], grain size [mm]");
  return sizes;
}

// Linear between the depths; beyond them the outermost sizes continue.
double size_at(const DepthSizes& sizes, double depth) {
  const auto below =
      std::find_if(sizes.begin(), sizes.end(), [&](const auto& row) { return row.first >= depth; });
  if (below == sizes.begin()) return below->second;
  if (below == sizes.end()) return sizes.back().second;
  const auto above = below - 1;
  const double share = (depth - above->first) / (below->first - above->first);
  return above->second + share * (below->second - above->second);
}

}  // namespace

void add_crystal_ice_options(CLI::App& app, CrystalIceRequest& request) {
  app.add_option("--into", request.folder, "New ice directory: --ice with this birefringence and grain size")
      ->type_name("DIR");
  app.add_option("--layer-grains", request.layer_grains,
                 "Of --into: rows of depth [m] and grain size [mm], for layers that differ")
      ->type_name("FILE")
      ->needs("--into");
  app.add_flag("--keep-strengths", request.keep_strengths,
               "Of --into: leave the layers' strengths as they are")
      ->needs("--into")
      ->excludes("--layer-grains");
  add_model_options(app, request.model);
}

CrystalIceWriter::CrystalIceWriter(const CrystalIceRequest& request)
    : request_(request), folder_(*request.folder), base_(load_model(request.model)) {
  copy_base_ice(request.model, folder_.temporary());
  if (request.layer_grains) grains_ = read_layer_grains(*request.layer_grains);
}

void CrystalIceWriter::write(const CrystalStudy& study, PatternEstimator estimator,
                             const std::string& command) {
  constexpr double grain_of_strength_1 = 1e-3;
  const DiffusionFit& fit = estimator == PatternEstimator::core ? *study.core : *study.all;
  ModelParts parts = parts_of(base_);
  parts.ice.configuration.birefringence = fit.numbers();
  for (IceLayerRow& row : parts.ice.layers) {
    if (request_.keep_strengths) continue;
    const double grain = grains_.empty() ? study.grid.grain : size_at(grains_, row.depth);
    row.birefringence_strength = grain_of_strength_1 / grain;
    row.deflection_strength = 1;
  }
  const std::string changes =
      fmt::format("Ice model made by floe {} from {} ({}): birefringence of {}.\n{}\n", FLOE_VERSION,
                  request_.model.ice, base_.ice->hash(), study.name, command);
  write_improved_ice(request_.model, freeze(std::move(parts)), {}, changes, folder_.temporary());
}

}  // namespace floe
