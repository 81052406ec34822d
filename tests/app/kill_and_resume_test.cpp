// Long runs that are killed at random moments, again and again: in the end they say what an undisturbed run
// says, and until then nothing stands under the final name.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include "data/event_files.h"
#include "tests/app/floe_runner.h"
#include "tests/app/same_events.h"
#include "tests/app/small_detector.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

using Json = nlohmann::ordered_json;
using Seconds = std::chrono::duration<double>;

struct Kills {
  int count;
  double latest;  // moment of a kill, as a share of the undisturbed run
  int progress;   // so many of the runs, at least, brought new rows before they were killed
};

// Starts floe and kills it after `time`; false when it had ended before.
bool kill_floe(const std::filesystem::path& folder, const std::string& arguments, Seconds time) {
  const pid_t process = start_floe(folder, arguments);
  std::this_thread::sleep_for(time);
  ::kill(process, SIGKILL);
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFSIGNALED(status);
}

// Every run took other time; all else is compared.
void drop_seconds(Json& json) {
  if (json.is_object()) json.erase("seconds");
  for (Json& part : json)
    if (part.is_structured()) drop_seconds(part);
}

// A command whose results go to NAME, and its rows to NAME.rows.
class KilledRun : public testing::Test {
 protected:
  using Command = std::function<std::string(const std::string& name)>;

  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
  Outcome floe(const std::string& arguments) const { return run_floe(folder_.path(), arguments); }
  Json json_in(const std::string& name) const {
    Json json = Json::parse(bytes_of(file(name)));
    drop_seconds(json);
    return json;
  }
  // Whole lines after the heading.
  std::size_t rows_in(const std::string& name) const {
    const std::string text = bytes_of(file(name));
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    return lines == 0 ? 0 : lines - 1;
  }

  // Runs undisturbed to "whole.json", and with kills to "killed.json" until it is short of its end. Says how
  // many rows the last kill left.
  std::size_t kill_repeatedly(const Command& command, int code, const Kills& kills) {
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = floe(command("whole.json"));
    const Seconds duration = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(outcome.code, code) << outcome.err;

    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0, kills.latest);
    std::size_t rows = 0;
    int progress = 0;
    for (int count = 0; count < kills.count;) {
      const bool killed = kill_floe(folder_.path(), command("killed.json"), share(random) * duration);
      count += killed;
      if (std::filesystem::exists(file("killed.json"))) {
        // It came to its end before this kill, and begins anew. What has its name is whole.
        EXPECT_EQ(json_in("killed.json"), json_in("whole.json"));
        std::filesystem::remove(file("killed.json"));
        std::filesystem::remove(file("killed.json.rows"));
        ++progress;
        rows = 0;
        continue;
      }
      if (!killed) {
        ADD_FAILURE() << "the run ended without a result";
        break;
      }
      const std::size_t now = rows_in("killed.json.rows");
      EXPECT_GE(now, rows) << "after kill " << count;
      progress += now > rows;
      rows = now;
    }
    EXPECT_GE(progress, kills.progress);
    return rows;
  }

  TemporaryFolder folder_;
};

