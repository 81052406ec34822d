#include "bench/sampling_profile.h"

#include <dlfcn.h>
#include <sys/time.h>
#include <ucontext.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "bench/program_symbols.h"

namespace floe {

namespace {

constexpr std::size_t most_samples = 1u << 20;  // a quarter of an hour
constexpr suseconds_t interval = 997;           // [us]; prime, to keep out of step with the work

// Handlers of signals take no arguments of ours. The stack is not looked at: what compilers tell about it
// does not hold at every instruction of vector code.
void** samples = nullptr;
std::atomic<std::size_t> taken{0};

void take_sample(int, siginfo_t*, void* context) {
  const std::size_t i = taken.load(std::memory_order_relaxed);
  if (i == most_samples) return;
#if defined(__x86_64__)
  samples[i] = reinterpret_cast<void*>(static_cast<ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
#elif defined(__aarch64__)
  samples[i] = reinterpret_cast<void*>(static_cast<ucontext_t*>(context)->uc_mcontext.pc);
#else
#error "tell here where this processor keeps its place in the program"
#endif
  taken.store(i + 1, std::memory_order_relaxed);
}

void set_timer(suseconds_t microseconds) {
  itimerval timer{};
  timer.it_interval.tv_usec = timer.it_value.tv_usec = microseconds;
  setitimer(ITIMER_REAL, &timer, nullptr);
}

class TimerInterrupts {
 public:
  TimerInterrupts() {
    struct sigaction action {};
    action.sa_sigaction = take_sample;
    action.sa_flags = SA_RESTART | SA_SIGINFO;
    sigaction(SIGALRM, &action, &before_);
    set_timer(interval);
  }
  ~TimerInterrupts() {
    set_timer(0);
    sigaction(SIGALRM, &before_, nullptr);
  }
  TimerInterrupts(const TimerInterrupts&) = delete;
  TimerInterrupts& operator=(const TimerInterrupts&) = delete;

 private:
  struct sigaction before_ {};
};

// A function of the program whose name contains `function`, or anything in a library whose file name
// contains `library`. The first rule that fits counts.
struct Rule {
  const char* part;
  std::string_view function, library;
};
constexpr const char* everything_else = "the walk itself: refill, hits";
constexpr Rule rules[] = {
    {"birth of photons", "::emit(", ""},
    {"birth of photons", "floe::bear_photons", ""},
    {"birth of photons", "::widen_beam(", ""},
    {"birth of photons", "::isotropic_directions(", ""},
    {"depth to the next scatter", "floe::draw_scattering_depths", ""},
    {"layer tilt", "floe::LayerTilt::", ""},
    {"walk through the layers", "floe::find_segments", ""},
    {"clearance of the modules", "floe::find_reach", ""},
    {"the nearest column alone", "floe::cross_module", ""},
    {"the nearest column alone", "floe::ColumnFinder::", ""},
    {"Embree", "", "libembree"},
    {"Embree", "EmbreeFinder", ""},
    {"acceptance by the module", "floe::PhotonAcceptance::", ""},
    {"acceptance by the module", "floe::AngularAcceptance::", ""},
    {"to the next scatter, birefringence", "floe::advance", ""},
    {"to the next scatter, birefringence", "::birefringent_step(", ""},
    {"new direction", "::scatter(", ""},
    {"new direction", "floe::scatter", ""},
    {everything_else, "", ""},
};

// Where a sample was taken: a function of the program, else a library.
struct Place {
  std::string function, library;
};
Place place_of(const void* address, const ProgramSymbols& symbols) {
  Place place{symbols.function_at(address), {}};
  Dl_info info{};
  if (place.function.empty() && dladdr(address, &info) != 0 && info.dli_fname) place.library = info.dli_fname;
  return place;
}

const char* part_of(const Place& place) {
  const auto fits = [](const std::string& text, std::string_view wanted) {
    return !wanted.empty() && text.find(wanted) != std::string::npos;
  };
  for (const Rule& rule : rules)
    if (fits(place.function, rule.function) || fits(place.library, rule.library)) return rule.part;
  return everything_else;
}

std::vector<ProfilePart> empty_parts() {
  std::vector<ProfilePart> parts;
  for (const Rule& rule : rules)
    if (parts.empty() || parts.back().name != rule.part) parts.push_back({rule.part, 0});
  return parts;
}

}  // namespace

Profile profile_of(const std::function<void()>& work) {
  const ProgramSymbols symbols;
  const std::unique_ptr<void*[]> memory(new void*[most_samples]);
  samples = memory.get();
  taken = 0;
  {
    const TimerInterrupts interrupts;
    work();
  }
  Profile profile{taken, empty_parts(), {}};
  const double point = 1 / static_cast<double>(profile.samples);
  std::map<std::string, double> functions;
  for (std::size_t i = 0; i < profile.samples; ++i) {
    const Place place = place_of(samples[i], symbols);
    functions[place.function.empty() ? place.library : place.function] += point;
    const std::string_view part = part_of(place);
    for (ProfilePart& p : profile.parts)
      if (p.name == part) p.share += point;
  }
  for (const auto& [name, share] : functions) profile.functions.push_back({name, share});
  std::sort(profile.functions.begin(), profile.functions.end(),
            [](const ProfilePart& a, const ProfilePart& b) { return a.share > b.share; });
  return profile;
}

}  // namespace floe
