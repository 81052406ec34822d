// Texts that are wrong in one place each: one clear message, with the line and what was expected.
#include <gtest/gtest.h>

#include "data/base/atomic_file.h"
#include "data/base/error.h"
#include "data/event_files.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe {

using namespace test;

struct Malformed {
  const char* what;     // is wrong
  const char* file;     // name
  const char* content;  // after a good first line in .hits and .dat files
  const char* message;  // part of the error
};
void PrintTo(const Malformed& malformed, std::ostream* out) {
  *out << malformed.what;
}

class MalformedTextTest : public ::testing::TestWithParam<Malformed> {
 protected:
  TemporaryFolder folder;
};

TEST_P(MalformedTextTest, IsRefusedWithAMessageThatHelps) {
  const Malformed& malformed = GetParam();
  const auto path = folder.path() / malformed.file;
  write_bytes(path, malformed.content);
  const std::string message = message_of<InputError>([&] { read_event_file(path); });
  EXPECT_NE(message.find(malformed.message), std::string::npos) << message;
  EXPECT_EQ(message.find(path.string()), 0u) << message;
}

#define GOOD_HIT "HIT 1 2 3.5 400 1 1 1 1\n"
#define GOOD_CHARGE "1 2 3.5 1\n"

INSTANTIATE_TEST_SUITE_P(
    Hits, MalformedTextTest,
    ::testing::Values(
        Malformed{"empty file", "a.hits", "", "found no hits at all"},
        Malformed{"only comments", "a.hits", "# nothing\n\n", "found no hits at all"},
        Malformed{"only a track", "a.hits", "TR 1 0 e- 0 0 0 0 0 0 1 0\n", "found no hits at all"},
        Malformed{"letter in the string", "a.hits", GOOD_HIT "HIT 6e 2 3 400 1 1 1 1",
                  ":2: found '6e'; expected a whole number for string in field 2"},
        Malformed{"letter in the time", "a.hits", GOOD_HIT "HIT 1 2 3o 400 1 1 1 1",
                  ":2: found '3o'; expected a number for time [ns] in field 4"},
        Malformed{"decimal comma", "a.hits", GOOD_HIT "HIT 1 2 3,5 400 1 1 1 1", "found '3,5'"},
        Malformed{"NaN time", "a.hits", GOOD_HIT "HIT 1 2 nan 400 1 1 1 1", "'nan' (not finite)"},
        Malformed{"infinite time", "a.hits", GOOD_HIT "HIT 1 2 -inf 400 1 1 1 1", "'-inf' (not finite)"},
        Malformed{"missing column", "a.hits", GOOD_HIT "HIT 1 2 3 400 1 1 1", ":2: found 8 fields"},
        Malformed{"extra column", "a.hits", GOOD_HIT "HIT 1 2 3 400 1 1 1 1 1", ":2: found 10 fields"},
        Malformed{"negative string", "a.hits", "HIT -1 2 3 400 1 1 1 1", "string -1; expected 1 to 10000"},
        Malformed{"string 0", "a.hits", "HIT 0 2 3 400 1 1 1 1", "found string 0"},
        Malformed{"string too large", "a.hits", "HIT 4294967297 2 3 400 1 1 1 1", "expected 1 to 10000"},
        Malformed{"DOM 0", "a.hits", "HIT 1 0 3 400 1 1 1 1", "DOM 0; expected 1 to 1000"},
        Malformed{"DOM not whole", "a.hits", "HIT 1 2.5 3 400 1 1 1 1",
                  "found '2.5'; expected a whole number"},
        Malformed{"PMT without number", "a.hits", "HIT 1 2_ 3 400 1 1 1 1", "PMT of DOM_PMT"},
        Malformed{"DOM_PMT without DOM", "a.hits", "HIT 1 _2 3 400 1 1 1 1", "DOM of DOM_PMT"},
        Malformed{"wavelength 0", "a.hits", "HIT 1 2 3 0 1 1 1 1", "found wavelength 0"},
        Malformed{"negative wavelength", "a.hits", "HIT 1 2 3 -400 1 1 1 1", "found wavelength -400"},
        Malformed{"angle in degrees", "a.hits", "HIT 1 2 3 400 70 1 1 1", "found 70 for p_theta [rad]"},
        Malformed{"azimuth in degrees", "a.hits", "HIT 1 2 3 400 1 1 1 130", "found 130 for d_phi [rad]"},
        Malformed{"infinite angle", "a.hits", "HIT 1 2 3 400 1 inf 1 1", "not finite"},
        Malformed{"flasher set", "a.txt", "FLASHER 63 20 wavelength_nm=405\n" GOOD_HIT,
                  "floe import --flashers"},
        Malformed{"lower case keyword", "a.hits", "hit 1 2 3 400 1 1 1 1", "expected 'HIT string DOM"},
        Malformed{"charge list under the wrong name", "a.hits", GOOD_CHARGE, "a file named .dat"},
        Malformed{"two events", "a.hits", "EM 1 1\n" GOOD_HIT "EM 1 2\n" GOOD_HIT,
                  ":3: found a second EM line"},
        Malformed{"bad track", "a.hits", "TR 1 0 tau 0 0 0 0 0 0 1 0\n" GOOD_HIT, "found particle 'tau'"},
        Malformed{"binary rubbish", "a.hits", "\x01\x02\x03", "found '\\x01\\x02\\x03'"}));

