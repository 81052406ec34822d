#include "apps/parallel_events.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "propagation/engine/threads.h"

namespace floe {

EventShares share_cores(std::size_t events, int threads) {
  const int cores = thread_count(threads);
  const int workers = static_cast<int>(std::clamp<std::size_t>(events, 1, static_cast<std::size_t>(cores)));
  return {workers, std::max(1, cores / workers)};
}

void for_each_event(std::size_t events, int threads, const std::function<void(std::size_t, int)>& work) {
  const EventShares shares = share_cores(events, threads);
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto worker = [&] {
    for (std::size_t i; (i = next.fetch_add(1)) < events;) {
      try {
        work(i, shares.threads);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = events;
      }
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < shares.workers; ++i) others.emplace_back(worker);
  worker();
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace floe
