// Handing over results in order: from many threads, with slow pieces and with exceptions.
#include "propagation/engine/in_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "propagation/engine/random.h"

namespace floe {
namespace {

constexpr int threads = 6;

// Threads draw the pieces' numbers first .. first + count - 1 in rising order and work on them.
template <typename Work>
void share_out(std::int64_t first, std::int64_t count, Work work) {
  std::atomic<std::int64_t> next = first;
  std::vector<std::thread> crew;
  for (int t = 0; t < threads; ++t)
    crew.emplace_back([&] {
      for (std::int64_t piece = next++; piece < first + count; piece = next++) work(piece);
    });
  for (std::thread& thread : crew) thread.join();
}

// Slow now and then, so that pieces end in another order than they start.
void dawdle(std::int64_t piece) {
  const std::uint32_t draw = RandomStream(1, 0, static_cast<std::uint64_t>(piece)).bits();
  if (draw % 7 == 0) std::this_thread::sleep_for(std::chrono::microseconds(draw % 500));
}

TEST(InOrder, HandsOverEveryPieceOnceInOrder) {
  for (const std::int64_t ahead : {1, 2, 16, 1000})
    for (const std::int64_t first : {0, 12345}) {
      constexpr std::int64_t count = 3000;
      std::vector<std::int64_t> taken;
      int inside = 0;
      const auto take = [&](std::int64_t piece, const std::string& result) {
        EXPECT_EQ(++inside, 1);  // one at a time
        EXPECT_EQ(result, std::to_string(piece));
        taken.push_back(piece);
        --inside;
      };
      InOrder<std::string, decltype(take)> results(first, ahead, take);
      share_out(first, count, [&](std::int64_t piece) {
        results.bring(piece, [&] {
          dawdle(piece);
          return std::to_string(piece);
        });
      });
      results.rethrow();
      ASSERT_EQ(taken.size(), static_cast<std::size_t>(count));
      for (std::int64_t i = 0; i < count; ++i) ASSERT_EQ(taken[static_cast<std::size_t>(i)], first + i);
    }
}

// Results that exist and were not taken: those that wait, at most `ahead`, and one in every thread's hands.
TEST(InOrder, PilesUpNoMoreThanItMay) {
  struct Counted {
    explicit Counted(std::atomic<int>& number) : alive(&number) { ++*alive; }
    Counted(Counted&& other) noexcept : alive(other.alive) { other.alive = nullptr; }
    ~Counted() {
      if (alive) --*alive;
    }
    std::atomic<int>* alive;
  };
  for (const int ahead : {1, 4, 10}) {
    std::atomic<int> alive = 0, brought = 0, taken = 0;
    const auto take = [&](std::int64_t, const Counted&) {
      EXPECT_LE(alive.load(), ahead + threads);
      ++taken;
    };
    InOrder<Counted, decltype(take)> results(0, ahead, take);
    share_out(0, 200, [&](std::int64_t piece) {
      results.bring(piece, [&] {
        // The first piece is done long after as many others as may pile up, and no more, have been.
        if (piece == 0) {
          while (brought.load() < std::min(ahead - 1, 20)) std::this_thread::yield();
          std::this_thread::sleep_for(std::chrono::milliseconds(30));
          EXPECT_LE(alive.load(), ahead - 1 + threads - 1);
          EXPECT_EQ(taken.load(), 0);
        }
        ++brought;
        return Counted(alive);
      });
    });
    results.rethrow();
    EXPECT_EQ(taken.load(), 200);
    EXPECT_EQ(alive.load(), 0);
  }
}

// Nobody waits for the slow thread while there is room.
TEST(InOrder, GoesOnWhileOnePieceIsSlow) {
  std::atomic<int> done = 0;
  std::vector<std::int64_t> taken;
  const auto take = [&](std::int64_t piece, int) { taken.push_back(piece); };
  InOrder<int, decltype(take)> results(0, 100, take);
  share_out(0, 100, [&](std::int64_t piece) {
    results.bring(piece, [&] {
      if (piece == 0)
        while (done.load() < 99) std::this_thread::yield();  // endless if the others waited for it
      return 0;
    });
    ++done;
  });
  results.rethrow();
  EXPECT_EQ(taken.size(), 100U);
}

TEST(InOrder, EndsWithTheExceptionOfAPiece) {
  for (const std::int64_t wrong : {0, 1, 50, 199}) {
    std::int64_t taken = 0;
    const auto take = [&](std::int64_t piece, int) { EXPECT_EQ(piece, taken++); };
    InOrder<int, decltype(take)> results(0, 3, take);
    std::atomic<int> returned = 0;
    share_out(0, 200, [&](std::int64_t piece) {
      results.bring(piece, [&] {
        dawdle(piece);
        if (piece == wrong) throw std::runtime_error("piece " + std::to_string(piece));
        return 0;
      });
      ++returned;
    });
    EXPECT_EQ(returned.load(), 200);  // no thread waits for ever, nor sees the exception
    EXPECT_LE(taken, wrong);
    try {
      results.rethrow();
      ADD_FAILURE() << "nothing thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), "piece " + std::to_string(wrong));
    }
  }
}

TEST(InOrder, EndsWithTheExceptionOfWhoTakes) {
  std::int64_t taken = 0, made = 0;
  const auto take = [&](std::int64_t piece, int) {
    EXPECT_EQ(piece, taken++);
    if (piece == 70) throw std::runtime_error("disk full");
  };
  InOrder<int, decltype(take)> results(0, 3, take);
  for (std::int64_t piece = 0; piece < 200; ++piece) results.bring(piece, [&] { return ++made, 0; });
  EXPECT_EQ(taken, 71);  // nothing after that
  EXPECT_EQ(made, 71);   // and no more work
  EXPECT_THROW(results.rethrow(), std::runtime_error);
}

// Threads that wait for room are let go.
TEST(InOrder, WakesWhoWaitsForRoomWhenWhoTakesThrows) {
  std::atomic<int> brought = 0, returned = 0;
  const auto take = [&](std::int64_t, int) { throw std::runtime_error("disk full"); };
  InOrder<int, decltype(take)> results(0, 2, take);
  share_out(0, 100, [&](std::int64_t piece) {
    results.bring(piece, [&] {
      // The first piece is done when all other threads have theirs, most of which find no room.
      if (piece == 0)
        while (brought.load() < threads - 1) std::this_thread::yield();
      return ++brought;
    });
    ++returned;
  });
  EXPECT_EQ(returned.load(), 100);
  EXPECT_THROW(results.rethrow(), std::runtime_error);
}

// Nothing is taken once more while the exception is on its way: results take their time to be destroyed,
// which is when other threads come in.
TEST(InOrder, TakesNothingAfterAnExceptionOfWhoTakes) {
  struct Slow {
    Slow() = default;
    Slow(Slow&&) noexcept {}
    ~Slow() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }
  };
  int calls = 0;
  const auto take = [&](std::int64_t, const Slow&) {
    ++calls;
    throw std::runtime_error("disk full");
  };
  InOrder<Slow, decltype(take)> results(0, 100, take);
  share_out(0, 30, [&](std::int64_t piece) { results.bring(piece, [] { return Slow(); }); });
  EXPECT_EQ(calls, 1);
  EXPECT_THROW(results.rethrow(), std::runtime_error);
}

TEST(InOrder, EndsForAllThreadsWithTheExceptionOfWhoTakes) {
  std::int64_t taken = 0;
  const auto take = [&](std::int64_t piece, int) {
    EXPECT_EQ(piece, taken++);
    if (piece == 70) throw std::runtime_error("disk full");
  };
  InOrder<int, decltype(take)> results(0, 3, take);
  std::atomic<int> made = 0;
  share_out(0, 100000, [&](std::int64_t piece) {
    results.bring(piece, [&] {
      ++made;
      return 0;
    });
  });
  EXPECT_EQ(taken, 71);                      // nothing after that
  EXPECT_LE(made.load(), 71 + 3 + threads);  // and no more work
  EXPECT_THROW(results.rethrow(), std::runtime_error);
}

// Of several exceptions the first is kept.
TEST(InOrder, KeepsOneException) {
  const auto take = [](std::int64_t, int) { FAIL() << "nothing to take"; };
  InOrder<int, decltype(take)> results(0, 10, take);
  for (int piece = 0; piece < 3; ++piece)
    results.bring(piece, [&]() -> int { throw std::runtime_error(std::to_string(piece)); });
  try {
    results.rethrow();
    ADD_FAILURE() << "nothing thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "0");
  }
}

TEST(InOrder, WithoutExceptionsThrowsNothing) {
  const auto take = [](std::int64_t, int) {};
  InOrder<int, decltype(take)> results(0, 1, take);
  EXPECT_NO_THROW(results.rethrow());
}

}  // namespace
}  // namespace floe