// Every eighth event can be fitted, in less than a second; the others have too little light and are done at
// once, so that some of their rows stand before those of events that come first.
TEST_F(KilledRun, OfReconstructSaysWhatAnUndisturbedOneSays) {
  constexpr std::size_t events = 50;
  write_small_detector(file("geo"), 40);
  std::ostringstream particles;
  for (std::size_t i = 0; i < events; ++i)
    particles << "EM " << i + 1 << " 1 1970 0 0 0\nTR 1 0 e- 3 " << 0.2 * double(i) << " -303 70 " << 7 * i
              << " 0 " << (i % 8 == 1 ? 300 : 1) << " 0\n";
  write_bytes(file("run.f2k"), particles.str());
  const Outcome simulated = floe("simulate --f2k run.f2k --detector geo --oversize 20 --quiet -o run.h5");
  ASSERT_EQ(simulated.code, 0) << simulated.err;

  // Two threads, so that the moments of kills do not depend on how many cores there are.
  const auto command = [](const std::string& name) {
    return "reconstruct run.h5 --detector geo --oversize 20 --effort 0.01 --threads 2 --json " + name;
  };
  const std::size_t rows = kill_repeatedly(command, 4, {20, 0.5, 4});
  const Outcome outcome = floe(command("killed.json"));
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  if (rows > 0) {
    const std::string found = "going on after " + std::to_string(rows) + " of " + std::to_string(events);
    EXPECT_NE(outcome.err.find(found), std::string::npos) << found << " in:\n" << outcome.err;
  }
  EXPECT_FALSE(std::filesystem::exists(file("killed.json.rows")));

  const Json killed = json_in("killed.json"), whole = json_in("whole.json");
  ASSERT_EQ(killed["events"].size(), events);
  std::size_t dim = 0, bright = 0;
  for (std::size_t i = 0; i < events; ++i) {
    EXPECT_EQ(killed["events"][i]["event"], "run-" + std::to_string(i + 1));
    EXPECT_EQ(killed["events"][i], whole["events"][i]) << "event " << i;
    (i % 8 == 1 ? bright : dim) += killed["events"][i]["status"] == "not_enough_light";
  }
  EXPECT_EQ(dim, 43u);
  EXPECT_EQ(bright, 0u);
  EXPECT_EQ(killed, whole);
}

TEST_F(KilledRun, OfStudySaysWhatAnUndisturbedOneSays) {
  // Wide enough for vertices 50 m inside.
  write_small_detector(file("geo"), 70);
  const auto command = [](const std::string& name) {
    return "study --group 300,3,20 --detector geo --effort 0.02 --threads 2 --quiet --json " + name +
           " --rows " + name + ".rows";
  };
  kill_repeatedly(command, 0, {5, 0.8, 1});
  const Outcome outcome = floe(command("killed.json"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(json_in("killed.json"), json_in("whole.json"));

  // Each event once, in any order of writing.
  const auto rows = [&](const std::string& name) {
    std::set<std::string> lines;
    std::istringstream text(bytes_of(file(name)));
    for (std::string line; std::getline(text, line);) {
      Json row = Json::parse(line);
      drop_seconds(row);
      EXPECT_TRUE(lines.insert(row.dump()).second) << "twice in " << name << ": " << row.dump();
    }
    return lines;
  };
  EXPECT_EQ(rows_in("killed.json.rows"), 3u);
  EXPECT_EQ(rows("killed.json.rows"), rows("whole.json.rows"));
}

TEST_F(KilledRun, OfSimulateLosesAndRepeatsNoEvent) {
  constexpr std::size_t events = 30;
  write_small_detector(file("geo"), 40);
  std::ostringstream particles;
  for (std::size_t i = 0; i < events; ++i)
    particles << "EM " << i + 1 << " 1 1970 0 0 0\nTR 1 0 e- 3 2 -303 70 " << 7 * i << " 0 300 0\n";
  write_bytes(file("run.f2k"), particles.str());
  const auto command = [](const std::string& name) {
    return "simulate --f2k run.f2k --detector geo --oversize 4 --threads 1 --quiet -o " + name +
           ".h5 --json " + name;
  };
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(floe(command("whole.json")).code, 0);
  const Seconds duration = std::chrono::steady_clock::now() - start;
  // Far from the end, so that there is something to go on with.
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(kill_floe(folder_.path(), command("killed.json"), 0.3 * duration));
  const Outcome outcome = floe(command("killed.json"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("going on after "), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(file("killed.json.h5.parts")));

  EXPECT_EQ(json_in("killed.json")["events"], json_in("whole.json")["events"]);
  const EventFile killed = read_event_file(file("killed.json.h5"));
  ASSERT_EQ(killed.events.size(), events);
  for (const Event& event : killed.events) EXPECT_EQ(event.truth.size(), 1u);
  expect_same_events(file("killed.json.h5"), file("whole.json.h5"));
}

}  // namespace
}  // namespace floe::test
