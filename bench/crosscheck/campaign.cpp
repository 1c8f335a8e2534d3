#include "bench/crosscheck/campaign.hpp"

#include <cstdio>

#include "bench/crosscheck/case.hpp"
#include "bench/crosscheck/random_scenario.hpp"

namespace dualdamp::crosscheck {

void run_campaign(std::uint64_t seed, std::uint32_t first, std::uint32_t count, const Limits& limits,
                  Summary& summary) {
  const auto work = [&](std::uint32_t index) {
    return to_json(check_case(random_scenario(seed, index), seed, index)).dump();
  };
  const auto done = [&](const Ending& ending) {
    summary.add_time(ending.seconds);
    if (ending.failure.empty())
      summary.add(case_report(Json::parse(ending.text)));
    else
      summary.add_failure(ending);
    if (const auto fault = summary.faults().find(ending.index); fault != summary.faults().end())
      std::fprintf(stderr, "%llu:%u  %s\n", static_cast<unsigned long long>(seed), ending.index,
                   fault->second.c_str());
  };
  run_in_children(first, count, limits, work, done);
}

}  // namespace dualdamp::crosscheck
