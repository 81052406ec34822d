// Results of work that is shared out to threads, handed over in the order of the work.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <map>
#include <mutex>
#include <utility>

namespace floe {

// Threads bring the results of pieces first, first + 1, ... as they finish them; `take` receives them in that
// order, one at a time, from whichever thread completes the row. Nobody waits for a slower thread unless
// `ahead` >= 1 results are piled up. An exception, of a piece or of `take`, ends the hand-over: later results
// are dropped, and rethrow() throws it.
template <typename Result, typename Take>
class InOrder {
 public:
  InOrder(std::int64_t first, std::int64_t ahead, Take take)
      : next_(first), ahead_(ahead), take_(std::move(take)) {}

  // Makes the result of a piece and brings it. Every piece must be brought, in rising order by any thread.
  template <typename Make>
  void bring(std::int64_t piece, Make make) {
    std::unique_lock lock(mutex_, std::defer_lock);
    try {
      if (failed()) return;
      Result result = make();
      lock.lock();
      room_.wait(lock, [&] { return failure_ || piece < next_ + ahead_; });
      if (failure_) return;
      waiting_.emplace(piece, std::move(result));
      for (auto at = waiting_.begin(); at != waiting_.end() && at->first == next_; at = waiting_.begin()) {
        take_(at->first, at->second);
        waiting_.erase(at);
        ++next_;
      }
    } catch (...) {
      // What `take` throws is kept before another thread can come in and call it again.
      if (!lock.owns_lock()) lock.lock();
      if (!failure_) failure_ = std::current_exception();
    }
    room_.notify_all();
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  bool failed() const {
    const std::lock_guard lock(mutex_);
    return failure_ != nullptr;
  }

  mutable std::mutex mutex_;
  std::condition_variable room_;
  std::map<std::int64_t, Result> waiting_;
  std::int64_t next_, ahead_;
  std::exception_ptr failure_;
  Take take_;
};

}  // namespace floe
