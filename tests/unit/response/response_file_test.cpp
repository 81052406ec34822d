#include "response/response_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/data/temporary_folder.h"

#include "data/base/error.h"

namespace floe {

namespace {

class ResponseFile : public ::testing::Test {
 protected:
  ResponseSettings read(const std::string& text) {
    std::ofstream(path) << text;
    return read_response_file(path);
  }
  std::string message_of(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no InputError";
  }

  test::TemporaryFolder folder;
  std::filesystem::path path = folder.path() / "response.toml";
};

}  // namespace

TEST_F(ResponseFile, WrittenAndReadAgainIsTheSame) {
  const std::string text = response_file_text(ResponseSettings());
  EXPECT_EQ(response_file_text(read(text)), text);
  // Each number with what it means and where it is from.
  EXPECT_NE(text.find("# of photoelectrons (arXiv:1002.2442)\nprepulse_share = 0.003\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("mode = \"soft\""), std::string::npos);
}

TEST_F(ResponseFile, ChangesWhatItNamesAndNothingElse) {
  const ResponseSettings settings = read(
      "[noise]\nsingle_rate = 0\n[local_coincidence]\nmode = \"none\"\ndistance = 1\n[atwd]\ngain_2 = "
      "0.25\n");
  EXPECT_EQ(settings.noise.single_rate, 0);
  EXPECT_EQ(settings.launches.mode, CoincidenceMode::none);
  EXPECT_EQ(settings.launches.distance, 1);
  EXPECT_EQ(settings.digitisers.atwd_gain[2], 0.25);
  EXPECT_EQ(settings.noise.burst_rate, ResponseSettings().noise.burst_rate);
}

TEST_F(ResponseFile, MistakesAreNamedWithTheirLines) {
  const std::string file = path.string();
  EXPECT_EQ(
      message_of("[noise]\nsingle_rat = 1\n").find(file + ":2: found an unknown key 'single_rat'; expected "),
      0u)
      << message_of("[noise]\nsingle_rat = 1\n");
  EXPECT_NE(message_of("[noise]\nsingle_rat = 1\n").find("Did you mean single_rate?"), std::string::npos);
  EXPECT_NE(message_of("\n[nose]\n").find(":2: found an unknown section 'nose'"), std::string::npos);
  EXPECT_NE(message_of("[noise]\nsingle_rate = -1\n")
                .find(":2: found 'single_rate = -1'; expected a number from 0"),
            std::string::npos);
  EXPECT_NE(message_of("[noise]\nsingle_rate = nan\n").find(":2: found"), std::string::npos);
  EXPECT_NE(message_of("[atwd]\nsamples = 8.5\n").find("a whole number from 8"), std::string::npos);
  EXPECT_NE(message_of("[local_coincidence]\nmode = \"firm\"\n").find("\"soft\", \"hard\" or \"none\""),
            std::string::npos);
  EXPECT_NE(message_of("[noise\n").find(":1: found"), std::string::npos);
  EXPECT_NE(message_of("noise = 3\n").find("a section [noise]"), std::string::npos);
  EXPECT_NE(
      message_of("[charge]\nsteep_share = 0.8\nexponential_share = 0.8\n").find("add up to more than 1"),
      std::string::npos);
}

}  // namespace floe
