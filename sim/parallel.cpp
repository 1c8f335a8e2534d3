#include "sim/parallel.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <system_error>
#include <thread>
#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

#include "core/cancellation.hpp"

namespace dualdamp::sim {

namespace {

/// Whether the system can start a thread. oneTBB ends the computation if the system cannot, so it must
/// then not ask for one.
bool threads_are_to_be_had() {
  try {
    std::thread([] {}).join();
    return true;
  } catch (const std::system_error&) {
    return false;
  }
}

/// Tells the thread sanitizer that all parts of a loop begin after its call and end before its return, which it
/// does not see in a library that is not instrumented. Without the sanitizer this does nothing.
class LoopOrder {
 public:
  LoopOrder() { release(&begin_); }
  LoopOrder(const LoopOrder&) = delete;
  LoopOrder& operator=(const LoopOrder&) = delete;
  /// Also where a part threw: the loop waits for the others before it throws on.
  ~LoopOrder() { acquire(&end_); }

  class Part {
   public:
    explicit Part(LoopOrder& loop) : loop_(loop) { acquire(&loop_.begin_); }
    ~Part() { release(&loop_.end_); }
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

   private:
    LoopOrder& loop_;
  };

 private:
#ifdef __SANITIZE_THREAD__
  static void acquire(char* what) { __tsan_acquire(what); }
  static void release(char* what) { __tsan_release(what); }
#else
  static void acquire(char*) {}
  static void release(char*) {}
#endif
  char begin_ = 0;
  char end_ = 0;
};

}  // namespace

void in_parts(std::size_t size, std::size_t grain, int threads,
              const std::function<void(std::size_t first, std::size_t count)>& work) {
  namespace tbb = oneapi::tbb;
  static const int cores = threads_are_to_be_had() ? tbb::info::default_concurrency() : 1;
  const int most = threads > 0 ? std::min(threads, cores) : cores;
  LoopOrder order;
  const auto loop = [&] {
    tbb::parallel_for(std::size_t{0}, (size + grain - 1) / grain, [&](std::size_t part) {
      const LoopOrder::Part ordered(order);
      core::stop_if_cancelled();
      const std::size_t first = part * grain;
      work(first, std::min(grain, size - first));
    });
  };
  // A loop inside a loop shares the threads of the outer one: an arena of its own would take threads from parts
  // that take minutes for parts that take microseconds. Isolated, so that a thread that waits for the end of the
  // inner loop does not begin a part of the outer one.
  if (most < tbb::this_task_arena::max_concurrency())
    tbb::task_arena(most).execute(loop);
  else
    tbb::this_task_arena::isolate(loop);
}

struct ThreadLimit::Control {
  oneapi::tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads)
    : control_(
          new Control{{oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)}}) {}

ThreadLimit::~ThreadLimit() = default;

}  // namespace dualdamp::sim
