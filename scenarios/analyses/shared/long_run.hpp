#pragma once
/// Common parts of runs of many cases: the work is distributed to threads and processes, finished cases are kept in
/// a file (`results/case_file.hpp`), and progress is reported.

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>

#include "scenarios/analyses/shared/run_options.hpp"
#include "scenarios/results/case_file.hpp"

namespace dualdamp::scenarios {

/// Fingerprint of a run: the same scenario, program and data give the same lines. `inputs`: the resolved scenario,
/// and digests of the other data on which the lines depend.
[[nodiscard]] std::string fingerprint(const std::string& inputs);

/// Opens the file for all processes together and treats earlier cases as the options say. True when all cases are
/// already there.
bool open_cases(CaseFile& file, std::size_t cases, const RunOptions& options);

/// Calls work(0) to work(count - 1), on all threads of all processes.
void share_out(std::size_t count, const RunOptions& options, const std::function<void(std::size_t)>& work);

/// Counts finished cases and reports progress at intervals.
class Meter {
 public:
  Meter(std::size_t done, std::size_t all, const RunOptions& options);

  /// Counts one case; from any thread.
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
