// Keeps the score of one path while it is walked; what is kept, and why: path_scores.h.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "propagation/engine/anisotropy.h"
#include "propagation/engine/path_scores.h"
#include "propagation/engine/turn_score.h"

namespace floe {

class PathRecord {
 public:
  explicit PathRecord(std::size_t layers = 0) {
    scores_.layers.resize(layers);
    scores_.lowest = static_cast<int>(layers);
    scores_.highest = -1;
  }
  const PathScores& scores() const { return scores_; }

  // A straight piece in a direction of these components along the flow, across it and up; K: factors of the
  // absorption anisotropy; `distance`: of its beginning along the direction of 1D tilt [m].
  void begin_piece(const std::array<double, 3>& n, const std::array<double, 3>& K, double distance) {
    flights_.clear();
    distance_ = distance;
    const double factor = absorption_anisotropy_factor(K[0], K[1], K[2], n[0], n[1], n[2]);
    for (std::size_t i = 0; i < 3; ++i) anisotropy_slope_[i] = factor * factor * K[i] * n[i] * n[i];
  }

  // A share of the piece, with the layer's coefficient of absorption without and with its anisotropy.
  void fly(int layer, double length, double isotropic, double absorption) {
    PathScores::Layer& score = at(layer);
    score.absorption -= length * absorption / isotropic;
    score.scattering -= length;
    score.tilted_absorption -= distance_ * length * absorption / isotropic;
    score.tilted_scattering -= distance_ * length;
    score.length += length;
    for (std::size_t i = 0; i < 3; ++i)
      scores_.absorption_anisotropy[i] += length * absorption * anisotropy_slope_[i];
    scores_.lowest = std::min(scores_.lowest, layer);
    scores_.highest = std::max(scores_.highest, layer);
    flights_.push_back({layer, length});
  }

  void scatter(int layer, double geometric_scattering) {
    at(layer).scattering += 1 / geometric_scattering;
    at(layer).tilted_scattering += distance_ / geometric_scattering;
  }

  // The birefringent step at the piece's end, by moments of its normals g. Its widths' squares grow with V,
  // the diffusion strength integrated along the piece: (g^2 - 1)/(2V) for each of the two. The mean grows
  // with length: `mean_over_width`, both of one metre, times the pull over the root of V.
  void turn(double V, const TurnMoments& moments, double mean_over_width) {
    if (!(V > 0)) return;
    for (const auto& [layer, length] : flights_) {
      at(layer).diffusion += length * (moments.squares - 2) / (2 * V);
      at(layer).deflection += length * moments.pull * mean_over_width / std::sqrt(V);
    }
  }

 private:
  struct Flight {
    int layer;
    double length;
  };
  PathScores::Layer& at(int layer) { return scores_.layers[static_cast<std::size_t>(layer)]; }

  PathScores scores_;
  std::array<double, 3> anisotropy_slope_{};
  std::vector<Flight> flights_;  // of the piece
  double distance_ = 0;          // of the piece, along the direction of 1D tilt
};

}  // namespace floe
