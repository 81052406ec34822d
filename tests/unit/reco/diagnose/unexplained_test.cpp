#include "reco/diagnose/unexplained.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reco/diagnose/diagnosis.h"

namespace floe {
namespace {

using Reasons = std::vector<std::string>;

// A gap of 400 that scatters by 40, of which differences between programs could make 20: clear above 140.
Diagnosis diagnosis_of(const std::vector<std::string>& names, double gap_after) {
  Diagnosis diagnosis;
  diagnosis.gap_before = 400, diagnosis.gap_after = gap_after;
  diagnosis.gap_scatter = 40, diagnosis.gap_of_floor = 20;
  diagnosis.folds = 2;
  for (const std::string& name : names) {
    NamedEffect named;
    named.suspect.effect = name;
    diagnosis.effects.push_back(named);
  }
  return diagnosis;
}

TEST(Unexplained, NotWhereNamesCloseTheGap) {
  EXPECT_TRUE(why_unexplained(diagnosis_of({"tilt"}, 10), false).empty());
  EXPECT_TRUE(why_unexplained(diagnosis_of({"tilt"}, 199), false).empty());
}

TEST(Unexplained, WhereSomethingRemains) {
  EXPECT_EQ(why_unexplained(diagnosis_of({"tilt"}, 10), true),
            Reasons{"something remains that no effect of the catalogue explains"});
}

TEST(Unexplained, WhereMostOfAClearGapStays) {
  EXPECT_EQ(why_unexplained(diagnosis_of({"tilt"}, 201), false),
            Reasons{"runs that were held out do not confirm it"});
  Diagnosis none_held_out = diagnosis_of({"tilt"}, 201);
  none_held_out.folds = 1;
  EXPECT_EQ(why_unexplained(none_held_out, false), Reasons{"most of the gap stays"});
}

TEST(Unexplained, NotWhereAGapMayBeChance) {
  Diagnosis weak_before = diagnosis_of({"tilt"}, 130);
  weak_before.gap_before = 135;
  EXPECT_TRUE(why_unexplained(weak_before, false).empty());
  Diagnosis weak_after = diagnosis_of({"tilt"}, 135);
  weak_after.gap_before = 200;
  EXPECT_TRUE(why_unexplained(weak_after, false).empty());
}

TEST(Unexplained, WhereStringsGoWrongByThrees) {
  std::vector<std::string> names{"string-efficiency", "tilt", "string-efficiency"};
  EXPECT_TRUE(why_unexplained(diagnosis_of(names, 10), false).empty());
  names.push_back("string-efficiency");
  EXPECT_EQ(why_unexplained(diagnosis_of(names, 10), false),
            Reasons{"string-efficiency at 3 places at once is more likely one thing that the catalogue does "
                    "not have"});
}

}  // namespace
}  // namespace floe
