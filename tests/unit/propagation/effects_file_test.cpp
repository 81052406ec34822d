// floe.toml of an ice directory.
#include "propagation/effects_file.h"

#include <gtest/gtest.h>

#include "data/base/error.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

TEST(EffectsFile, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  EXPECT_TRUE(read_effects_file(folder.path()).empty());
  const EffectGroups groups{{{"string-efficiency", "string", 36}, {"string-efficiency", "factor", 0.81}},
                            {{"flasher-profile", "width", 1.25}}};
  write_bytes(folder.path() / effects_file, effects_file_text(groups));
  EXPECT_EQ(read_effects_file(folder.path()), groups);
}

TEST(EffectsFile, RefusesWhatItDoesNotKnow) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text) {
    write_bytes(folder.path() / effects_file, text);
    EXPECT_THROW(read_effects_file(folder.path()), Error) << text;
  };
  refused("effects = [");
  refused("affects = []");
  refused("effects = 3");
  refused("effects = [\"flasher-profile.width=1\"]");
  refused("effects = [[3]]");
  refused("effects = [[\"flasher-profile.width\"]]");
  refused("effects = [[\"no-such-effect.width=1\"]]");
}

}  // namespace
}  // namespace floe::test
