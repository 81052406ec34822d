// The bins of a survey along depth, azimuth, distance, time, arrival angle, string and module.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "propagation/model.h"
#include "reco/diagnose/survey.h"

namespace floe {

struct AxisCells {
  std::string axis;  // "depth", "azimuth", "distance", "time", "arrival angle", "string", "module"
  std::string unit;
  bool ordered = true;             // neighbouring cells may form a region
  bool circular = false;           // and the last is the first one's neighbour
  std::vector<double> low, high;   // of the cells; of strings and modules their numbers
  std::vector<std::string> names;  // of the cells, where they are no ranges

  int size() const { return static_cast<int>(low.size()); }
};

// Neighbouring cells of an axis, some of them beyond the last where it is circular.
struct CellRange {
  int first = 0, cells = 0;
};

struct Axis : AxisCells {
  std::vector<int> cell;  // by bin of the survey; -1: not on this axis

  // By cell.
  Eigen::VectorXd sums(const Eigen::VectorXd& of_bins) const;
};

std::vector<Axis> axes_of(const Model& model, const Survey& survey);

// "on modules 1750-1800 m deep", "towards 105-165 deg and opposite"
std::string place_text(const AxisCells& axis, const CellRange& range);

}  // namespace floe
