#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>
#include <vector>

#include "sim/parallel.hpp"

namespace {

using namespace dualdamp;

/// Largest number of items under way at once in nested loops of 4 by 4, each of a millisecond.
int most_at_once() {
  std::atomic<int> now{0};
  std::atomic<int> most{0};
  sim::in_parts(4, 1, 0, [&](std::size_t, std::size_t) {
    sim::in_parts(4, 1, 0, [&](std::size_t, std::size_t) {
      const int here = ++now;
      for (int seen = most; seen < here && !most.compare_exchange_weak(seen, here);) {
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      --now;
    });
  });
  return most;
}

/// Whether two long parts run at the same time although each of them is a sequence of short loops. A part that
/// waits alone for 10 s gives up.
bool long_parts_meet() {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::seconds(10);
  std::atomic<int> begun{0};
  sim::in_parts(2, 1, 2, [&](std::size_t, std::size_t) {
    ++begun;
    while (begun < 2 && Clock::now() < end)
      sim::in_parts(8, 1, 0,
                    [](std::size_t, std::size_t) { std::this_thread::sleep_for(std::chrono::microseconds(10)); });
  });
  return Clock::now() < end;
}

}  // namespace

TEST_CASE("a limit on threads holds for nested loops, and ends with its scope") {
  {
    const sim::ThreadLimit limit(1);
    CHECK(most_at_once() == 1);
  }
  // Sixteen items of a millisecond overlap on any machine with two cores.
  if (std::thread::hardware_concurrency() > 1) CHECK(most_at_once() > 1);
}

TEST_CASE("parts cover every item once, the last part shorter") {
  std::vector<int> visits(10, 0);
  sim::in_parts(visits.size(), 4, 0, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) ++visits[i];
  });
  CHECK(visits == std::vector<int>(10, 1));
}

TEST_CASE("short loops inside long parts do not keep a thread from the next long part") {
  if (std::thread::hardware_concurrency() > 1)
    for (int i = 0; i < 20; ++i) REQUIRE(long_parts_meet());
}

TEST_CASE("a loop inside a loop of one thread has one thread") {
  std::atomic<int> others{0};
  sim::in_parts(4, 1, 1, [&](std::size_t, std::size_t) {
    const std::thread::id here = std::this_thread::get_id();
    sim::in_parts(16, 1, 0, [&](std::size_t, std::size_t) {
      if (std::this_thread::get_id() != here) ++others;
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    });
  });
  CHECK(others == 0);
}
