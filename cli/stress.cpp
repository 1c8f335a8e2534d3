#include "cli/stress.hpp"

#include "bench/analyses.hpp"
#include "bench/contest/contest.hpp"
#include "bench/contest/export.hpp"
#include "cli/command_line/option_text.hpp"
#include "core/diagnostics.hpp"
#include "scenarios/run.hpp"

namespace dualdamp::cli {

namespace {

bench::ContestLoader loader(const std::string& file, const std::vector<std::string>& set) {
  scenarios::LoadOptions options{.words = key_or_option_of_setting, .analyses = bench::analyses()};
  for (const std::string& assignment : set) options.set.push_back({assignment, "--set"});
  return [file, options](const std::vector<scenarios::Override>& values) {
    scenarios::LoadOptions with_values = options;
    with_values.set.insert(with_values.set.end(), values.begin(), values.end());
    return scenarios::load_scenario(file, with_values);
  };
}

}  // namespace

std::string export_stress_test(const ExportCommand& command) {
  const scenarios::Scenario scenario = bench::contest_scenario(
      loader(command.file, command.set), command.seed.empty() ? bench::hidden_seed() : command.seed, "--seed");
  scenarios::RunOptions options{.directory = command.out, .threads = command.jobs};
  if (command.overwrite) options.found = scenarios::FoundCases::overwrite;
  const bench::Exported exported = bench::export_cases(*bench::stress_test_of(*scenario.question),
                                                       scenarios::context_of(scenario, options), command.out);
  std::string messages;
  for (const std::string& message : exported.messages) messages += message + "\n";
  return messages + "wrote " + std::to_string(exported.cases) + " cases to " + command.out +
         "/cases, their constants to constants.csv, and the key, which participants must not see, to key.json\n";
}

scenarios::Scenario scenario_of(const ScoreCommand& command) {
  std::vector<bench::Answers> answers;
  for (const std::string& text : command.answers) {
    auto [name, file] = split_at_equals(text);
    if (name.empty() || name.size() == text.size())
      throw core::InputError(
          core::Diagnostic{{"--answers", 0, 0, {}}, "answers need a name", "NAME=FILE", text, {}});
    answers.push_back({std::move(name), std::move(file)});
  }
  return bench::scored_scenario(loader(command.file, command.set), command.key, answers);
}

}  // namespace dualdamp::cli
