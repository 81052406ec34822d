// The journal of a long run: nothing is lost, nothing is mixed.
#include "apps/row_journal.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "data/base/error.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

const Json heading{{"journal", "test 1"}, {"seed", 3}, {"cap", std::numeric_limits<double>::infinity()}};

TEST(RowJournal, GoesOnWhereARunWasKilledWhileItWrote) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "rows";
  {
    RowJournal journal(path, heading, RowJournal::Mismatch::error);
    EXPECT_TRUE(journal.rows().empty());
    journal.append({{"index", 0}, {"value", 0.1}});
    journal.append({{"index", 1}, {"value", 1.0 / 3}});
  }
  std::ofstream(path, std::ios::app) << "{\"index\":2,\"val";
  {
    RowJournal journal(path, heading, RowJournal::Mismatch::error);
    ASSERT_EQ(journal.rows().size(), 2u);
    EXPECT_EQ(journal.rows()[1]["value"].get<double>(), 1.0 / 3);
    journal.append({{"index", 2}});
  }
  const RowJournal journal(path, heading, RowJournal::Mismatch::error);
  ASSERT_EQ(journal.rows().size(), 3u);
  EXPECT_EQ(journal.rows()[2]["index"], 2);
}

TEST(RowJournal, DoesNotMixRunsAndLetsOnlyOneWrite) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "rows";
  Json other = heading;
  other["seed"] = 4;
  {
    RowJournal journal(path, heading, RowJournal::Mismatch::error);
    journal.append({{"index", 0}});
    EXPECT_THROW(RowJournal(path, heading, RowJournal::Mismatch::error), OutputError);
  }
  EXPECT_THROW(RowJournal(path, other, RowJournal::Mismatch::error), UsageError);
  EXPECT_TRUE(RowJournal(path, other, RowJournal::Mismatch::start_again).rows().empty());
}

// One setting deep inside, between long ones.
TEST(RowJournal, SaysWhichSettingDiffers) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "rows";
  const std::string rest(5000, 'x');
  const auto with_seed = [&](int seed) {
    return Json{{"journal", "test 1"}, {"rest", rest}, {"runs", {{{"seed", 1}}, {{"seed", seed}}}}};
  };
  RowJournal(path, with_seed(2), RowJournal::Mismatch::error);
  try {
    RowJournal(path, with_seed(3), RowJournal::Mismatch::error);
    FAIL() << "mixed";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("rows of a run with runs.2.seed 2, not 3"), std::string::npos)
        << error.what();
    EXPECT_LT(std::string(error.what()).size(), 300u);
  }
}

TEST(RowJournal, RefusesWhatIsNoJournal) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "text";
  std::ofstream(path) << "a text\nof two lines\n";
  EXPECT_THROW(RowJournal(path, heading, RowJournal::Mismatch::start_again), InputError);
  const auto one_line = folder.path() / "one-line";
  std::ofstream(one_line) << "{\"results\":[1,2]}";
  EXPECT_THROW(RowJournal(one_line, heading, RowJournal::Mismatch::start_again), InputError);
  EXPECT_EQ(std::filesystem::file_size(one_line), 17u);
  EXPECT_THROW(RowJournal(folder.path() / "none" / "rows", heading, RowJournal::Mismatch::error),
               OutputError);
}

}  // namespace
}  // namespace floe::test
