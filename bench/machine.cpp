#include "bench/machine.h"

#include <fmt/format.h>

#include <fstream>
#include <thread>

namespace floe {

namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) {
      const std::size_t colon = line.find(": ");
      if (colon != std::string::npos) return line.substr(colon + 2);
    }
  return "unknown processor";
}

// The widest vectors that this processor has and that this build may use.
std::string vectors() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return "AVX-512";
  if (__builtin_cpu_supports("avx2")) return "AVX2";
#endif
  return "no AVX2";
}

}  // namespace

std::string machine_description() {
  return fmt::format("{} ({}), {} cores, g++ {}", processor_name(), vectors(),
                     std::thread::hardware_concurrency(), __VERSION__);
}

}  // namespace floe
