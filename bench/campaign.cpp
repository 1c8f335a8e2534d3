#include "bench/campaign.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "bench/case.hpp"
#include "bench/grid.hpp"
#include "bench/scores.hpp"
#include "core/numbers.hpp"
#include "scenarios/analyses/shared/long_run.hpp"
#include "scenarios/results/case_file.hpp"

namespace dualdamp::bench {

namespace {

using Clock = std::chrono::steady_clock;
using scenarios::Json;
using scenarios::RunContext;
using scenarios::RunOptions;
using scenarios::Table;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The scenario's system with its Coulomb friction taken out.
Truth truth_of(const StressTest& question, const RunContext& context) {
  Truth truth{.model = context.model, .F0 = question.F0};
  truth.model.friction.clear();
  return truth;
}

/// All motions that are left, on all threads of all processes.
void run_cases(const StressTest& question, const Grid& grid, const RunContext& context, scenarios::CaseFile& file) {
  const RunOptions& options = context.options;
  const Truth truth = truth_of(question, context);
  const sim::SteadyStateOptions steady = context.steady_states();
  scenarios::Meter meter(file.finished(), grid.cases(), options);
  const auto wanted = [&](std::size_t number) { return !file.is_finished(number); };
  const auto take = [&](const std::string& line) {
    file.add(line);
    meter.add();
  };
  scenarios::share_out(grid.motions(), options,
                       [&](std::size_t motion) { run_motion(grid, truth, steady, motion, wanted, take); });
}

Table score_table(const Scores& scores, const Grid& grid) {
  const StressTest& question = grid.question();
  const auto motion = [&](const Score& score) { return grid.motion(score.motion); };
  const auto of = [](ParameterScore Score::* parameter, double ParameterScore::* member) {
    return [=](const Score& score) { return (score.*parameter).*member; };
  };
  using scenarios::column;
  using scenarios::text_column;
  const std::vector<Score>& list = scores.scores;
  Table table{"scores",
              {text_column("law", list, [&](const Score& s) { return motion(s).name(); }),
               column("severity", "", list, [&](const Score& s) { return motion(s).severity; }),
               text_column("range", list, [&](const Score& s) { return motion(s).range->name; }),
               text_column("sensors", list, [&](const Score& s) { return question.sensors[s.sensors].name; }),
               text_column("method", list, [&](const Score& s) { return question.methods[s.method]->name; }),
               column("cases", "", list, &Score::cases), column("estimates", "", list, &Score::estimates)},
              true};
  for (const auto& [name, parameter] : {std::pair("zeta", &Score::zeta), std::pair("F0", &Score::F0)}) {
    const std::string prefix = name;
    table.columns.push_back(column(prefix + "_bias", "", list, of(parameter, &ParameterScore::bias)));
    table.columns.push_back(column(prefix + "_spread", "", list, of(parameter, &ParameterScore::spread)));
    table.columns.push_back(column(prefix + "_error", "", list, of(parameter, &ParameterScore::median_error)));
    table.columns.push_back(column(prefix + "_coverage", "", list, of(parameter, &ParameterScore::coverage)));
  }
  table.columns.push_back(column("wrong", "", list, &Score::wrong));
  table.columns.push_back(column("knew", "", list, &Score::knew));
  table.columns.push_back(column("false_alarm", "", list, &Score::false_alarm));
  table.key = "scores";
  return table;
}

Table breakdown_table(const Scores& scores, const Grid& grid) {
  const StressTest& question = grid.question();
  const std::vector<Breakdown>& list = scores.breakdowns;
  using scenarios::column;
  using scenarios::text_column;
  Table table{"breakdown",
              {text_column("law", list, &Breakdown::law),
               text_column("range", list, [&](const Breakdown& b) { return question.ranges[b.range].name; }),
               text_column("sensors", list, [&](const Breakdown& b) { return question.sensors[b.sensors].name; }),
               text_column("method", list, [&](const Breakdown& b) { return question.methods[b.method]->name; }),
               column("zeta_5", "", list, &Breakdown::zeta_5), column("zeta_20", "", list, &Breakdown::zeta_20),
               column("F0_5", "", list, &Breakdown::F0_5), column("F0_20", "", list, &Breakdown::F0_20),
               column("wrong", "", list, &Breakdown::wrong), column("knew", "", list, &Breakdown::knew)},
              true};
  table.key = "breakdown";
  return table;
}

Table ranking_table(const Scores& scores, const Grid& grid) {
  const std::vector<Ranking>& list = scores.ranking;
  using scenarios::column;
  using scenarios::text_column;
  Table table{
      "ranking",
      {text_column("method", list, [&](const Ranking& r) { return grid.question().methods[r.method]->name; }),
       column("worth", "", list, &Ranking::worth), column("trusted", "", list, &Ranking::trusted),
       column("unwarned", "", list, &Ranking::unwarned), column("wrong", "", list, &Ranking::wrong),
       column("knew", "", list, &Ranking::knew), column("false_alarm", "", list, &Ranking::false_alarm),
       column("coverage", "", list, &Ranking::coverage)}};
  table.key = "ranking";
  return table;
}

Json summary(const Scores& scores, const Grid& grid) {
  Json json;
  json["cases"] = {{"all", grid.cases()},
                   {"failed", scores.failed_cases},
                   {"motions", grid.motions()},
                   {"estimates", grid.cases() * grid.question().methods.size()}};
  json["severities"] = Json::object();
  for (const Rig* law : grid.question().laws) json["severities"][std::string(law->name)] = law->severity;
  for (const char* key : {"ranking", "breakdown", "scores"}) json[key] = nullptr;
  return json;
}

}  // namespace

CampaignSize size_of(const StressTest& question, const RunContext& context) {
  StressTest sample = question;
  const Grid whole(question);
  CampaignSize size{whole.motions(), whole.cases(), whole.cases() * sample.methods.size(), 0.0, 0.0};
  // One motion of each law, read once: all others like it.
  const std::size_t severities = sample.severities.size();
  sample.severities = {sample.severities[severities / 2]};
  sample.ranges.resize(1);
  sample.seeds = 1;
  const Grid grid(sample);
  const Truth truth = truth_of(question, context);
  const auto try_motion = [&](const Grid& cases, std::size_t motion) {
    run_motion(
        cases, truth, context.steady_states(), motion, [](std::size_t) { return true; }, [](const std::string&) {});
  };
  const Clock::time_point start = Clock::now();
  for (std::size_t motion = 0; motion < grid.motions(); ++motion) try_motion(grid, motion);
  const double motions = seconds_since(start);
  const Clock::time_point again = Clock::now();
  sample.seeds = 2;
  const Grid twice(sample);
  try_motion(twice, 0);
  const double reading = seconds_since(again) / static_cast<double>(twice.cases_per_motion());
  size.seconds = (motions * static_cast<double>(severities * question.ranges.size()) +
                  reading * static_cast<double>(size.cases)) /
                 std::thread::hardware_concurrency();
  constexpr double of_program = 60.0;
  constexpr double of_case = 30e-6;
  constexpr double of_score = 250e-6;
  size.megabytes = of_program + of_case * static_cast<double>(size.cases) +
                   of_score * static_cast<double>(size.motions * sample.sensors.size() * sample.methods.size());
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
  run_cases(question, grid, context, file);
  if (processes.rank() != 0) file.close();
  processes.wait();
  if (processes.rank() != 0) return {};
  file.finish();
  const Scores scores = score(file.path(), grid, sim::damping_ratio(context.model.oscillator), question.F0);
  scenarios::Answer answer;
  answer.result = summary(scores, grid);
  answer.tables = {ranking_table(scores, grid), breakdown_table(scores, grid), score_table(scores, grid)};
  if (is_complete && options.found == scenarios::FoundCases::refuse)
    answer.warnings.push_back("all cases of this campaign were there already: they are scored anew, not computed");
  if (scores.failed_cases > 0) answer.status = core::ExitStatus::some_cases_failed;
  return answer;
}

}  // namespace dualdamp::bench
