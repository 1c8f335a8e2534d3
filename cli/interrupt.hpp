#pragma once
/// SIGINT and SIGTERM end the program with status 130, but never in the middle of writing results.
///
/// Computations are cancelled (`core/cancellation.hpp`) and the program ends in the ordinary way. What has not come
/// to an end after half a second, or when a second signal comes, is left as it is.

#include <mutex>

namespace dualdamp::cli {

/// To be called once, before any other thread starts.
void watch_for_interrupt();

/// Held while results are written; an interrupt waits for it.
[[nodiscard]] std::mutex& output_mutex();

/// To the standard error.
void say_interrupted();

}  // namespace dualdamp::cli
