#pragma once
/// The stress test: every method against every departure from Coulomb + viscous friction.
///
/// The grid is computed motion by motion, on all threads of all processes. Each finished case is written at once
/// (`scenarios/results/case_file.hpp`). When all cases are written they are put in order and scored. Results depend
/// neither on the number of threads or processes nor on interruptions.
///
/// Errors: those of `scenarios::CaseFile`.

#include <cstddef>
#include <string>

#include "bench/stress_test.hpp"

namespace dualdamp::bench {

/// Estimated size of a campaign, before it runs.
struct CampaignSize {
  std::size_t motions = 0;
  std::size_t cases = 0;
  std::size_t estimates = 0;
  double seconds = 0.0;    ///< on all cores, from one motion of each departure
  double megabytes = 0.0;  ///< of memory
};

[[nodiscard]] CampaignSize size_of(const StressTest& question, const scenarios::RunContext& context);

/// One line for a title.
[[nodiscard]] std::string describe(const CampaignSize& size);

/// Runs and scores the campaign. Only process 0 returns scores; the others return an empty answer.
[[nodiscard]] scenarios::Answer run_campaign(const StressTest& question, const scenarios::RunContext& context);

}  // namespace dualdamp::bench
