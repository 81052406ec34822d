// The functions behind the catalogue, a file each. All throw NoResult where the detector has no suitable
// flasher or where there is too little light.
#pragma once

#include "reco/paper_figures/paper_figure.h"

namespace floe {

PaperFigure azimuth_figure(const FigureSettings& settings, const Progress& progress);
PaperFigure light_curves_figure(const FigureSettings& settings, const Progress& progress);
PaperFigure llh_space_figure(const FigureSettings& settings, const Progress& progress);
PaperFigure stratigraphy_figure(const FigureSettings& settings, const Progress& progress);
PaperFigure diffusion_figure(const FigureSettings& settings, const Progress& progress);
PaperFigure events_figure(const FigureSettings& settings, const Progress& progress);

}  // namespace floe
