// Many events over all cores.
#pragma once

#include <cstddef>
#include <functional>

namespace floe {

// How many events are worked on at a time, and with how many threads each: events side by side as far as
// there are enough of them, for a fit's serial parts leave cores idle.
struct EventShares {
  int workers = 1, threads = 1;
};
EventShares share_cores(std::size_t events, int threads);  // threads 0: all cores

// Calls work(i, threads) for every i < events, from several threads. Events begin in order. The first
// exception stops what has not begun and is thrown again when all are back.
void for_each_event(std::size_t events, int threads, const std::function<void(std::size_t, int)>& work);

}  // namespace floe
