#pragma once
/// Cancellation: a long computation ends early because the user asked for it (Ctrl-C in the program).
///
/// One flag for the whole process reaches every thread of every loop. Each loop that may last longer than a tenth
/// of a second polls it with `stop_if_cancelled()`, which throws `Cancelled`. The exception leaves through the
/// public entrance that was called; results of that call are lost, nothing else is. It is not a `std::exception`,
/// so that a loop which makes a row with a reason of every failed case does not take it for a failure.
///
/// Cost of a poll: one load and one branch.

#include <atomic>

namespace dualdamp::core {

/// Thrown by a computation that was cancelled.
struct Cancelled {};

namespace detail {
extern std::atomic<bool> cancelled;
[[noreturn]] void throw_cancelled();
}  // namespace detail

/// May be called from any thread, and from a signal handler.
void request_cancellation() noexcept;
/// Computations may run again.
void clear_cancellation() noexcept;

[[nodiscard]] inline bool cancellation_requested() noexcept {
  return detail::cancelled.load(std::memory_order_relaxed);
}

/// Throws `Cancelled` once cancellation has been requested.
inline void stop_if_cancelled() {
  if (cancellation_requested()) [[unlikely]]
    detail::throw_cancelled();
}

}  // namespace dualdamp::core
