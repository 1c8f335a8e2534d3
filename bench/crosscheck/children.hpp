#pragma once
/// Runs each case in a process of its own, so that a crash, an endless loop or a lack of memory is an entry in the
/// table and not the end of the campaign.

#include <cstdint>
#include <functional>
#include <string>

namespace dualdamp::crosscheck {

struct Limits {
  int jobs = 1;                                ///< processes at a time
  int processor_seconds = 10;                  ///< of one case
  int wall_seconds = 600;                      ///< of one case: it may wait for locks or for a busy machine
  std::size_t memory = std::size_t{4} << 30U;  ///< bytes
};

/// How a case ended.
struct Ending {
  std::uint32_t index = 0;
  std::string text;      ///< the result of `work`; empty when it did not return
  std::string failure;   ///< "killed by signal 11 (Segmentation fault)", "more than 10 s"; empty: none
  double seconds = 0.0;  ///< processor time
};

/// Calls `work(index)` for first <= index < first + count in children, and `done` in this process, in the order in
/// which they end. Errors: `std::system_error` when no process can be started.
void run_in_children(std::uint32_t first, std::uint32_t count, const Limits& limits,
                     const std::function<std::string(std::uint32_t)>& work,
                     const std::function<void(const Ending&)>& done);

}  // namespace dualdamp::crosscheck
