#pragma once
/// Loops over many independent items on several threads.

#include <cstddef>
#include <functional>
#include <memory>

namespace dualdamp::sim {

/// Calls work(first, count) for parts of `grain` items that together cover `size` items; the last part may be
/// shorter. Uses at most `threads` threads; 0: all cores. Checks for a cancellation between parts
/// (`core/cancellation.hpp`).
void in_parts(std::size_t size, std::size_t grain, int threads,
              const std::function<void(std::size_t first, std::size_t count)>& work);

/// While this object exists, all loops together, nested ones too, use at most `threads` threads.
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
