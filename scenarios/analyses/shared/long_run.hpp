#pragma once
/// What runs of many cases have in common: their work is shared out among threads and processes, their finished
/// cases are kept in a file (`results/case_file.hpp`), and they tell how far they are.

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>

#include "scenarios/analyses/shared/run_options.hpp"
#include "scenarios/results/case_file.hpp"

namespace dualdamp::scenarios {

/// The same scenario run by the same program on the same data gives the same lines. `inputs`: the resolved
/// scenario, and digests of what else the lines depend on.
[[nodiscard]] std::string fingerprint(const std::string& inputs);

/// Opens the file for all processes together, after what the options say about earlier cases. True where all cases
/// are there already.
bool open_cases(CaseFile& file, std::size_t cases, const RunOptions& options);

/// Calls work(0) to work(count - 1), on all threads of all processes.
void share_out(std::size_t count, const RunOptions& options, const std::function<void(std::size_t)>& work);

/// Counts finished cases and tells of them now and then.
class Meter {
 public:
  Meter(std::size_t done, std::size_t all, const RunOptions& options);

  /// One more; from any thread.
  void add();

 private:
  using Clock = std::chrono::steady_clock;

  std::size_t first_;
  std::size_t done_;
  std::size_t all_;
  const RunOptions& options_;
  Clock::time_point start_;
  Clock::time_point told_;
  std::mutex mutex_;
};

}  // namespace dualdamp::scenarios
