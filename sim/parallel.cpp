#include "sim/parallel.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "core/cancellation.hpp"

namespace dualdamp::sim {

void in_parts(std::size_t size, std::size_t grain, int threads,
              const std::function<void(std::size_t first, std::size_t count)>& work) {
  namespace tbb = oneapi::tbb;
  const int cores = tbb::info::default_concurrency();
  tbb::task_arena arena(threads > 0 ? std::min(threads, cores) : cores);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, (size + grain - 1) / grain, [&](std::size_t part) {
      core::stop_if_cancelled();
      const std::size_t first = part * grain;
      work(first, std::min(grain, size - first));
    });
  });
}

struct ThreadLimit::Control {
  oneapi::tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads)
    : control_(
          new Control{{oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)}}) {}

ThreadLimit::~ThreadLimit() = default;

}  // namespace dualdamp::sim
