// The figures that floe can make. A new one is a file in this folder and a line in catalogue.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reco/paper_figures/paper_figure.h"

namespace floe {

struct FigureMaker {
  std::string name;   // of its files and on the command line
  std::string title;  // one line
  PaperFigure (*make)(const FigureSettings& settings, const Progress& progress);
};

const std::vector<FigureMaker>& paper_figures();
// Throws UsageError naming all figures, the most similar first.
const FigureMaker& find_paper_figure(std::string_view name);

}  // namespace floe
