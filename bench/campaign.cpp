#include "bench/campaign.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "bench/case.hpp"
#include "bench/grid.hpp"
#include "bench/score/score_tables.hpp"
#include "bench/score/scores.hpp"
#include "core/build_info.hpp"
#include "core/numbers.hpp"
#include "scenarios/analyses/shared/long_run.hpp"
#include "scenarios/results/case_file.hpp"

namespace dualdamp::bench {

namespace {

using Clock = std::chrono::steady_clock;
using scenarios::RunContext;
using scenarios::RunOptions;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The remaining motions, on all threads of all processes.
void run_cases(const Grid& grid, const RunContext& context, scenarios::CaseFile& file) {
  const RunOptions& options = context.options;
  const sim::SteadyStateOptions steady = context.steady_states();
  scenarios::Meter meter(file.finished(), grid.cases(), options);
  const auto wanted = [&](std::size_t number) { return !file.is_finished(number); };
  const auto take = [&](const std::string& line) {
    file.add(line);
    meter.add();
  };
  scenarios::share_out(grid.motions(), options,
                       [&](std::size_t motion) { run_motion(grid, steady, motion, wanted, take); });
}

/// Estimated seconds on all cores: one motion of each departure is computed, read once, and stands for all of that
/// departure.
double seconds_of_campaign(const StressTest& question, const CampaignSize& size, const RunContext& context) {
  StressTest sample = question;
  const std::size_t severities = sample.severities.size();
  sample.severities = {sample.severities[severities / 2]};
  sample.ranges.resize(1);
  sample.rigs.resize(1);
  sample.seeds = 1;
  const Grid grid(sample);
  const auto seconds_of = [&](const Grid& cases, std::size_t motion) {
    const Clock::time_point start = Clock::now();
    run_motion(cases, context.steady_states(), motion, [](std::size_t) { return true; }, [](const std::string&) {});
    return seconds_since(start);
  };
  double motions = 0.0;
  for (std::size_t motion = 0; motion < grid.motions(); ++motion) motions += seconds_of(grid, motion);
  const double threads = std::thread::hardware_concurrency();
  const double seconds =
      motions * static_cast<double>(severities * question.ranges.size() * question.rigs.size()) / threads;
  if (question.seeds <= 1) return seconds;
  // Time of further readings of a motion. The motion is timed again, because the first motion of a run is slower.
  constexpr int most = 5;
  const double once = seconds_of(grid, 0);
  StressTest repeated = sample;
  repeated.seeds = std::min(question.seeds, most);
  const Grid several(repeated);
  const auto further = static_cast<double>(several.cases_per_motion() - grid.cases_per_motion());
  return seconds + std::max(seconds_of(several, 0) - once, 0.0) / further *
                       static_cast<double>(size.cases - size.motions * grid.cases_per_motion()) / threads;
}

/// Estimated memory [MB], from what a run takes for each of these.
double megabytes_of_campaign(const StressTest& question, const CampaignSize& size) {
  constexpr double of_program = 60.0;
  constexpr double of_case = 30e-6;
  constexpr double of_estimate = 40e-6;
  constexpr double of_sample = 130e-6;  // of a random response, in each thread
  const double megabytes =
      of_program + of_case * static_cast<double>(size.cases) + of_estimate * static_cast<double>(size.estimates);
  const double threads = std::thread::hardware_concurrency();
  return megabytes + (question.random ? of_sample * question.random->samples() * threads : 0.0);
}

}  // namespace

CampaignSize size_of(const StressTest& question, const RunContext& context) {
  const Grid grid(question);
  CampaignSize size{
      .motions = grid.motions(), .cases = grid.cases(), .estimates = grid.cases() * question.methods.size()};
  size.seconds = seconds_of_campaign(question, size, context);
  size.megabytes = megabytes_of_campaign(question, size);
  return size;
}

std::string describe(const CampaignSize& size) {
  constexpr int digits = 2;
  return std::to_string(size.cases) + " cases of " + std::to_string(size.motions) + " motions, " +
         std::to_string(size.estimates) + " estimates: about " + core::format_number(size.seconds, digits) +
         " s on this machine's cores, " + core::format_number(size.megabytes, digits) + " MB";
}

scenarios::Answer run_campaign(const StressTest& question, const RunContext& context) {
  const Grid grid(question);
  const RunOptions& options = context.options;
  scenarios::ProcessGroup& processes = *options.processes;
  scenarios::CaseFile file(options.directory, "cases", scenarios::fingerprint(context.resolved), grid.cases(),
                           processes.rank());
  const bool is_complete = scenarios::open_cases(file, grid.cases(), options);
  run_cases(grid, context, file);
  if (processes.rank() != 0) file.close();
  processes.wait();
  if (processes.rank() != 0) return {};
  file.finish();
  scenarios::Answer answer = answer_of(read_cases(file.path(), grid), grid);
  if (is_complete && options.found == scenarios::FoundCases::refuse)
    answer.warnings.emplace_back(
        "all cases of this campaign were there already: they are scored anew, not computed");
  if (!file.damage().empty()) answer.warnings.push_back(file.damage());
  return answer;
}

}  // namespace dualdamp::bench
