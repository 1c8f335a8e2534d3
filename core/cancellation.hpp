#pragma once
/// Cancellation: a long computation ends early because the user asked for it (Ctrl-C in the program).
///
/// One flag for the whole process reaches every thread of every loop. Each loop that may last longer than a tenth
/// of a second polls it with `stop_if_cancelled()`, which throws `Cancelled`. The exception leaves the public
/// function that was called; only the results of that call are lost. `Cancelled` is not a `std::exception`, so that
/// a loop which turns each failed case into a row with a reason does not catch it.
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
/// Resets the flag, so that computations may run again.
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
