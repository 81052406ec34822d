#include "reco/paper_figures/catalogue.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "data/base/error.h"
#include "data/base/words.h"
#include "reco/paper_figures/figures.h"

namespace floe {

const std::vector<FigureMaker>& paper_figures() {
  static const std::vector<FigureMaker> all{
      {"azimuth", "Light of flashers against azimuth, 125 m away", azimuth_figure},
      {"light-curves", "Arrival times along the flow and across it", light_curves_figure},
      {"llh-space", "Likelihood of a layer's flashers over birefringence and scattering", llh_space_figure},
      {"stratigraphy", "Ice of several layers fitted to four flashers", stratigraphy_figure},
      {"diffusion", "Where light goes in a metre of grains, against its angle to the flow", diffusion_figure},
      {"events", "Five cascades fitted with and without birefringence", events_figure},
  };
  return all;
}

const FigureMaker& find_paper_figure(std::string_view name) {
  std::vector<std::string> names;
  for (const FigureMaker& figure : paper_figures()) {
    if (figure.name == name) return figure;
    names.push_back(figure.name);
  }
  throw UsageError(fmt::format("found figure \"{}\"; expected one of {}", name,
                               fmt::join(by_likeness(name, names), ", ")));
}

}  // namespace floe
