#pragma once
/// Where and how a question is run; the processes that share a long run.

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace dualdamp::scenarios {

/// How far a long run is.
struct Progress {
  std::size_t done = 0;  ///< cases, those of an earlier run included
  std::size_t all = 0;
  double rate = 0.0;       ///< cases a second
  double remaining = 0.0;  ///< s
};

/// The processes that share the work of a run, handed out one item at a time. This one is alone.
class ProcessGroup {
 public:
  ProcessGroup() = default;
  virtual ~ProcessGroup() = default;
  ProcessGroup(const ProcessGroup&) = delete;
  ProcessGroup& operator=(const ProcessGroup&) = delete;

  [[nodiscard]] virtual int rank() const { return 0; }
  /// The next item, 0, 1, 2, ... over all processes; from any thread.
  [[nodiscard]] virtual std::size_t next() { return next_++; }
  /// Waits for all processes.
  virtual void wait() {}

 private:
  std::atomic<std::size_t> next_{0};
};

/// Where and how a question is run. A short one needs none of this.
struct RunOptions {
  std::string directory = {};                          ///< of files that a campaign writes as it goes
  int threads = 0;                                     ///< of a campaign; 0: all cores
  bool resume = false;                                 ///< a campaign goes on where an earlier run was interrupted
  std::function<void(const Progress&)> progress = {};  ///< may be absent; called by one thread at a time
  std::shared_ptr<ProcessGroup> processes = std::make_shared<ProcessGroup>();  ///< share a campaign
};

}  // namespace dualdamp::scenarios
