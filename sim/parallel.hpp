#pragma once
/// Loops over many independent items on several threads.

#include <cstddef>
#include <functional>

namespace dualdamp::sim {

/// Calls work(first, count) for parts of `grain` items, the last one shorter, that cover `size` items; `threads` at
/// most, 0: all cores.
void in_parts(std::size_t size, std::size_t grain, int threads,
              const std::function<void(std::size_t first, std::size_t count)>& work);

}  // namespace dualdamp::sim
