// The engine against an independent program on the public ice models, in short.
#include <gtest/gtest.h>

#include <filesystem>

#include "reco/validation/reference_sets.h"

namespace floe {
namespace {

class Reference : public ::testing::TestWithParam<ReferenceSet> {};

TEST_P(Reference, Agrees) {
  ValidationOptions options;
  options.reference = std::filesystem::path(FLOE_SHARED_DIR) / "reference";
  options.ice_models = std::filesystem::path(FLOE_SHARED_DIR) / "ice";
  if (!std::filesystem::exists(options.reference))
    GTEST_SKIP() << "the reference results are not beside the project: " << options.reference;
  options.share = quick_share;
  const ValidationResult result = validate_set(GetParam(), options);
  EXPECT_TRUE(result.total_passes) << result.comparison.ratio << " +- " << result.comparison.ratio_error;
  EXPECT_TRUE(result.modules_pass) << result.comparison.chi_square << " over " << result.comparison.modules;
  EXPECT_TRUE(result.times_pass) << result.comparison.times.smallest_probability;
  EXPECT_TRUE(result.directions_pass);
  EXPECT_GT(result.comparison.modules, 0);
}

INSTANTIATE_TEST_SUITE_P(Sets, Reference, ::testing::ValuesIn(reference_sets()), [](const auto& set) {
  std::string name = set.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '-'; }, '_');
  return name;
});

}  // namespace
}  // namespace floe
