#pragma once
/// Work in a child process, for a library that a damaged file can make crash, hang or ask for all memory.
///
/// The child is a fork of the caller: it sees all data as they were, runs `work` in the one thread it has, sends
/// what that writes over a pipe, and ends without the caller's exit handlers. Nothing else of what it does comes
/// back, and what it prints on standard error is dropped. It ends with the caller.
///
/// Files that the caller has open are closed in the child, but for the standard ones: `work` opens its own.
///
/// Other threads may be running: they do not exist in the child, so that `work` must not take a lock that one of
/// them may hold. Those of the C library's allocator and streams are free in the child.
///
/// Errors: `IsolatedEnd`; none thrown but for lack of memory in the caller. Cost: some 2 ms and a copy of the
/// result. Under the address sanitizer, which reserves terabytes, the limit on memory does not hold.

#include <chrono>
#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace dualdamp::identify {

struct IsolationLimits {
  std::chrono::seconds processor_time;
  std::chrono::seconds wall_clock;
  std::size_t memory = 0;  ///< bytes of address space beyond the caller's
};

enum class IsolatedEnd {
  done,           ///< `bytes` is all that `work` has written
  crashed,        ///< ended by a signal or an exception
  out_of_memory,  ///< std::bad_alloc under the limit
  out_of_time,
  not_started,  ///< no process or pipe to be had
};

struct IsolatedResult {
  IsolatedEnd end = IsolatedEnd::not_started;
  std::string bytes;
};

/// Takes the bytes of the result; ends the child when the caller no longer listens.
using ByteSink = std::function<void(std::span<const char>)>;

[[nodiscard]] IsolatedResult run_isolated(const IsolationLimits& limits,
                                          const std::function<void(const ByteSink&)>& work);

}  // namespace dualdamp::identify
