#include "cli/stress.hpp"

#include <algorithm>
#include <memory>
#include <random>
#include <set>

#include "bench/analyses.hpp"
#include "bench/export.hpp"
#include "bench/score/key.hpp"
#include "bench/stress_test.hpp"
#include "core/diagnostics.hpp"
#include "scenarios/run.hpp"

namespace dualdamp::cli {

namespace {

[[noreturn]] void refuse(const std::string& file, std::string message, std::string allowed = {},
                         std::string found = {}) {
  throw core::InputError(
      core::Diagnostic{{file, 0, 0, {}}, std::move(message), std::move(allowed), std::move(found), {}});
}

scenarios::Scenario load(const std::string& file, const std::vector<std::string>& set, const std::string& seed,
                         const std::string& origin) {
  scenarios::LoadOptions options{.analyses = bench::analyses()};
  for (const std::string& assignment : set) options.set.push_back({assignment});
  scenarios::Scenario scenario = scenarios::load_scenario(file, options);
  if (bench::stress_test_of(*scenario.question) == nullptr)
    refuse(file, "this scenario asks for no stress test", "analysis: {type: stress_test, ...}",
           scenario.analysis_name);
  // Only now: of another analysis the reader would refuse the seed, and not say why.
  options.set.push_back({"analysis.seed=" + seed, origin});
  return scenarios::load_scenario(file, options);
}

/// A seed that nobody can guess, and that a double holds.
std::string hidden_seed() {
  std::random_device device;
  constexpr unsigned bits = 21;
  const std::uint64_t high = device() >> (32U - bits);
  return std::to_string((high << 32U) | device());
}

/// Answers do not know cases that have another truth, and none is sorted by a key that was changed.
void check_key(const bench::Key& key, const std::string& file, const scenarios::Scenario& scenario) {
  const bench::Key exported =
      bench::key_of(*bench::stress_test_of(*scenario.question), scenarios::context_of(scenario, {}));
  if (key.scenario != exported.scenario)
    refuse(file, "the key is that of another stress test", "the same scenario and --set as for the export");
  if (key.numbers != exported.numbers)
    refuse(file, "the key is not as the export wrote it",
           "key.json of the export, whose cases are " + std::to_string(exported.numbers.size()));
}

}  // namespace

std::string export_stress_test(const ExportCommand& command) {
  const scenarios::Scenario scenario =
      load(command.file, command.set, command.seed.empty() ? hidden_seed() : command.seed, "--seed");
  scenarios::RunOptions options{.directory = command.out, .threads = command.jobs};
  const std::size_t cases = bench::export_cases(*bench::stress_test_of(*scenario.question),
                                                scenarios::context_of(scenario, options), command.out);
  return "wrote " + std::to_string(cases) + " cases to " + command.out +
         "/cases, their constants to constants.csv and the key, which is not for those who answer, to key.json\n";
}

scenarios::Scenario scenario_of(const ScoreCommand& command) {
  const bench::Key key = bench::read_key(command.key);
  scenarios::Scenario scenario = load(command.file, command.set, std::to_string(key.seed), command.key);
  check_key(key, command.key, scenario);
  bench::StressTest question = *bench::stress_test_of(*scenario.question);
  std::set<std::string> names;
  for (std::size_t i = 0; i < question.methods.size(); ++i) names.insert(question.entrant(i));
  for (const std::string& answers : command.answers) {
    const std::size_t sign = answers.find('=');
    if (sign == std::string::npos || sign == 0) refuse("--answers", "answers need a name", "NAME=FILE", answers);
    const std::string name = answers.substr(0, sign);
    if (!names.insert(name).second) refuse("--answers", "two take part under one name", "another name", name);
    question.entries.push_back(bench::read_entry(name, answers.substr(sign + 1), key));
  }
  scenario.question = bench::question_of(std::move(question));
  return scenario;
}

}  // namespace dualdamp::cli
