#pragma once
/// SIGINT ends the program with status 130, but never in the middle of writing results.

#include <mutex>

namespace dualdamp::cli {

/// To be called once, before any other thread starts.
void watch_for_interrupt();

/// Held while results are written; an interrupt waits for it.
[[nodiscard]] std::mutex& output_mutex();

}  // namespace dualdamp::cli
