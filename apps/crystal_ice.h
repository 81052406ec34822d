// floe crystal --into: an ice model whose birefringence is that of given grains.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "data/base/atomic_folder.h"
#include "propagation/model.h"
#include "reco/crystal/crystal_study.h"

namespace floe {

struct CrystalIceRequest {
  ModelRequest model;                       // the base: --ice and what goes with it
  std::optional<std::string> folder;        // --into
  std::optional<std::string> layer_grains;  // --layer-grains
  bool keep_strengths = false;              // --keep-strengths
};
void add_crystal_ice_options(CLI::App& app, CrystalIceRequest& request);

// Reads the base and the grains' sizes, and makes the new folder, before the work; throws the errors of
// load_model, AtomicFolder and read_layer_grains.
class CrystalIceWriter {
 public:
  explicit CrystalIceWriter(const CrystalIceRequest& request);
  // The base with the study's 12 numbers, and 1 mm / grain size as every layer's strength.
  void write(const CrystalStudy& study, PatternEstimator estimator, const std::string& command);
  void commit() { folder_.commit(); }

 private:
  CrystalIceRequest request_;
  AtomicFolder folder_;
  Model base_;
  std::vector<std::pair<double, double>> grains_;  // depth [m], size [m]; empty: the study's everywhere
};

}  // namespace floe
