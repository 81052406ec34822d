// What pictures of likelihoods over two numbers have in common, so that they read alike.
#pragma once

#include <string>

#include "reco/figures/svg.h"

namespace floe {

inline const Stroke frame_stroke{"#444444", 1, ""};

// From dark, at 0, to white, at 1.
std::string map_shade(double share);
// Where the likelihood is best; seen on any shade.
void draw_cross(Svg& svg, const Svg::Point& place);
void draw_frame(Svg& svg, const Svg::Point& corner, double width, double height);

}  // namespace floe
