#include "data/base/hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace floe {

// The published XXH3-128 value of no bytes at all.
TEST(HasherTest, IsXxh3) {
  EXPECT_EQ(Hasher().hex(), "99aa06d3014798d86001c324468d497f");
}

// Hashes name ice models in outputs that people keep, so they must not change between releases.
TEST(HasherTest, IsStable) {
  EXPECT_EQ(Hasher().add(1.5).add(std::int64_t{-3}).add("ice").hex(), "9ac394caeaa6446f7377d02bc3d5d54b");
}

TEST(HasherTest, IsTheSameForTheSameValues) {
  EXPECT_EQ(Hasher().add(0.1).add("a").hex(), Hasher().add(0.1).add("a").hex());
}

TEST(HasherTest, TellsEverythingApart) {
  const std::set<std::string> hashes = {
      Hasher().add(1.0).hex(),
      Hasher().add(std::nextafter(1.0, 2.0)).hex(),
      Hasher().add(0.0).hex(),
      Hasher().add(-0.0).hex(),
      Hasher().add(1).hex(),
      Hasher().add(0.0).add(1.0).hex(),
      Hasher().add(1.0).add(0.0).hex(),
      Hasher().add("ab").add("c").hex(),
      Hasher().add("a").add("bc").hex(),
      Hasher().add("abc").hex(),
      Hasher().add("").hex(),
      Hasher().hex(),
  };
  EXPECT_EQ(hashes.size(), 12u);
}

TEST(HasherTest, IntegersOfAnyWidthAreTheSame) {
  EXPECT_EQ(Hasher().add(7).hex(), Hasher().add(std::int64_t{7}).hex());
  EXPECT_EQ(Hasher().add(std::size_t{7}).hex(), Hasher().add(std::int64_t{7}).hex());
}

}  // namespace floe
