// Parts of models, and what settings make of them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "data/base/error.h"
#include "propagation/effects/effect.h"
#include "propagation/ice/ice_hash.h"
#include "propagation/ice/ice_model.h"
#include "propagation/model.h"
#include "tests/unit/propagation/ice/ice_directory.h"

namespace floe::test {

inline ModelParts built_in_parts() {
  return {south_pole_ice(), ic86_detector(), builtin_acceptance()};
}

// Ice from a directory, with bubbles, tilt, anisotropies that differ by layer; a string of two modules.
inline ModelParts small_parts() {
  const IceDirectory directory;
  return {read_ice_tables(directory.path()), small_detector(), builtin_acceptance()};
}

inline ModelParts changed(ModelParts parts, const std::vector<std::string>& settings) {
  std::vector<EffectSetting> read;
  for (const std::string& text : settings) read.push_back(parse_effect_setting(text));
  apply_effects(read, parts);
  return parts;
}

inline void expect_refused(const ModelParts& parts, const std::vector<std::string>& settings,
                           const std::string& said) {
  try {
    changed(parts, settings);
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    return;
  }
  FAIL() << settings.front() << " was taken";
}

inline void expect_equal(const ModuleAcceptance& a, const ModuleAcceptance& b) {
  EXPECT_EQ(a.overall_efficiency, b.overall_efficiency);
  EXPECT_EQ(a.angular.is_surface(), b.angular.is_surface());
  EXPECT_EQ(a.angular.maximum(), b.angular.maximum());
  EXPECT_EQ(a.angular.cut(), b.angular.cut());
  EXPECT_EQ(a.angular.coefficients(), b.angular.coefficients());
  ASSERT_EQ(a.spectrum.points().size(), b.spectrum.points().size());
  for (std::size_t i = 0; i < a.spectrum.points().size(); ++i) {
    EXPECT_EQ(a.spectrum.points()[i].wavelength, b.spectrum.points()[i].wavelength);
    EXPECT_EQ(a.spectrum.points()[i].cumulative, b.spectrum.points()[i].cumulative);
  }
  EXPECT_EQ(a.high_qe.has_value(), b.high_qe.has_value());
  EXPECT_EQ(a.cable_radius, b.cable_radius);
}

inline void expect_equal(const ModelParts& a, const ModelParts& b) {
  EXPECT_EQ(ice_hash(a.ice), ice_hash(b.ice));
  EXPECT_EQ(a.detector.hash(), b.detector.hash());
  EXPECT_EQ(a.sources, b.sources);
  expect_equal(a.acceptance, b.acceptance);
}

}  // namespace floe::test
