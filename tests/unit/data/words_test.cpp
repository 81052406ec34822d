// What a mistyped word may have meant.
#include "data/base/words.h"

#include <gtest/gtest.h>

namespace floe {
namespace {

TEST(EditDistance, CountsLetters) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "ice"), 3u);
  EXPECT_EQ(edit_distance("ice", "ice"), 0u);
  EXPECT_EQ(edit_distance("ice", "rice"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(ByLikeness, PutsTheMostSimilarFirstAndKeepsTheOrderOtherwise) {
  EXPECT_EQ(by_likeness("tild", {"bubbles", "hole", "tilt"}),
            (std::vector<std::string>{"tilt", "hole", "bubbles"}));
  EXPECT_EQ(by_likeness("x", {"bb", "aa"}), (std::vector<std::string>{"bb", "aa"}));
}

TEST(NearestWord, IsNoneWhenNothingIsNear) {
  EXPECT_EQ(nearest_word("tild", {"hole", "tilt"}), "tilt");
  EXPECT_EQ(nearest_word("zzzz", {"hole", "tilt"}), "");
}

}  // namespace
}  // namespace floe
