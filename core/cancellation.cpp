#include "core/cancellation.hpp"

namespace dualdamp::core {

namespace detail {

std::atomic<bool> cancelled = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void throw_cancelled() { throw Cancelled{}; }

}  // namespace detail

void request_cancellation() noexcept { detail::cancelled.store(true, std::memory_order_relaxed); }

void clear_cancellation() noexcept { detail::cancelled.store(false, std::memory_order_relaxed); }

}  // namespace dualdamp::core
