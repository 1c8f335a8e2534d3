#pragma once
/// Where and how a question is run, and the processes that share a long run.

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "scenarios/results/found_cases.hpp"

namespace dualdamp::scenarios {

/// Progress of a long run.
struct Progress {
  std::size_t done = 0;  ///< cases, those of an earlier run included
  std::size_t all = 0;
  double rate = 0.0;       ///< cases a second
  double remaining = 0.0;  ///< s
};

/// Hands out the items of one run, 0, 1, 2, ..., each once; from any thread.
class ItemCounter {
 public:
  ItemCounter() = default;
  virtual ~ItemCounter() = default;
  ItemCounter(const ItemCounter&) = delete;
  ItemCounter& operator=(const ItemCounter&) = delete;

  [[nodiscard]] virtual std::size_t next() { return next_++; }

 private:
  std::atomic<std::size_t> next_{0};
};

/// The processes that share the work of a run. This one is alone.
class ProcessGroup {
 public:
  ProcessGroup() = default;
  virtual ~ProcessGroup() = default;
  ProcessGroup(const ProcessGroup&) = delete;
  ProcessGroup& operator=(const ProcessGroup&) = delete;

  [[nodiscard]] virtual int rank() const { return 0; }
  /// A separate counter for each run, shared by all processes; every process must call this.
  [[nodiscard]] virtual std::unique_ptr<ItemCounter> share_items() { return std::make_unique<ItemCounter>(); }
  /// Waits for all processes.
  virtual void wait() {}
};

/// Where and how a question is run. A short run needs none of these options.
struct RunOptions {
  std::string directory = {};                          ///< of files that a campaign writes during its run
  int threads = 0;                                     ///< of a campaign; 0: all cores
  FoundCases found = FoundCases::refuse;               ///< of a campaign: cases of an earlier run
  std::function<void(const Progress&)> progress = {};  ///< may be absent; called by one thread at a time
  std::shared_ptr<ProcessGroup> processes = std::make_shared<ProcessGroup>();  ///< share a campaign
};

}  // namespace dualdamp::scenarios
