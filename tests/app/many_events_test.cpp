// A file of a thousand events takes no more memory than one of a few.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <sstream>

#include "tests/app/floe_runner.h"
#include "tests/app/small_detector.h"
#include "tests/unit/data/temporary_folder.h"

namespace floe::test {
namespace {

// Largest resident memory [MB] of floe with these arguments.
double memory_of(const std::filesystem::path& folder, const std::string& arguments) {
  const pid_t process = start_floe(folder, arguments);
  int status = 0;
  rusage usage{};
  ::wait4(process, &status, 0, &usage);
  EXPECT_EQ(status, 0) << arguments;
  return double(usage.ru_maxrss) / 1024;  // reported in kB
}

std::string particles(int events) {
  std::ostringstream text;
  for (int i = 1; i <= events; ++i)
    text << "EM " << i << " 1 1970 0 0 0\nTR 1 0 e- 3 2 -303 70 " << i % 360 << " 0 5 0\n";
  return text.str();
}

TEST(ManyEvents, TakeNoMoreMemoryThanFew) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer keeps what was freed";
#endif
  constexpr double most = 12;  // [MB]: 12 kB an event
  const TemporaryFolder folder;
  write_small_detector(folder.path() / "geo", 40);
  double simulated[2], responded[2];
  const int events[2] = {30, 1000};
  for (int i = 0; i < 2; ++i) {
    write_bytes(folder.path() / "run.f2k", particles(events[i]));
    simulated[i] =
        memory_of(folder.path(), "simulate --f2k run.f2k --detector geo --threads 1 --quiet -o run.h5");
    responded[i] = memory_of(folder.path(), "respond run.h5 --detector geo --threads 1 --quiet -o pulses.h5");
  }
  EXPECT_LT(simulated[1] - simulated[0], most);
  EXPECT_LT(responded[1] - responded[0], most);
}

}  // namespace
}  // namespace floe::test
