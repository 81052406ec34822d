#include "propagation/engine/hole_ice.h"

#include "data/base/constants.h"

namespace floe {

namespace {

constexpr double smallest_cell = 16;  // of the grid of nearest axes [m]
constexpr int most_cells = 256;       // along a side
constexpr float rounding = 5e-3F;     // single precision, 10 km from the origin [m]

}  // namespace

HoleIceColumns::HoleIceColumns(const Model& model) {
  const HoleIce& hole = model.ice->tables().configuration.hole_ice;
  if (hole.radius == 0) return;
  radius_ = hole.radius * module_radius;
  geometric_scattering_ = 1 / (hole.effective_scattering_length * (1 - hole.mean_cosine));
  absorption_ = 1 / hole.absorption_length;
  simplified_liu_fraction_ = hole.simplified_liu_fraction;
  mean_cosine_ = hole.mean_cosine;
  for (const auto& [string, centre] : model.detector->strings()) axes_.push_back({centre.x(), centre.y()});
  lay_out_grid();
}

void HoleIceColumns::lay_out_grid() {
  const auto by_x = [](const Axis& a, const Axis& b) { return a.x < b.x; };
  const auto by_y = [](const Axis& a, const Axis& b) { return a.y < b.y; };
  const auto [west, east] = std::minmax_element(axes_.begin(), axes_.end(), by_x);
  const auto [south, north] = std::minmax_element(axes_.begin(), axes_.end(), by_y);
  const double wide = east->x - west->x, high = north->y - south->y;
  const double cell = std::max(smallest_cell, std::max(wide, high) / most_cells);
  low_x_ = static_cast<float>(west->x), high_x_ = static_cast<float>(east->x);
  low_y_ = static_cast<float>(south->y), high_y_ = static_cast<float>(north->y);
  cells_per_metre_ = static_cast<float>(1 / cell);
  reach_ = static_cast<float>(radius_) + rounding;
  columns_ = static_cast<std::int32_t>(wide / cell) + 3;
  rows_ = static_cast<std::int32_t>(high / cell) + 3;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      cells_.push_back(make_cell(west->x + (column - 0.5) * cell, south->y + (row - 0.5) * cell));
}

// Around a cell's centre.
HoleIceColumns::Cell HoleIceColumns::make_cell(double x, double y) const {
  const double half_diagonal = std::sqrt(0.5) / static_cast<double>(cells_per_metre_);
  double nearest = endless, second = endless;
  std::size_t found = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const double distance = std::hypot(axes_[i].x - x, axes_[i].y - y);
    second = std::min(second, std::max(distance, nearest));
    if (distance < nearest) nearest = distance, found = i;
  }
  return {static_cast<float>(axes_[found].x), static_cast<float>(axes_[found].y),
          static_cast<float>(std::max(0.0, second - half_diagonal)), static_cast<std::int32_t>(found)};
}

std::optional<ColumnPassage> HoleIceColumns::first(const Vec3& origin, const Vec3& direction,
                                                   double length) const {
  std::optional<ColumnPassage> result;
  const auto consider = [&](const Axis& axis) {
    ColumnPassage found;
    if (!passage(axis, origin, direction, length, found)) return;
    const bool sooner = !result || found.entry < result->entry;
    const bool longer = result && found.entry == result->entry && found.exit > result->exit;
    if (sooner || longer) result = found;
  };
  const auto x = static_cast<float>(origin.x()), y = static_cast<float>(origin.y());
  const Cell& cell = cell_near(x, y);
  if (near_the_grid(x, y) && length < static_cast<double>(cell.others - reach_))
    consider(axes_[static_cast<std::size_t>(cell.axis)]);
  else
    std::for_each(axes_.begin(), axes_.end(), consider);
  return result;
}

// In the horizontal plane the column is a circle. The path passes its centre at the distance `aside`,
// `ahead` metres on.
bool HoleIceColumns::passage(const Axis& axis, const Vec3& origin, const Vec3& direction, double length,
                             ColumnPassage& passage) const {
  const double dx = axis.x - origin.x(), dy = axis.y - origin.y();
  const double sine = std::hypot(direction.x(), direction.y());
  if (sine < 1e-9) {
    passage = {0, endless};
    return dx * dx + dy * dy < radius_ * radius_;
  }
  const double ux = direction.x() / sine, uy = direction.y() / sine;
  const double ahead = dx * ux + dy * uy, aside = dx * uy - dy * ux;
  const double square = (radius_ - aside) * (radius_ + aside);
  if (square <= 0) return false;
  const double half_chord = std::sqrt(square);
  const double entry = ahead - half_chord, exit = ahead + half_chord;
  passage.entry = entry > tolerance ? entry / sine : 0;
  passage.exit = std::min(exit / sine, endless);
  return passage.entry <= length && exit - std::max(entry, 0.0) > tolerance;
}

}  // namespace floe
