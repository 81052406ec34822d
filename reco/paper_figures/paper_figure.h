// What a figure of floe's paper is made of, and what comes out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/base/progress.h"
#include "propagation/model.h"

namespace floe {

struct FigureSettings {
  Model model;
  std::optional<double> photons;  // N of each flasher run; none: what the figure needs to be quick
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all cores; the result does not depend on it
};

// A number that the figure shows: "max/min" of "full ice".
struct FigureNumber {
  std::string of, name, unit;
  double value = 0, error = 0;
};

struct PaperFigure {
  std::string svg;
  std::string csv;  // what is drawn, with a heading
  std::vector<FigureNumber> numbers;
  std::vector<std::string> remarks;  // a sentence each: where the light came from, what was left out
};

}  // namespace floe
