#include "data/base/error.h"

#include <gtest/gtest.h>

namespace floe {

TEST(InputErrorTest, NamesPlaceFindingExpectationAndAdvice) {
  const InputError error({"a.dat", 12}, "'x'", "a number", "Remove it");
  EXPECT_STREQ(error.what(), "a.dat:12: found 'x'; expected a number. Remove it");
  EXPECT_EQ(error.code(), ExitCode::bad_input);
}

TEST(InputErrorTest, LeavesOutWhatIsNotGiven) {
  EXPECT_STREQ(InputError({"a.dat"}, "nothing", "hits").what(), "a.dat: found nothing; expected hits");
}

TEST(ErrorTest, KindsHaveTheirExitCodes) {
  EXPECT_EQ(UsageError("").code(), ExitCode::usage);
  EXPECT_EQ(NoResult("").code(), ExitCode::no_result);
  EXPECT_EQ(OutputError("").code(), ExitCode::bad_output);
}

}  // namespace floe
