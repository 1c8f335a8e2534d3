#pragma once
/// Ends the program with status 130 on SIGINT or SIGTERM, but never while it writes results.
///
/// Computations are cancelled (`core/cancellation.hpp`), and the program ends in the ordinary way. If that takes
/// longer than half a second, or if a second signal comes, the process exits at once. A signal that is ignored when
/// the program starts stays ignored.

#include <mutex>

namespace dualdamp::cli {

/// Starts to watch for the signals. Call it once, before any other thread starts.
void watch_for_interrupt();

/// Hold this mutex while results are written: an interrupt waits for it.
[[nodiscard]] std::mutex& output_mutex();

/// Prints the message of an interruption to stderr.
void say_interrupted();

}  // namespace dualdamp::cli