INSTANTIATE_TEST_SUITE_P(
    Charges, MalformedTextTest,
    ::testing::Values(
        Malformed{"empty file", "a.dat", "", "found no hits at all"},
        Malformed{"only comments", "a.dat", "#\n#\n", "found no hits at all"},
        Malformed{"zero charge", "a.dat", GOOD_CHARGE "1 2 3 0", ":2: found charge 0"},
        Malformed{"negative charge", "a.dat", GOOD_CHARGE "1 2 3 -1", ":2: found charge -1"},
        Malformed{"infinite charge", "a.dat", GOOD_CHARGE "1 2 3 inf", "'inf' (not finite)"},
        Malformed{"charge beyond a float", "a.dat", "1 2 3 1e300", "charge inf (not finite)"},
        Malformed{"charge below a float", "a.dat", "1 2 3 1e-300", "found charge 0"},
        Malformed{"time beyond a double", "a.dat", "1 2 1e999 1", "too large or too small"},
        Malformed{"missing column", "a.dat", GOOD_CHARGE "1 2 3", ":2: found 3 fields"},
        Malformed{"extra column", "a.dat", GOOD_CHARGE "1 2 3 4 5", ":2: found 5 fields"},
        Malformed{"letter in the charge", "a.dat", "1 2 3 l", "expected a number for charge [pe]"},
        Malformed{"flasher set", "a.dat", "FLASHER 63 20\n" GOOD_CHARGE, ":1: found 'FLASHER 63 20'"},
        Malformed{"photons under the wrong name", "a.dat", GOOD_HIT, "found 9 fields"}));

INSTANTIATE_TEST_SUITE_P(
    Names, MalformedTextTest,
    ::testing::Values(Malformed{"unknown suffix", "a.i3", GOOD_HIT, "found the suffix '.i3'"},
                      Malformed{"no suffix", "a", GOOD_HIT, "found the suffix ''"},
                      Malformed{"csv", "a.csv", "event,string\n", "found the suffix '.csv'"},
                      Malformed{"text as HDF5", "a.h5", GOOD_HIT, "found a file that is not HDF5"},
                      Malformed{"empty HDF5", "a.h5", "", "found an empty file"}));

TEST(MalformedFileTest, MissingFilesAndFoldersSaySo) {
  const TemporaryFolder folder;
  for (const char* name : {"none.h5", "none.hits", "none.dat.gz", "none"})
    EXPECT_NE(message_of<InputError>([&] { read_event_file(folder.path() / name); }).find("no file"),
              std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { read_event_file(folder.path()); }).find("a directory"),
            std::string::npos);
}

TEST(MalformedFileTest, TruncatedGzipSaysSo) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.dat.gz";
  write_whole_file(path, GOOD_CHARGE GOOD_CHARGE);
  const std::string whole = bytes_of(path);
  write_bytes(path, std::string_view(whole).substr(0, whole.size() - 4));
  EXPECT_NE(message_of<InputError>([&] { read_event_file(path); }).find("truncated"), std::string::npos);
}

}  // namespace floe
