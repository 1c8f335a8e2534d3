#include "bench/contest/contest.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>
#include <utility>

#include "bench/contest/answers.hpp"
#include "bench/contest/export.hpp"
#include "bench/stress_test.hpp"
#include "core/diagnostics.hpp"
#include "core/units.hpp"
#include "scenarios/run.hpp"

namespace dualdamp::bench {

namespace {

/// Refuses a key of other cases, whose truth the answers do not refer to, and a changed key, which would assign
/// answers wrongly.
void check_key(const Key& key, const std::string& file, const scenarios::Scenario& scenario) {
  const Key exported = key_of(*stress_test_of(*scenario.question), scenarios::context_of(scenario, {}));
  if (key.scenario != exported.scenario)
    core::refuse({.file = file}, "the key is that of another stress test",
                 "the scenario, with the same changes, that was exported");
  if (key.numbers != exported.numbers)
    core::refuse({.file = file}, "the key was changed after the export",
                 "key.json of the export, whose cases are " + std::to_string(exported.numbers.size()));
}

/// A name is printed, and written to tables.
bool is_printable(const std::string& name) {
  const bool has_control = std::ranges::any_of(name, [](char c) { return (c >= 0 && c < ' ') || c == 0x7f; });
  return !name.empty() && core::trimmed(name) == name && !has_control;
}

}  // namespace

std::string hidden_seed() {
  std::random_device device;
  constexpr unsigned bits = 21;
  const std::uint64_t high = device() >> (32U - bits);
  return std::to_string((high << 32U) | device());
}

scenarios::Scenario contest_scenario(const ContestLoader& load, const std::string& seed,
                                     const std::string& origin) {
  const scenarios::Scenario scenario = load({});
  if (stress_test_of(*scenario.question) == nullptr)
    core::refuse({.file = scenario.file}, "this scenario asks for no stress test",
                 "analysis: {type: stress_test, ...}", scenario.analysis_name);
  // Set only now: for another analysis the reader would refuse the seed without the real reason.
  return load({{"analysis.seed=" + seed, origin}});
}

scenarios::Scenario scored_scenario(const ContestLoader& load, const std::string& key_file,
                                    const std::vector<Answers>& answers) {
  const Key key = read_key(key_file);
  scenarios::Scenario scenario = contest_scenario(load, std::to_string(key.seed), key_file);
  check_key(key, key_file, scenario);
  StressTest question = *stress_test_of(*scenario.question);
  std::set<std::string> names;
  for (std::size_t i = 0; i < question.methods.size(); ++i) names.insert(question.entrant(i));
  for (const Answers& entry : answers) {
    if (!is_printable(entry.name))
      core::refuse({.file = entry.file}, "answers need a name", "visible characters, and blanks between them",
                   entry.name);
    if (!names.insert(entry.name).second)
      core::refuse({.file = entry.file}, "two entries have the same name", "another name", entry.name);
    question.entries.push_back(read_entry(entry.name, entry.file, key));
  }
  scenario.question = question_of(std::move(question));
  return scenario;
}

}  // namespace dualdamp::bench
