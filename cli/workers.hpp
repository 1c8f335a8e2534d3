#pragma once
/// Threads that share a list of items.

#include <cstddef>
#include <functional>

namespace dualdamp::cli {

/// Calls `work` for each number below `count`, in order, on `threads` threads; on fewer, but at least the calling
/// one, if the system has no more. An exception in any thread stops the others after their item; the first one is
/// thrown when all have ended.
void share_among(std::size_t threads, std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace dualdamp::cli
