#pragma once
/// Runs work in a child process. Purpose: a library that can crash, hang or use all memory on a damaged file.
///
/// The child is a fork of the caller, so it has a copy of all data. It has a single thread, which runs `work` and
/// sends the bytes that `work` writes over a pipe. Nothing else comes back, and the standard error of the child is
/// dropped. The child runs no exit handlers of the caller, and is killed if the caller ends.
///
/// Open files of the caller, except the standard ones, are closed in the child. `work` must open its own files.
///
/// Other threads of the caller may run. They do not exist in the child, so `work` must not take a lock that one of
/// them may hold. The locks of the C library's allocator and streams are free in the child.
///
/// Errors: `IsolatedEnd`; throws only if the caller lacks memory. Cost: about 2 ms and a copy of the result. The
/// limit on memory is not applied under the address sanitizer, which reserves terabytes.

#include <chrono>
#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace dualdamp::identify {

struct IsolationLimits {
  std::chrono::seconds processor_time;
  std::chrono::seconds wall_clock;
  std::size_t memory = 0;  ///< bytes of address space in addition to the caller's
};

enum class IsolatedEnd {
  done,           ///< `bytes` holds all that `work` has written
  crashed,        ///< a signal or an exception ended it
  out_of_memory,  ///< std::bad_alloc under the limit
  out_of_time,
};

struct IsolatedResult {
  IsolatedEnd end = IsolatedEnd::crashed;
  std::string bytes;
};

/// Takes bytes of the result. Ends the child if the caller has closed the pipe.
using ByteSink = std::function<void(std::span<const char>)>;

/// Errors: `std::system_error` if no process or pipe can be created.
[[nodiscard]] IsolatedResult run_isolated(const IsolationLimits& limits,
                                          const std::function<void(const ByteSink&)>& work);

}  // namespace dualdamp::identify
