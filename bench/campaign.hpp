#pragma once
/// The stress test: every method against every departure from Coulomb + viscous friction.
///
/// The grid is computed motion by motion, on all threads of all processes; each finished case is written at once
/// (`case_file.hpp`); when all are there they are put in order and scored. Results depend neither on the number of
/// threads or processes nor on interruptions.
///
/// Errors: those of `CaseFile`.

#include <cstddef>
#include <functional>
#include <string>

#include "bench/processes.hpp"
#include "scenarios/run.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::bench {

struct Progress {
  std::size_t done = 0;  ///< cases, those of an earlier run included
  std::size_t all = 0;
  double rate = 0.0;       ///< cases a second
  double remaining = 0.0;  ///< s
};

struct CampaignOptions {
  int threads = 0;  ///< 0: all cores
  bool resume = false;
  std::function<void(const Progress&)> progress;  ///< may be absent; called by one thread at a time
};

/// What a campaign asks of the machine, before it runs.
struct CampaignSize {
  std::size_t motions = 0;
  std::size_t cases = 0;
  std::size_t estimates = 0;
  double seconds = 0.0;    ///< on all cores, from one motion of each law
  double megabytes = 0.0;  ///< of memory
};

[[nodiscard]] bool is_campaign(const scenarios::Scenario& scenario);

[[nodiscard]] CampaignSize size_of(const scenarios::Scenario& scenario);

/// Status 5 where cases have failed. Only process 0 returns scores; the others return an empty result.
[[nodiscard]] scenarios::RunResult run_campaign(const scenarios::Scenario& scenario, const std::string& directory,
                                                const CampaignOptions& options, Processes& processes);

}  // namespace dualdamp::bench
