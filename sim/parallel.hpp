#pragma once
/// Loops over many independent items on several threads.

#include <cstddef>
#include <functional>
#include <memory>

namespace dualdamp::sim {

/// Calls work(first, count) for parts of `grain` items, the last one shorter, that cover `size` items; `threads` at
/// most, 0: all cores. Between parts it looks for a cancellation (`core/cancellation.hpp`).
void in_parts(std::size_t size, std::size_t grain, int threads,
              const std::function<void(std::size_t first, std::size_t count)>& work);

/// While it lives all loops together use `threads` at most, nested ones too.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

}  // namespace dualdamp::sim
